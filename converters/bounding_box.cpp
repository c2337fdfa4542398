#include "converters/bounding_box.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/matrix4.h"
#include "core/mesh.h"

namespace pstrips::inline converters {
namespace {

std::array<double, 3> moved(const Matrix4& m, const std::array<double, 3>& p) {
  std::array<double, 3> out{};
  for (std::size_t row = 0; row < 3; ++row)
    out[row] = m[row] * p[0] + m[4 + row] * p[1] + m[8 + row] * p[2] + m[12 + row];
  return out;
}

BoundingBox box_of(const Mesh& mesh) {
  BoundingBox out;
  const std::vector<double> positions = positions_as_double(mesh);
  for (std::size_t i = 0; i + 2 < positions.size(); i += 3)
    out.add({positions[i], positions[i + 1], positions[i + 2]});
  return out;
}

void add_corners(const BoundingBox& box, const Matrix4& matrix, BoundingBox& out) {
  if (box.is_empty()) return;
  for (unsigned corner = 0; corner < 8; ++corner) {
    std::array<double, 3> point{};
    for (unsigned axis = 0; axis < 3; ++axis)
      point[axis] = corner >> axis & 1 ? box.max[axis] : box.min[axis];
    out.add(moved(matrix, point));
  }
}

}  // namespace

double BoundingBox::diagonal() const {
  return is_empty() ? 0 : std::hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2]);
}

void BoundingBox::add(const std::array<double, 3>& point) {
  if (!std::ranges::all_of(point, [](double x) { return std::isfinite(x); })) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    min[axis] = std::min(min[axis], point[axis]);
    max[axis] = std::max(max[axis], point[axis]);
  }
}

BoundingBox bounding_box(const Model& model) {
  std::vector<BoundingBox> boxes;
  for (const Mesh& mesh : model.meshes) boxes.push_back(box_of(mesh));
  std::vector<bool> is_placed(boxes.size());
  std::vector<Matrix4> world;  // of each node
  BoundingBox out;
  for (const Node& node : model.scene.nodes) {
    world.push_back(node.parent < world.size() ? product(world[node.parent], node.matrix)
                                               : node.matrix);
    for (const Index m : node.meshes) {
      if (m >= boxes.size()) continue;
      add_corners(boxes[m], world.back(), out);
      is_placed[m] = true;
    }
  }
  for (std::size_t m = 0; m < boxes.size(); ++m)
    if (!is_placed[m]) add_corners(boxes[m], Node{}.matrix, out);
  return out;
}

}  // namespace pstrips::inline converters
