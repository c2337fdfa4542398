// Bases that nobody asked for can be drawn, and numbers of triangles are met.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "converters/compare.h"
#include "converters/decode.h"
#include "converters/encode.h"
#include "tests/support/meshes.h"

namespace pstrips {
namespace {

std::vector<EncodeOptions> both_profiles() {
  std::vector<EncodeOptions> out(2);
  out[1].profile = Profile::compact;
  return out;
}

// Several meshes in one, as far apart as `step`.
Mesh side_by_side(const std::vector<Mesh>& parts, double step) {
  Mesh out = test::triangle_mesh({}, {});
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Index first = out.vertex_count();
    Attribute position = parts[i].position;
    for (std::size_t v = 0; v < position.elements(); ++v)
      set_component(position, v, 0, component(position, v, 0) + step * static_cast<double>(i));
    out.position.data.insert(out.position.data.end(), position.data.begin(), position.data.end());
    for (const Index corner : parts[i].corners) out.corners.push_back(first + corner);
  }
  return out;
}

// Of triangles that share vertices; by a vertex each.
std::map<Index, Index> triangles_of_components(const Mesh& mesh) {
  std::vector<Index> label(mesh.vertex_count());
  for (Index v = 0; v < label.size(); ++v) label[v] = v;
  for (bool changed = true; changed;) {
    changed = false;
    for (Index f = 0; f < mesh.face_count(); ++f) {
      Index least = kNone;
      for (const Index w : mesh.face(f)) least = std::min(least, label[mesh.vertex_of(w)]);
      for (const Index w : mesh.face(f))
        changed |= std::exchange(label[mesh.vertex_of(w)], least) != least;
    }
  }
  std::map<Index, Index> out;
  for (Index f = 0; f < mesh.face_count(); ++f) ++out[label[mesh.vertex_of(mesh.face(f)[0])]];
  return out;
}

Mesh base_of(const Mesh& mesh, const EncodeOptions& options) {
  return decode(encode(test::model_of(mesh), options).value(), 0).value().meshes[0];
}

double volume(const Mesh& mesh) {
  const std::vector<double> p = positions_as_double(mesh);
  double sum = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto at = [&](Index k, Index c) { return p[3 * mesh.vertex_of(mesh.face(f)[k]) + c]; };
    for (Index c = 0; c < 3; ++c)
      sum += at(0, c) *
             (at(1, (c + 1) % 3) * at(2, (c + 2) % 3) - at(1, (c + 2) % 3) * at(2, (c + 1) % 3));
  }
  return sum / 6;
}

TEST(SmallMeshes, KeepATetrahedronOfABox) {
  for (const EncodeOptions& options : both_profiles()) {
    const Mesh base = base_of(test::cube(false), options);
    EXPECT_GE(base.face_count(), 4u);
    EXPECT_GT(std::abs(volume(base)), 0.1 * std::abs(volume(test::cube(false))));
  }
}

TEST(SmallMeshes, KeepEachComponent) {
  const Mesh flat = test::triangle_mesh({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, {0, 1, 2, 0, 2, 3});
  const Mesh one = test::triangle_mesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2});
  const Mesh mesh = side_by_side({test::torus(12, 8), test::cube(false), flat, one}, 20);
  for (const EncodeOptions& options : both_profiles()) {
    const auto triangles = triangles_of_components(base_of(mesh, options));
    ASSERT_EQ(triangles.size(), 4u);
    // Of torus and cube a closed surface, of the others what there is.
    std::multiset<Index> least;
    for (const auto& [vertex, count] : triangles) least.insert(std::min(count, Index{4}));
    EXPECT_EQ(least, (std::multiset<Index>{1, 2, 4, 4}));
  }
}

TEST(SmallMeshes, GiveWayToABaseThatWasAskedFor) {
  EncodeOptions options;
  options.base_triangles = 0;
  EXPECT_EQ(base_of(test::cube(false), options).face_count(), 0u);
}

TEST(SplitLevel, MeetsNumbersOfTriangles) {
  const Mesh mesh = test::torus(32, 23);
  for (const EncodeOptions& options : both_profiles()) {
    const ProgressiveStrips strips = encode(test::model_of(mesh), options).value();
    for (const std::uint64_t wanted : {330u, 580u, 1000u, 1400u}) {
      const SplitLevel level = split_level(strips, wanted);
      const auto shown = decode(strips, level).value().meshes[0].face_count();
      EXPECT_LE(shown, wanted);
      EXPECT_GE(static_cast<double>(shown), 0.98 * static_cast<double>(wanted));
    }
    EXPECT_EQ(split_level(strips, mesh.face_count()).packets, strips.packets.size());
    EXPECT_EQ(split_level(strips, 0).more_vsplits, 0u);
  }
}

TEST(SplitLevel, CountsOtherMeshes) {
  Model model;
  model.meshes = {test::torus(24, 16), test::grid(20)};
  const ProgressiveStrips strips = encode(model, {}).value();
  const SplitLevel level = split_level(strips, 500);
  const Model shown = decode(strips, level).value();
  const auto triangles = shown.meshes[0].face_count() + shown.meshes[1].face_count();
  EXPECT_LE(triangles, 500u);
  EXPECT_GE(triangles, 490u);
}

// A closed shell over a grid of n × n: its upper and its lower side, and a rim between.
Mesh shell(Index n, double thickness, double height) {
  std::vector<float> positions;
  for (const double below : {0., thickness})
    for (Index y = 0; y < n; ++y)
      for (Index x = 0; x < n; ++x) {
        const double u = x / (n - 1.), v = y / (n - 1.);
        const double z =
            height * std::sin(std::numbers::pi * u) * std::sin(std::numbers::pi * v) - below;
        positions.insert(positions.end(),
                         {static_cast<float>(u), static_cast<float>(v), static_cast<float>(z)});
      }
  std::vector<Index> corners;
  const auto quad = [&](Index a, Index b, Index c, Index d) {
    corners.insert(corners.end(), {a, b, c, a, c, d});
  };
  const Index lower = n * n;
  for (Index y = 0; y + 1 < n; ++y)
    for (Index x = 0; x + 1 < n; ++x) {
      const Index i = y * n + x;
      quad(i, i + 1, i + n + 1, i + n);
      quad(lower + i, lower + i + n, lower + i + n + 1, lower + i + 1);
    }
  for (Index i = 0; i + 1 < n; ++i) {
    const Index right = n - 1, top = n * (n - 1);
    quad(i, lower + i, lower + i + 1, i + 1);
    quad(top + i, top + i + 1, lower + top + i + 1, lower + top + i);
    quad(n * i, n * i + n, lower + n * i + n, lower + n * i);
    quad(right + n * i, lower + right + n * i, lower + right + n * i + n, right + n * i + n);
  }
  return test::triangle_mesh(positions, corners);
}

double distance_of_base(const Mesh& mesh, Placement placement) {
  EncodeOptions options;
  options.placement = placement;
  const Model model = test::model_of(mesh);
  return compare(model, decode(encode(model, options).value(), 0).value(), 20'000).hausdorff;
}

TEST(ThinShells, AreNoFartherWithOptimalPlacement) {
  for (const double height : {0., 0.3}) {
    const Mesh mesh = shell(25, 0.002, height);
    // A flat one loses nothing but for rounding.
    EXPECT_LE(distance_of_base(mesh, Placement::optimal),
              1.02 * distance_of_base(mesh, Placement::subset) + 1e-5)
        << height;
  }
}

}  // namespace
}  // namespace pstrips
