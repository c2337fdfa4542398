#include "formats/gltf/local_origin.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pstrips::inline formats::gltf {
namespace {

template <class Visit>
void each_position(const Mesh& mesh, Visit&& visit) {
  const std::size_t components = std::min<std::size_t>(mesh.position.count, 3);
  for (std::size_t v = 0; v < mesh.position.elements(); ++v)
    for (std::size_t c = 0; c < components; ++c) {
      const double x = component(mesh.position, v, c);
      if (std::isfinite(x)) visit(c, x);
    }
}

bool is_wider_than_float(const Mesh& mesh) {
  const ComponentType type = mesh.position.type;
  return type == ComponentType::f64 || type == ComponentType::i32 || type == ComponentType::u32;
}

double rounding_of(const Model& model, const Point& origin) {
  double out = 0;
  for (const Mesh& mesh : model.meshes) out = std::max(out, gltf::rounding_of(mesh, origin));
  return out;
}

Point middle_of(const Model& model) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Point low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
  for (const Mesh& mesh : model.meshes)
    each_position(mesh, [&](std::size_t c, double x) {
      low[c] = std::min(low[c], x);
      high[c] = std::max(high[c], x);
    });
  Point out{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double middle = low[c] / 2 + high[c] / 2;
    const float rounded = static_cast<float>(std::round(middle));
    if (low[c] <= high[c] && std::isfinite(rounded)) out[c] = rounded;
  }
  return out;
}

}  // namespace

double rounding_of(const Mesh& mesh, const Point& origin) {
  double out = 0;
  if (is_wider_than_float(mesh) || origin != Point{})
    each_position(mesh, [&](std::size_t c, double x) {
      const double from = x - origin[c], error = std::abs(from - static_cast<float>(from));
      if (std::isfinite(error)) out = std::max(out, error);
    });
  return out;
}

std::optional<Point> find_local_origin(const Model& model) {
  if (std::ranges::none_of(model.meshes, is_wider_than_float)) return std::nullopt;
  const double as_they_are = rounding_of(model, Point{});
  if (as_they_are == 0) return std::nullopt;
  const Point origin = middle_of(model);
  if (rounding_of(model, origin) * 4 > as_they_are) return std::nullopt;
  return origin;
}

}  // namespace pstrips::inline formats::gltf
