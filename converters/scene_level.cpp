#include "converters/scene_level.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace pstrips::inline converters {
namespace {

using Matrix = std::array<double, 9>;  // 3 × 3, column-major

constexpr Matrix kIdentity = {1, 0, 0, 0, 1, 0, 0, 0, 1};

Matrix linear_part(const Node& node) {
  const auto& m = node.matrix;
  return {m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]};
}

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix out{};
  for (std::size_t column = 0; column < 3; ++column)
    for (std::size_t row = 0; row < 3; ++row)
      for (std::size_t k = 0; k < 3; ++k)
        out[3 * column + row] += a[3 * k + row] * b[3 * column + k];
  return out;
}

Matrix transposed(const Matrix& m) {
  return {m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]};
}

double trace(const Matrix& m) { return m[0] + m[4] + m[8]; }

void divide(Matrix& m, double by) {
  for (double& x : m) x /= by;
}

// The root of the largest eigenvalue of MᵀM. Squared again and again, MᵀM tends to the projection
// onto that value's eigenvectors, where the Rayleigh quotient gives it; 30 squarings tell values
// apart that differ by more than 1e-8.
double largest_singular_value(Matrix m) {
  double unit = 0;
  for (const double x : m) unit = std::max(unit, std::isfinite(x) ? std::abs(x) : HUGE_VAL);
  if (!std::isfinite(unit)) return 1;
  if (unit == 0) return 0;
  divide(m, unit);
  const Matrix gram = product(transposed(m), m);
  Matrix projection = gram;
  for (int i = 0; i < 30; ++i) {
    divide(projection, trace(projection));
    projection = product(projection, projection);
  }
  const double scale = unit * std::sqrt(trace(product(projection, gram)) / trace(projection));
  return std::isfinite(scale) ? scale : 1;
}

}  // namespace

std::vector<double> instance_scales(const Scene& scene, std::size_t meshes) {
  std::vector<double> scales(meshes, -1);
  std::vector<Matrix> world;
  world.reserve(scene.nodes.size());
  for (const Node& node : scene.nodes) {
    assert(node.parent == kNone || node.parent < world.size());
    const Matrix& parent = node.parent == kNone ? kIdentity : world[node.parent];
    world.push_back(product(parent, linear_part(node)));
    if (node.meshes.empty()) continue;
    const double scale = largest_singular_value(world.back());
    for (const Index m : node.meshes) {
      assert(m < meshes);
      scales[m] = std::max(scales[m], scale);
    }
  }
  std::ranges::replace(scales, -1.0, 1.0);
  return scales;
}

SceneLevel::SceneLevel(const ProgressiveStrips& strips)
    : scale_(instance_scales(strips.scene, strips.meshes.size())), now_(strips.bases) {
  for (const ProgressiveMesh& mesh : strips.meshes)
    has_strips_.push_back(mesh.encoding != MapEncoding::triangles);
  for (Index m = 0; m < now_.size(); ++m) {
    vertices_ += now_[m].vertices;
    triangles_ += now_[m].triangles;
    strips_ += strips_of(now_[m]);
    push(errors_, m);
    push(one_sided_errors_, m);
  }
}

void SceneLevel::add(const Packet& packet) {
  Packet& now = now_[packet.mesh];
  vertices_ = vertices_ + packet.vertices - now.vertices;
  triangles_ = triangles_ + packet.triangles - now.triangles;
  strips_ = strips_ + strips_of(packet) - strips_of(now);
  now = packet;
  push(errors_, packet.mesh);
  push(one_sided_errors_, packet.mesh);
}

void SceneLevel::push(Errors& errors, Index mesh) const {
  const auto now = [&](Index m) { return scaled_error(now_[m], scale_[m], errors.kind); };
  errors.all.emplace(now(mesh), mesh);
  while (errors.all.top().first != now(errors.all.top().second)) errors.all.pop();
}

double SceneLevel::scaled_error(const Packet& packet, double scale, float Packet::*kind) {
  const double error = packet.*kind * scale;
  return error >= 0 ? error : 0;
}

}  // namespace pstrips::inline converters
