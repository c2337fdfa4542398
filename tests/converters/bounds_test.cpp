// What packets promise of their errors, against what is measured at their levels.

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <random>
#include <set>
#include <string>

#include "codecs/measure/measure.h"
#include "codecs/vsplit/level.h"
#include "converters/encode.h"
#include "tests/support/meshes.h"
#include "tests/support/models.h"

namespace pstrips {
namespace {

constexpr float kUnbounded = std::numeric_limits<float>::max();

struct Shown {
  std::vector<double> positions;
  std::vector<Index> triangles;
};

// The surface of a level [spec/model.md §5]: its triangles, and its vertices that have a triangle
// at full resolution as triangles without extent.
Shown shown(const Level& level, const std::set<Index>& drawn) {
  Attribute position = level.mesh().position;
  position.data.assign(level.positions().begin(), level.positions().end());
  Shown out;
  for (std::size_t v = 0; v < level.vertex_count(); ++v)
    for (std::size_t k = 0; k < 3; ++k)
      out.positions.push_back(k < position.count ? component(position, v, k) : 0);
  for (const StripRange& strip : strip_ranges(level.resolved()))
    for (Index i = strip.first; i + 2 < strip.end; ++i) {
      const Index a = level.vertex_of(level.resolved()[i]),
                  b = level.vertex_of(level.resolved()[i + 1]),
                  c = level.vertex_of(level.resolved()[i + 2]);
      if (a != b && b != c && c != a) out.triangles.insert(out.triangles.end(), {a, b, c});
    }
  for (const Index v : drawn)
    if (v < level.vertex_count()) out.triangles.insert(out.triangles.end(), {v, v, v});
  return out;
}

// What a packet promises and does not hold; empty when all is well.
std::string broken_promise(const ProgressiveStrips& strips, std::uint64_t samples) {
  std::vector<Shown> full;
  std::vector<std::set<Index>> drawn;
  std::vector<Level> levels;
  for (const ProgressiveMesh& mesh : strips.meshes) {
    Level level(mesh);
    level.refine_fully();
    const std::vector<Index> triangles = shown(level, {}).triangles;
    drawn.emplace_back(triangles.begin(), triangles.end());
    full.push_back(shown(level, drawn.back()));
    levels.emplace_back(mesh);
  }
  std::vector<Packet> packets = strips.bases;
  packets.insert(packets.end(), strips.packets.begin(), strips.packets.end());
  for (std::size_t i = 0; i < packets.size(); ++i) {
    const Packet& packet = packets[i];
    levels[packet.mesh].refine(packet.vsplits);
    const Shown now = shown(levels[packet.mesh], drawn[packet.mesh]);
    const Shown& all = full[packet.mesh];
    if (all.triangles.empty()) continue;
    const Distance d =
        measure_distance({all.positions, all.triangles}, {now.positions, now.triangles}, samples);
    // Distances are roots of sums of squares of differences between coordinates.
    const double rounding = 1e-7 * bounding_box_diagonal(all.positions);
    if (d.hausdorff > packet.error + rounding ||
        d.a_to_b.maximum > packet.one_sided_error + rounding)
      return "packet " + std::to_string(i) + " promises " + std::to_string(packet.error) + " and " +
             std::to_string(packet.one_sided_error) + ", there it is " +
             std::to_string(d.a_to_b.maximum) + ", back " + std::to_string(d.b_to_a.maximum);
    if (!(packet.one_sided_error <= packet.error && packet.error <= kUnbounded))
      return "packet " + std::to_string(i) + " promises nothing";
  }
  return "";
}

RC_GTEST_PROP(Bounds, HoldForAnyMesh, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const auto vertices = *rc::gen::inRange<Index>(3, 50);
  const auto faces = *rc::gen::inRange<Index>(1, 90);
  Mesh mesh = seed % 3 == 0 ? test::polygon_soup(seed, vertices, faces)
                            : test::random_soup(seed, vertices, faces);
  std::mt19937 random(seed);
  for (auto odd = *rc::gen::inRange(0, 6); odd > 0; --odd) {
    const float value = odd % 2 ? std::numeric_limits<float>::quiet_NaN() : -0.f;
    std::memcpy(mesh.position.data.data() + 4 * (random() % (3 * vertices)), &value, 4);
  }
  EncodeOptions options;
  options.base_share = 0;
  options.packet_min = *rc::gen::inRange<Index>(1, 8);
  options.placement = *rc::gen::element(Placement::subset, Placement::optimal);
  options.metric = *rc::gen::element(Metric::qem, Metric::memoryless);
  RC_ASSERT(broken_promise(encode(test::model_of(mesh), options).value(), 500) == "");
}

// Placements are rounded to what the file stores, which moves them by up to half a unit.
TEST(Bounds, HoldForIntegerPositions) {
  for (const ComponentType type : {ComponentType::i8, ComponentType::i16}) {
    Mesh mesh = test::torus(24, 16);
    const Attribute real = mesh.position;
    mesh.position = {"POSITION", type, 3, false, {}};
    mesh.position.data.resize(real.elements() * mesh.position.element_bytes());
    for (Index v = 0; v < real.elements(); ++v)
      for (std::size_t k = 0; k < 3; ++k)
        set_component(mesh.position, v, k, std::round(8 * component(real, v, k)));
    for (const Placement placement : {Placement::subset, Placement::optimal})
      EXPECT_EQ(broken_promise(encode(test::model_of(mesh),
                                      {.base_share = 0, .placement = placement, .packet_min = 10})
                                   .value(),
                               2000),
                "");
  }
}

TEST(Bounds, AreZeroAtFullResolutionOnly) {
  const ProgressiveStrips strips = encode(test::model_of(test::torus(40, 30)), {}).value();
  EXPECT_GT(strips.bases[0].one_sided_error, 0.01f);
  EXPECT_EQ(strips.packets.back().error, 0);
  EXPECT_EQ(strips.packets.back().one_sided_error, 0);
}

// Vertices outside all triangles appear after everything that is drawn.
TEST(Bounds, DoNotCountVerticesThatAreNotDrawn) {
  Mesh mesh = test::torus(20, 10);
  const float far[3] = {1000, 0, 0};
  const ByteView bytes = std::as_bytes(std::span(far));
  mesh.position.data.insert(mesh.position.data.end(), bytes.begin(), bytes.end());
  const ProgressiveStrips strips = encode(test::model_of(mesh), {.packet_min = 1}).value();
  EXPECT_LT(strips.bases[0].error, 10);
  EXPECT_EQ(broken_promise(strips, 2000), "");
}

TEST(Bounds, LimitTheBase) {
  const Model model = test::model_of(test::torus(60, 40));
  Index triangles = 0;
  for (const double limit : {0.5, 0.1, 0.02, 1e-9}) {
    const ProgressiveStrips strips = encode(model, {.base_error = limit}).value();
    EXPECT_LE(strips.bases[0].error, limit);
    EXPECT_GT(strips.bases[0].triangles, triangles);
    triangles = strips.bases[0].triangles;
    EXPECT_EQ(broken_promise(strips, 2000), "");
  }
  EXPECT_EQ(triangles, 4800u);
}

TEST(Bounds, DoNotDependOnThreads) {
  const Model model = test::model_of(test::torus(60, 40));
  EXPECT_EQ(encode(model, {.threads = 1}).value(), encode(model, {.threads = 2}).value());
}

class ModelBounds : public testing::TestWithParam<std::string> {};

TEST_P(ModelBounds, Hold) {
  const std::optional<Mesh> mesh = test::model_mesh(GetParam());
  ASSERT_TRUE(mesh);
  for (const Placement placement : {Placement::subset, Placement::optimal}) {
    EncodeOptions options{.base_share = 0.01, .placement = placement, .packet_growth = 4};
    if (placement == Placement::optimal) options.metric = Metric::memoryless;
    EXPECT_EQ(broken_promise(encode(test::model_of(*mesh), options).value(), 20'000), "");
  }
}

INSTANTIATE_TEST_SUITE_P(Each, ModelBounds,
                         testing::ValuesIn(test::those_here(
                             {"shipped/surfaces/double_ring.ply", "shipped/surfaces/terrain.ply",
                              "shipped/surfaces/non_manifold.ply", "classic/fandisk.obj",
                              "classic/blade.ply", "classic/bun_zipper.ply",
                              "ply-variety/models_bunny.ply", "nasty/topology/bunny2.ply"})));

}  // namespace
}  // namespace pstrips
