#include "tests/support/meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>

namespace pstrips::test {
namespace {

template <class T>
Bytes bytes_of(const std::vector<T>& values) {
  const auto view = std::as_bytes(std::span(values));
  return Bytes(view.begin(), view.end());
}

}  // namespace

Model model_of(Mesh mesh) {
  Model model;
  model.meshes.push_back(std::move(mesh));
  return model;
}

Mesh triangle_mesh(std::vector<float> positions, std::vector<Index> corners) {
  Mesh mesh;
  mesh.position.data = bytes_of(positions);
  mesh.corners = std::move(corners);
  mesh.groups.resize(1);
  return mesh;
}

Mesh grid(Index side) {
  std::vector<float> positions;
  std::vector<Index> corners;
  for (Index y = 0; y < side; ++y)
    for (Index x = 0; x < side; ++x) {
      const float fx = static_cast<float>(x), fy = static_cast<float>(y);
      positions.insert(positions.end(), {fx, fy, 0.3f * std::sin(fx) * std::cos(fy)});
      if (x + 1 == side || y + 1 == side) continue;
      const Index a = y * side + x, b = a + 1, c = a + side, d = c + 1;
      corners.insert(corners.end(), {a, b, c, b, d, c});
    }
  return triangle_mesh(std::move(positions), std::move(corners));
}

Mesh torus(Index u, Index v) {
  std::vector<float> positions;
  std::vector<Index> corners;
  constexpr double kTurn = 2 * std::numbers::pi;
  for (Index i = 0; i < u; ++i)
    for (Index j = 0; j < v; ++j) {
      const double s = kTurn * i / u, t = kTurn * j / v, r = 2 + std::cos(t);
      for (const double x : {r * std::cos(s), r * std::sin(s), std::sin(t)})
        positions.push_back(static_cast<float>(x));
      const Index a = i * v + j, b = (i + 1) % u * v + j;
      const Index c = i * v + (j + 1) % v, d = (i + 1) % u * v + (j + 1) % v;
      corners.insert(corners.end(), {a, b, c, b, d, c});
    }
  return triangle_mesh(std::move(positions), std::move(corners));
}

Mesh cube(bool uv) {
  std::vector<float> positions;
  for (int i = 0; i < 8; ++i)
    for (const int bit : {1, 2, 4}) positions.push_back(i & bit ? 1.f : 0.f);
  // The four corners of each side, counter-clockwise from outside.
  constexpr Index kSides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                  {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  Mesh mesh = triangle_mesh(std::move(positions), {});
  std::vector<float> normals, uvs;
  for (Index side = 0; side < 6; ++side) {
    Index w[4];
    for (Index k = 0; k < 4; ++k) {
      w[k] = uv ? 4 * side + k : kSides[side][k];
      if (!uv) continue;
      mesh.wedge_vertex.push_back(kSides[side][k]);
      uvs.insert(uvs.end(), {k == 1 || k == 2 ? 1.f : 0.f, k >= 2 ? 1.f : 0.f});
      for (Index axis = 0; axis < 3; ++axis)
        normals.push_back(axis == side / 2 ? (side % 2 ? 1.f : -1.f) : 0.f);
    }
    mesh.corners.insert(mesh.corners.end(), {w[0], w[1], w[2], w[0], w[2], w[3]});
  }
  if (uv) {
    mesh.wedge_attributes.push_back({"NORMAL", ComponentType::f32, 3, false, bytes_of(normals)});
    mesh.wedge_attributes.push_back({"TEXCOORD_0", ComponentType::f32, 2, false, bytes_of(uvs)});
  }
  return mesh;
}

Mesh random_soup(std::uint32_t seed, Index vertices, Index faces) {
  std::mt19937 random(seed);
  const auto below = [&](Index n) { return static_cast<Index>(random() % n); };
  std::vector<float> positions(std::size_t{3} * vertices);
  for (float& x : positions) x = static_cast<float>(below(16));
  Mesh mesh = triangle_mesh(std::move(positions), {});
  std::vector<std::uint16_t> values;
  for (Index v = 0; v < vertices; ++v)
    for (Index n = 1 + below(3); n > 0; --n) {
      mesh.wedge_vertex.push_back(v);
      values.push_back(static_cast<std::uint16_t>(below(65536)));
    }
  mesh.wedge_attributes.push_back({"_VALUE", ComponentType::u16, 1, true, bytes_of(values)});
  mesh.groups.resize(1 + below(3));
  if (vertices == 0) return mesh;
  for (Index f = 0; f < faces; ++f) {
    for (int k = 0; k < 3; ++k) mesh.corners.push_back(below(mesh.wedge_count()));
    mesh.face_group.push_back(below(static_cast<Index>(mesh.groups.size())));
  }
  canonicalize(mesh);
  return mesh;
}

Mesh polygon_soup(std::uint32_t seed, Index vertices, Index faces) {
  Mesh mesh = random_soup(seed, vertices, 0);
  std::mt19937 random(seed);
  const auto below = [&](Index n) { return static_cast<Index>(random() % n); };
  mesh.face_first.assign(1, 0);
  for (Index f = 0; f < faces && vertices > 0; ++f) {
    for (Index n = 3 + below(4); n > 0; --n) mesh.corners.push_back(below(mesh.wedge_count()));
    mesh.face_first.push_back(static_cast<Index>(mesh.corners.size()));
    mesh.face_group.push_back(below(static_cast<Index>(mesh.groups.size())));
  }
  canonicalize(mesh);
  return mesh;
}

Mesh quad_mesh(std::vector<float> positions, std::vector<Index> corners) {
  Mesh mesh = triangle_mesh(std::move(positions), std::move(corners));
  for (Index first = 0; first <= mesh.corners.size(); first += 4) mesh.face_first.push_back(first);
  return mesh;
}

Mesh joined_to_quads(const Mesh& triangles) {
  Mesh mesh = triangles;
  mesh.corners.clear();
  mesh.face_first.assign(1, 0);
  for (Index f = 0; f + 1 < triangles.face_count(); f += 2) {
    const auto t = triangles.face(f), u = triangles.face(f + 1);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        if (t[i] == u[(j + 1) % 3] && t[(i + 1) % 3] == u[j])
          mesh.corners.insert(mesh.corners.end(),
                              {t[(i + 1) % 3], t[(i + 2) % 3], t[i], u[(j + 2) % 3]});
    mesh.face_first.push_back(static_cast<Index>(mesh.corners.size()));
  }
  return mesh;
}

Mesh voxel_torus(Index side) {
  using Cell = std::array<Index, 3>;  // ~0 and side are outside
  const auto is_in = [side](const Cell& c) {
    double x[3];
    for (std::size_t k = 0; k < 3; ++k) {
      if (c[k] >= side) return false;
      x[k] = (c[k] + 0.5) / side * 2 - 1;
    }
    const double r = std::hypot(x[0], x[1]) - 0.6;
    return r * r + x[2] * x[2] < 0.08;
  };
  std::vector<float> positions;
  std::vector<Index> corners, number(std::size_t{side + 1} * (side + 1) * (side + 1), kNone);
  const auto vertex = [&](const Cell& c) {
    Index& n = number[(std::size_t{c[0]} * (side + 1) + c[1]) * (side + 1) + c[2]];
    if (n != kNone) return n;
    for (const Index x : c) positions.push_back(static_cast<float>(x));
    return n = static_cast<Index>(positions.size() / 3 - 1);
  };
  for (Index i = 0; i < side * side * side; ++i) {
    const Cell cell{i / side / side, i / side % side, i % side};
    if (!is_in(cell)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const bool above : {false, true}) {
        Cell beside = cell, corner = cell;
        beside[axis] += above ? 1 : ~Index{0};
        if (is_in(beside)) continue;
        corner[axis] += above;
        const std::size_t u = (axis + (above ? 1 : 2)) % 3, v = 3 - axis - u;
        for (const std::size_t step : {u, v, u, v}) {
          corners.push_back(vertex(corner));
          corner[step] = corner[step] == cell[step] ? cell[step] + 1 : cell[step];
        }
      }
  }
  return quad_mesh(std::move(positions), std::move(corners));
}

}  // namespace pstrips::test
