#include "tests/support/seamed_meshes.h"

#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "tests/support/meshes.h"

namespace pstrips::test {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

Attribute texture_coordinates(const std::vector<float>& uvs) {
  const auto view = std::as_bytes(std::span(uvs));
  return {"TEXCOORD_0", ComponentType::f32, 2, false, Bytes(view.begin(), view.end())};
}

// (u + 1) × (v + 1) wedges over a rectangle of texture coordinates; `vertex_of(i, j)` may be
// the same on opposite sides.
template <class VertexOf>
void add_sheet(Mesh& mesh, Index u, Index v, VertexOf&& vertex_of) {
  std::vector<float> uvs;
  for (Index i = 0; i <= u; ++i)
    for (Index j = 0; j <= v; ++j) {
      mesh.wedge_vertex.push_back(vertex_of(i, j));
      uvs.push_back(static_cast<float>(i) / static_cast<float>(u));
      uvs.push_back(static_cast<float>(j) / static_cast<float>(v));
      if (i == u || j == v) continue;
      const Index a = i * (v + 1) + j, b = a + v + 1, c = a + 1, d = b + 1;
      mesh.corners.insert(mesh.corners.end(), {a, b, c, b, d, c});
    }
  mesh.wedge_attributes.push_back(texture_coordinates(uvs));
}

// Numbers the lattice points on the surface of a cube as they come.
class CubeSphere {
 public:
  CubeSphere(Index side, Index charts) : side_(side), charts_(charts) {
    // As many cells across the texture as it takes.
    cells_ = static_cast<Index>(std::ceil(std::sqrt(6.0 * charts * charts)));
  }

  Mesh make() && {
    for (Index face = 0; face < 6; ++face)
      for (Index row = 0; row < charts_; ++row)
        for (Index column = 0; column < charts_; ++column) add_chart(face, row, column);
    Mesh mesh = triangle_mesh(std::move(positions_), std::move(corners_));
    mesh.wedge_vertex = std::move(wedge_vertex_);
    mesh.wedge_attributes.push_back(texture_coordinates(uvs_));
    return mesh;
  }

 private:
  void add_chart(Index face, Index row, Index column);
  Index vertex(const std::array<Index, 3>& lattice);

  Index side_, charts_, cells_, chart_ = 0;
  std::map<std::array<Index, 3>, Index> numbers_;
  std::vector<float> positions_, uvs_;
  std::vector<Index> corners_, wedge_vertex_;
};

void CubeSphere::add_chart(Index face, Index row, Index column) {
  const Index n = side_ / charts_, first = static_cast<Index>(wedge_vertex_.size());
  const std::size_t axis = face / 2;
  const bool high = face % 2 == 1;
  constexpr float kMargin = 0.05f;  // of a cell
  for (Index i = 0; i <= n; ++i)
    for (Index j = 0; j <= n; ++j) {
      std::array<Index, 3> lattice{};
      lattice[axis] = high ? side_ : 0;
      lattice[(axis + (high ? 1 : 2)) % 3] = row * n + i;
      lattice[(axis + (high ? 2 : 1)) % 3] = column * n + j;
      wedge_vertex_.push_back(vertex(lattice));
      float s = static_cast<float>(i) / static_cast<float>(n);
      float t = static_cast<float>(j) / static_cast<float>(n);
      if (chart_ % 2 == 1) t = 1 - std::exchange(s, t);
      const auto in_cell = [&](float x, Index cell) {
        return (static_cast<float>(cell) + kMargin + (1 - 2 * kMargin) * x) /
               static_cast<float>(cells_);
      };
      uvs_.push_back(in_cell(s, chart_ % cells_));
      uvs_.push_back(in_cell(t, chart_ / cells_));
      if (i == n || j == n) continue;
      const Index a = first + i * (n + 1) + j, b = a + n + 1, c = a + 1, d = b + 1;
      corners_.insert(corners_.end(), {a, b, c, b, d, c});
    }
  ++chart_;
}

Index CubeSphere::vertex(const std::array<Index, 3>& lattice) {
  const auto [it, is_new] = numbers_.try_emplace(lattice, static_cast<Index>(numbers_.size()));
  if (!is_new) return it->second;
  double p[3], length = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    p[k] = std::tan((lattice[k] * 2.0 / side_ - 1) * std::numbers::pi / 4);
    length += p[k] * p[k];
  }
  length = std::sqrt(length);
  for (double& x : p) x /= length;
  const double dent = 1 + 0.1 * std::sin(5 * p[0]) * std::cos(4 * p[1] + p[2]);
  for (const double x : p) positions_.push_back(static_cast<float>(x * dent));
  return it->second;
}

}  // namespace

Mesh cube_sphere(Index side, Index charts) {
  assert(charts > 0 && side % charts == 0);
  return CubeSphere(side, charts).make();
}

Mesh seamed_cylinder(Index u, Index v) {
  std::vector<float> positions;
  for (Index i = 0; i < u; ++i)
    for (Index j = 0; j <= v; ++j) {
      const double turn = kTurn * i / u;
      for (const double x : {std::cos(turn), std::sin(turn), 2.0 * j / v})
        positions.push_back(static_cast<float>(x));
    }
  Mesh mesh = triangle_mesh(std::move(positions), {});
  add_sheet(mesh, u, v, [&](Index i, Index j) { return i % u * (v + 1) + j; });
  return mesh;
}

Mesh seamed_torus(Index u, Index v) {
  Mesh mesh = torus(u, v);
  mesh.corners.clear();
  add_sheet(mesh, u, v, [&](Index i, Index j) { return i % u * v + j % v; });
  return mesh;
}

}  // namespace pstrips::test
