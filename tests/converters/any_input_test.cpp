// Meshes that nobody would make on purpose come back bit for bit, whatever the options.

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <bit>
#include <cstring>
#include <random>

#include "converters/capacity.h"
#include "converters/decode.h"
#include "converters/encode.h"
#include "tests/support/meshes.h"
#include "tests/support/round_trip.h"

namespace pstrips {
namespace {

// Bit patterns of floats that arithmetic would not leave as they are, or not survive.
constexpr std::array<std::uint32_t, 10> kOddFloats = {0x7fc00000,   // NaN
                                                      0x7f800001,   // a signalling NaN
                                                      0xffc12345,   // a negative NaN with a payload
                                                      0x7f800000,   // infinity
                                                      0xff800000,   // its opposite
                                                      0x80000000,   // -0
                                                      0x00000001,   // the least denormal
                                                      0x807fffff,   // the largest negative one
                                                      0x7149f2ca,   // 1e30
                                                      0xff7fffff};  // the lowest number

void put_float(Mesh& mesh, std::size_t component, std::uint32_t bits) {
  std::memcpy(mesh.position.data.data() + 4 * component, &bits, sizeof bits);
}

// Everything at once: a soup of triangles or polygons, copies of faces, fans, spare vertices, odd
// floats in a few places.
Mesh nasty_mesh(std::uint32_t seed, Index vertices, Index faces, Index odd_floats) {
  std::mt19937 random(seed);
  const auto below = [&](std::size_t n) { return static_cast<Index>(random() % n); };
  Mesh mesh = seed % 3 == 0 ? test::polygon_soup(seed, vertices, faces)
                            : test::random_soup(seed, vertices, faces);
  if (mesh.face_first.empty() && mesh.face_count() > 0)
    for (Index copies = below(5); copies > 0; --copies) {
      const Index f = below(mesh.face_count());
      const std::vector<Index> loop(mesh.face(f).begin(), mesh.face(f).end());
      mesh.corners.insert(mesh.corners.end(), loop.begin(), loop.end());
      if (!mesh.face_group.empty()) mesh.face_group.push_back(mesh.face_group[f]);
    }
  if (vertices > 0)
    for (; odd_floats > 0; --odd_floats)
      put_float(mesh, below(std::size_t{3} * vertices), kOddFloats[below(kOddFloats.size())]);
  return mesh;
}

RC_GTEST_PROP(AnyInput, ComesBackWithEveryCombinationOfOptions, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const auto vertices = *rc::gen::inRange<Index>(0, 50);
  const auto faces = *rc::gen::inRange<Index>(0, 90);
  const auto odd_floats = *rc::gen::inRange<Index>(0, 12);
  const Model model = test::model_of(nasty_mesh(seed, vertices, faces, odd_floats));
  EncodeOptions options;
  options.packet_min = *rc::gen::inRange<Index>(1, 20);
  options.stripifier =
      *rc::gen::element<std::string>("best", "sgi-strips", "multi-path", "stripe-lookahead");
  options.base_share = *rc::gen::element(0.0, 0.05, 1.0);
  options.placement = *rc::gen::element(Placement::subset, Placement::optimal);
  options.metric = *rc::gen::element(Metric::qem, Metric::memoryless);
  for (const MapEncoding encoding : {MapEncoding::naive, MapEncoding::offset})
    for (const bool keep_order : {false, true}) {
      options.encoding = encoding;
      options.keep_order = keep_order;
      for (const bool xml : {false, true}) {
        const std::string wrong = test::round_trip(model, options, xml);
        RC_ASSERT(wrong == "");
      }
    }
}

struct Large {
  const char* name;
  Mesh mesh;
};

Mesh wheel(Index rim) {
  std::vector<float> positions{0, 0, 1};
  std::vector<Index> corners;
  for (Index i = 1; i <= rim; ++i) {
    const double turn = 2 * 3.14159265358979 * i / rim;
    positions.insert(positions.end(),
                     {static_cast<float>(std::cos(turn)), static_cast<float>(std::sin(turn)), 0});
    corners.insert(corners.end(), {0, i, i % rim + 1});
  }
  return test::triangle_mesh(std::move(positions), std::move(corners));
}

Mesh scattered_triangles(Index count) {
  std::vector<float> positions;
  std::vector<Index> corners;
  for (Index i = 0; i < count; ++i) {
    const auto x = static_cast<float>(i % 1000), y = static_cast<float>(i / 1000);
    positions.insert(positions.end(), {x, y, 0, x + 0.5f, y, 0, x, y + 0.5f, 0});
    corners.insert(corners.end(), {3 * i, 3 * i + 1, 3 * i + 2});
  }
  return test::triangle_mesh(std::move(positions), std::move(corners));
}

Mesh scaled(Mesh mesh, double factor) {
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    for (std::size_t c = 0; c < 3; ++c)
      set_component(mesh.position, v, c, factor * component(mesh.position, v, c));
  return mesh;
}

class LargeInput : public testing::TestWithParam<Placement> {};

TEST_P(LargeInput, ComesBack) {
  const Large kRows[] = {{"one_vertex_of_valence_100000", wheel(100'000)},
                         {"hundred_thousand_components", scattered_triangles(100'000)},
                         {"extents_of_1e30", scaled(test::torus(60, 40), 1e30)},
                         {"extents_of_1e-42", scaled(test::torus(60, 40), 1e-42)}};
  for (const Large& row : kRows) {
    SCOPED_TRACE(row.name);
    EncodeOptions options;
    options.keep_order = true;
    options.placement = GetParam();
    const auto strips = encode(test::model_of(row.mesh), options);
    ASSERT_TRUE(strips);
    EXPECT_LE(strips->bases[0].triangles, row.mesh.face_count() / 20) << "the base is reached";
    EXPECT_EQ(decode(*strips)->meshes[0], row.mesh);
    EXPECT_EQ(test::round_trip(test::model_of(row.mesh), options, false), "");
  }
}

INSTANTIATE_TEST_SUITE_P(Placements, LargeInput,
                         testing::Values(Placement::subset, Placement::optimal));

TEST(AnyInput, VerticesThatAreNotFiniteStandInTheBaseUnmoved) {
  Mesh mesh = test::torus(20, 16);
  for (std::size_t i = 0; i < kOddFloats.size(); ++i) put_float(mesh, 37 * i, kOddFloats[i]);
  for (const Placement placement : {Placement::subset, Placement::optimal}) {
    EncodeOptions options;
    options.base_share = 0;
    options.placement = placement;
    const auto strips = encode(test::model_of(mesh), options);
    ASSERT_TRUE(strips);
    const Mesh base = decode(*strips, 0)->meshes[0];
    for (std::size_t i = 0; i < 5; ++i) {  // those before -0
      const ByteView wanted = mesh.position.element(37 * i / 3);
      bool found = false;
      for (std::size_t v = 0; v < base.vertex_count(); ++v)
        found |= std::ranges::equal(base.position.element(v), wanted);
      EXPECT_TRUE(found) << i;
    }
  }
}

TEST(Capacity, RefusesWhatCannotBeCountedOrHeld) {
  constexpr std::uint64_t kAll = ~std::uint64_t{0};
  EXPECT_TRUE(check_capacity({}, 0));
  EXPECT_TRUE(check_capacity({.triangles = kMaxCount / 3}, kAll));
  const auto too_many = check_capacity({.triangles = 1'500'000'000}, kAll);
  ASSERT_FALSE(too_many);
  EXPECT_EQ(too_many.error().code, ErrorCode::over_limit);
  EXPECT_EQ(too_many.error().message,
            "4500000000 corners of triangles, more than the limit of 4294967040");
  const WorkSize size{.vertices = 500, .wedges = 600, .triangles = 1000, .attribute_numbers = 5};
  const std::uint64_t bytes = encoding_bytes(size);
  EXPECT_TRUE(check_capacity(size, bytes));
  const auto too_large = check_capacity(size, bytes - 1);
  ASSERT_FALSE(too_large);
  EXPECT_NE(too_large.error().message.find(std::to_string(bytes)), std::string::npos);
}

TEST(Capacity, CountsTrianglesOfPolygonsAndNumbersOfAttributes) {
  const Mesh cube = test::cube(true);
  EXPECT_EQ(work_size(cube).triangles, 12u);
  EXPECT_EQ(work_size(cube).wedges, 24u);
  EXPECT_EQ(work_size(cube).attribute_numbers, 5u);
  EXPECT_EQ(work_size(test::joined_to_quads(cube)).triangles, 12u);
}

TEST(Encode, RefusesAMeshBeyondMemoryBeforeWorkStarts) {
  Model model;
  model.meshes = {test::grid(2), test::grid(40)};
  EncodeOptions options;
  options.memory_bytes = 100'000;
  bool started = false;
  const auto strips = encode(model, options, [&](std::string_view, double) {
    started = true;
    return true;
  });
  ASSERT_FALSE(strips);
  EXPECT_EQ(strips.error().code, ErrorCode::over_limit);
  EXPECT_EQ(strips.error().path, "/meshes/1");
  EXPECT_FALSE(started);
}

}  // namespace
}  // namespace pstrips
