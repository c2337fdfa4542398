#pragma once

#include <array>
#include <span>

#include "codecs/render/rasterizer.h"

// How much of a mesh's looks another one keeps.

namespace pstrips::test {

/// Checks over gradients: tells every place from its neighbours, and shows what stretches.
Texture checker_texture(Index size, Index checks);

/// From the corners of an icosahedron.
std::array<Camera, 12> icosahedron_cameras(const Point& centre, double radius);

/// Differences between pictures of two meshes, from 0: the same. Colours over pixels that either
/// mesh covers, on grey; the rest over those that both do, texture coordinates where they show the
/// same side of the same surface: at depths that differ by less than kSameSurface.
struct Appearance {
  double silhouette = 0;     ///< pixels that one mesh covers alone, as a share of the original's
  double depth = 0;          ///< root mean square, model units
  double face_normal = 0;    ///< mean angle in degrees
  double vertex_normal = 0;  ///< the same
  double unlit = 0;          ///< root mean square of the texture's colours, of a range of 1
  double face_lit = 0;       ///< of the picture lit by normals of faces
  double vertex_lit = 0;     ///< of that lit by vertex normals
  double structure = 0;      ///< 1 - SSIM of that one's luminance, over 8 × 8 pixels [Wang04]
  /// Root mean square distance of the texture coordinates seen at a pixel, those that are farther
  /// apart than kMaxUv counting as that: then it is another part of the texture altogether.
  double uv = 0;
  /// Root mean square of the power of two by which a mesh stretches its texture more or less than
  /// the original does at the same pixel, the mean over all directions. Where the texture is
  /// mirrored, or one point of it all over a triangle, it counts as kMaxStretch.
  double stretch = 0;
};
inline constexpr double kMaxStretch = 10;
inline constexpr double kSameSurface = 0.02;  ///< of the camera's radius
inline constexpr double kMaxUv = 0.1;

/// Over one picture of each mesh for each camera.
Appearance compare_appearance(const RenderMesh& original, const RenderMesh& other,
                              std::span<const Texture> textures, std::span<const Camera> cameras,
                              Index size);

/// How much a map from texture coordinates to the surface stretches. [Sander01 §3] One needle in
/// the texture decides it: see Appearance::stretch for what one sees. Triangles without area do not
/// count.
struct Stretch {
  double l2 = 0;         ///< root mean square over the surface and over all directions
  double maximum = 0;    ///< the largest anywhere
  double collapsed = 0;  ///< share of the surface whose texture coordinates have no area: its
                         ///< stretch has no bounds and is not in the others
};
Stretch stretch(const RenderMesh& mesh);

}  // namespace pstrips::test
