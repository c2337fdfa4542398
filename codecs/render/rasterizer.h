#pragma once

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "core/mesh.h"
#include "core/point.h"

// A small renderer for pictures without a graphics card, and for comparing meshes by what one sees
// of them: z-buffer, textures, no lights of its own. Cameras are orthographic, so that no part of a
// model counts more than another and everything is linear over a triangle on the screen.

namespace pstrips::inline codecs {

using Uv = std::array<double, 2>;

/// Linear colours from 0 to 1, the first row at v = 0; repeated beyond.
struct Texture {
  Index width = 0, height = 0;
  std::vector<std::array<float, 3>> texels;
  /// Bilinear; uv finite.
  std::array<float, 3> at(Uv uv) const;
  /// Half as wide and high, each texel the mean of four. Precondition: both are even.
  Texture halved() const;
};

/// Triangles with all that a pixel can show.
struct RenderMesh {
  struct Corner {
    Point position;
    Point normal;  ///< of unit length or zero
    Uv uv;
  };
  std::vector<Corner> corners;  ///< 3 a triangle
  std::vector<Index> texture;   ///< one a triangle

  std::size_t triangle_count() const { return corners.size() / 3; }
};

/// The triangles of a mesh with TEXCOORD_0 and NORMAL; normals that it has not got are those of its
/// faces, averaged by area at each vertex. Triangles with coordinates that are not finite are left
/// out.
///
/// group_texture  a texture for each group of the mesh
RenderMesh render_mesh(const Mesh& mesh, std::span<const Index> group_texture);

/// Looks at a sphere that fills the picture.
struct Camera {
  Point right, up, toward;  ///< orthonormal; `toward` the viewer
  Point centre;
  double radius = 1;
};

struct Pixel {
  static constexpr double kBackground = std::numeric_limits<double>::infinity();
  double depth = kBackground;  ///< away from the viewer, 0 at the camera's centre
  Index triangle = kNone;
  bool from_behind = false;
  Point face_normal{}, vertex_normal{};  ///< of unit length, on the side of the viewer
  Uv uv{};
  std::array<float, 3> colour{};  ///< of the texture, unlit
  bool is_covered() const { return depth < kBackground; }
};

/// Rows from top to bottom.
struct Picture {
  Index size = 0;  ///< width and height
  std::vector<Pixel> pixels;
};

/// Both sides of each triangle are seen; of triangles at the same depth the first.
/// Precondition: every texture that the mesh names is there. Deterministic.
Picture render(const RenderMesh& mesh, std::span<const Texture> textures, const Camera& camera,
               Index size);

/// How a pixel looks with a light where the viewer is.
std::array<float, 3> lit(const Pixel& pixel, const Point& normal, const Point& toward);

}  // namespace pstrips::inline codecs
