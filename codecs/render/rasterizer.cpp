#include "codecs/render/rasterizer.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "codecs/triangulate/triangulate.h"

namespace pstrips::inline codecs {
namespace {

constexpr float kAmbient = 0.3f;

Point normalized(const Point& p) {
  const double size = length(p);
  return size > 0 ? p * (1 / size) : Point{};
}

const Attribute* find_attribute(const Mesh& mesh, std::string_view semantic, std::size_t count) {
  for (const Attribute& a : mesh.wedge_attributes)
    if (a.semantic == semantic && a.count >= count) return &a;
  return nullptr;
}

template <std::size_t n>
std::array<double, n> element(const Attribute& attribute, Index i) {
  std::array<double, n> out;
  for (std::size_t c = 0; c < n; ++c) {
    out[c] = component(attribute, i, c);
    if (!std::isfinite(out[c])) out[c] = 0;
  }
  return out;
}

struct OnScreen {
  double x, y, depth;  // in pixels, and in model units
};

class Renderer {
 public:
  Renderer(std::span<const Texture> textures, const Camera& camera, Index size)
      : textures_(textures), camera_(camera), picture_{size, {}} {
    picture_.pixels.resize(std::size_t{size} * size);
  }

  void draw(const RenderMesh& mesh, Index t);
  Picture finish(const RenderMesh& mesh) &&;

 private:
  struct Weights {
    double a, b, c;
  };
  OnScreen project(const Point& p) const;
  void shade(const RenderMesh& mesh, Pixel& pixel, const Weights& w) const;

  std::span<const Texture> textures_;
  const Camera& camera_;
  Picture picture_;
};

OnScreen Renderer::project(const Point& p) const {
  const Point d = p - camera_.centre;
  const double half = picture_.size / 2.0, scale = half / camera_.radius;
  return {half + dot(d, camera_.right) * scale, half - dot(d, camera_.up) * scale,
          -dot(d, camera_.toward)};
}

// A pixel belongs to a triangle when its centre is inside or on the edge.
void Renderer::draw(const RenderMesh& mesh, Index t) {
  const OnScreen p[3] = {project(mesh.corners[3 * t].position),
                         project(mesh.corners[3 * t + 1].position),
                         project(mesh.corners[3 * t + 2].position)};
  const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
  if (area == 0) return;
  const auto range = [&](double low, double high) {
    const double last = picture_.size - 1.0;
    return std::pair{static_cast<Index>(std::clamp(std::ceil(low - 0.5), 0.0, last + 1)),
                     static_cast<Index>(std::clamp(std::floor(high - 0.5), -1.0, last) + 1)};
  };
  const auto [left, right] =
      range(std::min({p[0].x, p[1].x, p[2].x}), std::max({p[0].x, p[1].x, p[2].x}));
  const auto [top, bottom] =
      range(std::min({p[0].y, p[1].y, p[2].y}), std::max({p[0].y, p[1].y, p[2].y}));
  for (Index row = top; row < bottom; ++row)
    for (Index column = left; column < right; ++column) {
      const double x = column + 0.5, y = row + 0.5;
      const auto side = [&](const OnScreen& u, const OnScreen& v) {
        return ((u.x - x) * (v.y - y) - (v.x - x) * (u.y - y)) / area;
      };
      const Weights w{side(p[1], p[2]), side(p[2], p[0]), side(p[0], p[1])};
      if (w.a < 0 || w.b < 0 || w.c < 0) continue;
      const double depth = w.a * p[0].depth + w.b * p[1].depth + w.c * p[2].depth;
      Pixel& pixel = picture_.pixels[std::size_t{row} * picture_.size + column];
      if (!(depth < pixel.depth)) continue;
      pixel.depth = depth;
      pixel.triangle = t;
      shade(mesh, pixel, w);
    }
}

void Renderer::shade(const RenderMesh& mesh, Pixel& pixel, const Weights& w) const {
  const RenderMesh::Corner* const c = &mesh.corners[std::size_t{3} * pixel.triangle];
  Point face = normalized(cross(c[1].position - c[0].position, c[2].position - c[0].position));
  Point vertex = normalized(c[0].normal * w.a + (c[1].normal * w.b + c[2].normal * w.c));
  if (dot(vertex, vertex) == 0) vertex = face;
  pixel.from_behind = dot(face, camera_.toward) < 0;
  if (pixel.from_behind) {
    face = face * -1;
    vertex = vertex * -1;
  }
  pixel.face_normal = face;
  pixel.vertex_normal = vertex;
  for (std::size_t k = 0; k < 2; ++k)
    pixel.uv[k] = w.a * c[0].uv[k] + w.b * c[1].uv[k] + w.c * c[2].uv[k];
}

// Textures are looked up once a pixel, not once for all that were drawn there.
Picture Renderer::finish(const RenderMesh& mesh) && {
  for (Pixel& pixel : picture_.pixels)
    if (pixel.is_covered()) pixel.colour = textures_[mesh.texture[pixel.triangle]].at(pixel.uv);
  return std::move(picture_);
}

// Of faces, by area; zero where there are none.
std::vector<Point> vertex_normals(const Mesh& mesh, const Triangulation& triangles,
                                  std::span<const double> positions) {
  std::vector<Point> out(mesh.vertex_count());
  const auto at = [&](Index v) {
    return Point{positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]};
  };
  for (std::size_t i = 0; i < triangles.corners.size(); i += 3) {
    const Index v[3] = {mesh.vertex_of(triangles.corners[i]),
                        mesh.vertex_of(triangles.corners[i + 1]),
                        mesh.vertex_of(triangles.corners[i + 2])};
    const Point n = cross(at(v[1]) - at(v[0]), at(v[2]) - at(v[0]));
    for (const Index x : v) out[x] = out[x] + n;
  }
  for (Point& n : out) n = normalized(n);
  return out;
}

}  // namespace

