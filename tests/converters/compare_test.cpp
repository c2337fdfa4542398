#include "converters/compare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>

#include "tests/support/meshes.h"

namespace pstrips {
namespace {

// The same mesh with faces shuffled and turned, vertices and wedges renumbered.
Mesh shuffled(const Mesh& mesh, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto permutation = [&](Index n) {
    std::vector<Index> p(n);
    for (Index i = 0; i < n; ++i) p[i] = i;
    std::shuffle(p.begin(), p.end(), random);
    return p;
  };
  const auto permute = [](Attribute& a, const std::vector<Index>& to) {
    Bytes out(a.data.size());
    for (std::size_t i = 0; i < to.size(); ++i)
      std::memcpy(&out[to[i] * a.element_bytes()], &a.data[i * a.element_bytes()],
                  a.element_bytes());
    a.data = out;
  };
  Mesh out = mesh;
  const auto v = permutation(mesh.vertex_count());
  const auto w = mesh.wedge_vertex.empty() ? v : permutation(mesh.wedge_count());
  permute(out.position, v);
  for (Attribute& a : out.wedge_attributes) permute(a, w);
  out.wedge_vertex.resize(mesh.wedge_count());
  for (Index i = 0; i < mesh.wedge_count(); ++i) out.wedge_vertex[w[i]] = v[mesh.vertex_of(i)];
  out.corners.clear();
  for (const Index f : permutation(mesh.face_count())) {
    const auto face = mesh.face(f);
    const std::size_t turn = random() % 3;
    for (std::size_t k = 0; k < 3; ++k) out.corners.push_back(w[face[(k + turn) % 3]]);
  }
  canonicalize(out);
  return out;
}

TEST(Compare, AMeshWithItselfIsExact) {
  for (const Mesh& mesh : {test::grid(4), test::cube(true), test::random_soup(1, 10, 30)})
    EXPECT_EQ(compare(test::model_of(mesh), test::model_of(mesh)).equivalence, Equivalence::exact);
}

TEST(Compare, AShuffledMeshIsReordered) {
  for (const std::uint32_t seed : {1u, 2u, 3u})
    for (const Mesh& mesh : {test::grid(4), test::cube(true), test::torus(5, 4)}) {
      const Comparison c = compare(test::model_of(mesh), test::model_of(shuffled(mesh, seed)));
      EXPECT_EQ(c.equivalence, Equivalence::reordered);
      EXPECT_TRUE(c.differences.empty());
    }
}

TEST(Compare, AFlippedTriangleIsADifference) {
  Mesh flipped = test::grid(4);
  std::swap(flipped.corners[0], flipped.corners[1]);
  const Comparison c = compare(test::model_of(test::grid(4)), test::model_of(flipped));
  EXPECT_EQ(c.equivalence, Equivalence::different);
  EXPECT_EQ(c.differences, std::vector<std::string>{"faces"});
  EXPECT_LT(c.hausdorff, 1e-12);
}

TEST(Compare, AMovedVertexIsMeasured) {
  Mesh moved = test::cube(false);
  const float x = -1;
  std::memcpy(moved.position.data.data(), &x, sizeof x);  // a corner, one edge length outwards
  const Comparison c = compare(test::model_of(test::cube(false)), test::model_of(moved));
  EXPECT_EQ(c.equivalence, Equivalence::different);
  EXPECT_NEAR(c.hausdorff, 1 / std::sqrt(6.0), 0.01);  // the larger box is 2 x 1 x 1
  EXPECT_GT(c.rms, 0);
  EXPECT_LT(c.rms, c.hausdorff);
}

TEST(Compare, OneBitOfAnAttributeIsADifference) {
  Mesh changed = test::cube(true);
  changed.wedge_attributes[1].data[3] ^= std::byte{1};
  const Comparison c = compare(test::model_of(test::cube(true)), test::model_of(changed));
  EXPECT_EQ(c.equivalence, Equivalence::different);
  ASSERT_EQ(c.attributes.size(), 1u);
  EXPECT_EQ(c.attributes[0].semantic, "TEXCOORD_0");
}

TEST(Compare, ADroppedAttributeIsNamed) {
  Mesh less = test::cube(true);
  less.wedge_attributes.pop_back();
  const Comparison c = compare(test::model_of(test::cube(true)), test::model_of(less));
  EXPECT_EQ(c.differences,
            std::vector<std::string>{"wedge attribute TEXCOORD_0: only in the first"});
}

TEST(Compare, ComponentTypesDoNotMatter) {
  Mesh doubles = test::grid(3);
  const std::vector<double> p = positions_as_double(doubles);
  doubles.position.type = ComponentType::f64;
  const ByteView bytes = std::as_bytes(std::span(p));
  doubles.position.data.assign(bytes.begin(), bytes.end());
  EXPECT_EQ(compare(test::model_of(test::grid(3)), test::model_of(doubles)).equivalence,
            Equivalence::exact);
}

TEST(Compare, NothingIsInfinitelyFarFromSomething) {
  const Comparison c = compare({}, test::model_of(test::cube(false)));
  EXPECT_EQ(c.equivalence, Equivalence::different);
  EXPECT_TRUE(std::isinf(c.hausdorff));
  EXPECT_EQ(compare({}, {}).equivalence, Equivalence::exact);
}

}  // namespace
}  // namespace pstrips