std::array<float, 3> Texture::at(Uv uv) const {
  struct Between {
    Index low, high;
    float share;
  };
  const auto place = [](double x, Index size) -> Between {
    const double at = (x - std::floor(x)) * size - 0.5;
    const double low = std::floor(at);
    const auto index = static_cast<Index>(low + size) % size;
    return {index, (index + 1) % size, static_cast<float>(at - low)};
  };
  const Between x = place(uv[0], width), y = place(uv[1], height);
  std::array<float, 3> out;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto along = [&](Index row) {
      const auto* const texel = &texels[std::size_t{row} * width];
      return texel[x.low][k] * (1 - x.share) + texel[x.high][k] * x.share;
    };
    out[k] = along(y.low) * (1 - y.share) + along(y.high) * y.share;
  }
  return out;
}

Texture Texture::halved() const {
  assert(width % 2 == 0 && height % 2 == 0);
  Texture out{width / 2, height / 2, {}};
  for (Index y = 0; y < height; y += 2)
    for (Index x = 0; x < width; x += 2) {
      const auto* const above = &texels[std::size_t{y} * width + x];
      const auto* const below = above + width;
      auto& mean = out.texels.emplace_back();
      for (std::size_t k = 0; k < 3; ++k)
        mean[k] = (above[0][k] + above[1][k] + below[0][k] + below[1][k]) / 4;
    }
  return out;
}

RenderMesh render_mesh(const Mesh& mesh, std::span<const Index> group_texture) {
  const Triangulation triangles = triangulate(mesh);
  const std::vector<double> positions = positions_as_double(mesh);
  const Attribute* const uvs = find_attribute(mesh, "TEXCOORD_0", 2);
  const Attribute* const normals = find_attribute(mesh, "NORMAL", 3);
  std::vector<Point> own_normals;
  if (!normals) own_normals = vertex_normals(mesh, triangles, positions);
  RenderMesh out;
  for (std::size_t t = 0; t < triangles.face.size(); ++t) {
    RenderMesh::Corner corners[3];
    bool finite = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const Index w = triangles.corners[3 * t + k], v = mesh.vertex_of(w);
      corners[k].position = {positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]};
      for (const double x : corners[k].position) finite &= std::isfinite(x);
      corners[k].normal = normals ? element<3>(*normals, w) : own_normals[v];
      if (uvs) corners[k].uv = element<2>(*uvs, w);
    }
    if (!finite) continue;
    out.corners.insert(out.corners.end(), corners, corners + 3);
    out.texture.push_back(group_texture[mesh.group_of(triangles.face[t])]);
  }
  return out;
}

Picture render(const RenderMesh& mesh, std::span<const Texture> textures, const Camera& camera,
               Index size) {
  Renderer renderer(textures, camera, size);
  for (Index t = 0; t < mesh.triangle_count(); ++t) renderer.draw(mesh, t);
  return std::move(renderer).finish(mesh);
}

std::array<float, 3> lit(const Pixel& pixel, const Point& normal, const Point& toward) {
  const auto light = static_cast<float>(std::max(0.0, dot(normal, toward)));
  std::array<float, 3> out = pixel.colour;
  for (float& x : out) x *= kAmbient + (1 - kAmbient) * light;
  return out;
}

}  // namespace pstrips::inline codecs
