// Encode and decode as a whole: exact return, packets, levels, cuts, interleaving.

#include "converters/encode.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "codecs/stripify/stripify.h"
#include "converters/decode.h"
#include "converters/text_collapses.h"
#include "formats/pstrip/payload/check.h"
#include "formats/pstrip/payload/digest.h"
#include "formats/pstrip/text/text.h"
#include "tests/support/meshes.h"

namespace pstrips {
namespace {

Model model_of(std::vector<Mesh> meshes) {
  Model model;
  model.meshes = std::move(meshes);
  return model;
}

ProgressiveStrips encoded(const Model& model, const EncodeOptions& options) {
  auto strips = encode(model, options);
  EXPECT_TRUE(strips) << strips.error().message;
  EXPECT_TRUE(check(*strips)) << check(*strips).error().message << check(*strips).error().path;
  return std::move(strips).value();
}

RC_GTEST_PROP(Encode, AnySoupComesBackExactlyInBothEncodings, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const auto vertices = *rc::gen::inRange<Index>(0, 60);
  const auto faces = *rc::gen::inRange<Index>(0, 120);
  const Model model = model_of({test::random_soup(seed, vertices, faces)});
  for (const MapEncoding encoding : {MapEncoding::naive, MapEncoding::offset}) {
    EncodeOptions options;
    options.encoding = encoding;
    options.keep_order = true;
    options.packet_min = 3;
    const auto strips = encode(model, options);
    RC_ASSERT(strips);
    RC_ASSERT(check(*strips).has_value());
    RC_ASSERT(decode(*strips)->meshes == model.meshes);
  }
}

// Every way to choose collapses.
std::vector<EncodeOptions> manners() {
  std::vector<EncodeOptions> out;
  for (const Placement placement : {Placement::subset, Placement::optimal})
    for (const Metric metric : {Metric::qem, Metric::memoryless}) {
      out.emplace_back();
      out.back().placement = placement;
      out.back().metric = metric;
      out.back().keep_order = true;
      out.back().packet_min = 5;
    }
  return out;
}

RC_GTEST_PROP(Encode, AnySoupComesBackExactlyWhereverVerticesAreMoved, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const auto vertices = *rc::gen::inRange<Index>(0, 60);
  const auto faces = *rc::gen::inRange<Index>(0, 120);
  const Model model = model_of({test::random_soup(seed, vertices, faces)});
  for (EncodeOptions options : manners()) {
    options.base_share = 0;
    const auto strips = encode(model, options);
    RC_ASSERT(strips);
    RC_ASSERT(check(*strips).has_value());
    RC_ASSERT(decode(*strips)->meshes == model.meshes);
  }
}

// A mesh whose positions have another type, scaled to fill it.
Mesh with_positions(const Mesh& mesh, ComponentType type, std::uint8_t count, bool normalized) {
  Mesh out = mesh;
  out.position = {"POSITION", type, count, normalized, {}};
  out.position.data.resize(out.position.element_bytes() * mesh.vertex_count());
  const double scale = type >= ComponentType::f32 ? 1 : normalized ? 0.1 : 12;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    for (std::size_t c = 0; c < count; ++c)
      set_component(out.position, v, c,
                    c < 3 ? scale * component(mesh.position, v, c) : static_cast<double>(v % 7));
  return out;
}

TEST(Encode, MovedVerticesHaveTheTypeOfPositions) {
  const Mesh torus = test::torus(24, 16);
  for (const Mesh& mesh : {with_positions(torus, ComponentType::i8, 3, false),
                           with_positions(torus, ComponentType::i16, 3, true),
                           with_positions(torus, ComponentType::f64, 3, false),
                           with_positions(torus, ComponentType::f32, 2, false),
                           with_positions(torus, ComponentType::f32, 5, false)})
    for (const EncodeOptions& options : manners()) {
      SCOPED_TRACE(name_of(mesh.position.type));
      const ProgressiveStrips strips = encoded(model_of({mesh}), options);
      EXPECT_EQ(decode(strips)->meshes[0], mesh);
      EXPECT_EQ(strips.meshes[0].placement, options.placement);
      EXPECT_TRUE(strips.meshes[0].position.same_format(mesh.position));
    }
}

TEST(Encode, FreePlacementGivesBetterLevels) {
  const Model model = model_of({test::torus(60, 40)});
  const auto volume_at_base = [&](const EncodeOptions& options) {
    const Mesh base = decode(encoded(model, options), 0)->meshes[0];
    const std::vector<double> p = positions_as_double(base);
    double sum = 0;
    for (std::size_t t = 0; t < base.corners.size(); t += 3) {
      const double *a = &p[3 * base.corners[t]], *b = &p[3 * base.corners[t + 1]],
                   *c = &p[3 * base.corners[t + 2]];
      sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
             a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    return sum / 6;
  };
  EncodeOptions options = manners().back();  // optimal, memoryless: keeps the volume
  options.base_share = 1;
  const double whole = volume_at_base(options);
  options.base_share = 0.05;
  EXPECT_NEAR(volume_at_base(options), whole, 1e-3 * std::abs(whole));
  options.placement = Placement::subset;
  EXPECT_GT(std::abs(volume_at_base(options) - whole), 1e-2 * std::abs(whole));
}

TEST(Encode, TextFilesKeepWhereParentsStand) {
  EncodeOptions options = manners().back();
  options.base_share = 0.1;
  for (const Placement placement : {Placement::optimal, Placement::subset}) {
    options.placement = placement;
    const ProgressiveStrips strips = encoded(model_of({test::torus(30, 20)}), options);
    const auto text = read_text(write_text(strips)->bytes);
    ASSERT_TRUE(text);
    const auto again = encode_with(model_of({text->mesh}), {collapses_of(*text)}, options);
    ASSERT_TRUE(again);
    EXPECT_EQ(again->meshes[0].placement, placement);
    const auto sorted_positions = [](const ProgressiveStrips& from) {
      std::vector<double> p = positions_as_double(decode(from, 0)->meshes[0]);
      std::ranges::sort(p);
      return p;
    };
    EXPECT_EQ(sorted_positions(*again), sorted_positions(strips));
  }
}

TEST(Encode, ReportsHowCollapsesWereChosen) {
  const Model model = model_of({test::torus(20, 20), test::random_soup(7, 40, 200)});
  std::vector<SimplifyReport> reports;
  const auto strips = encode(model, {.base_share = 0.1}, {}, &reports);
  ASSERT_TRUE(strips);
  ASSERT_EQ(reports.size(), 2u);
  EXPECT_EQ(reports[0].triangles, 800u);
  for (std::size_t m = 0; m < 2; ++m) {
    EXPECT_EQ(reports[m].base_triangles, strips->bases[m].triangles);
    EXPECT_EQ(reports[m].stop, SimplifyStop::target);
  }
  EXPECT_EQ(reports[0].forced, ConstraintCounts{});
  EXPECT_GT(reports[1].refused.border + reports[1].refused.link, 0u);
}

TEST(Encode, AttributesCountAsMuchAsTheyWeigh) {
  // A plane with a spot of another colour.
  constexpr Index kSide = 33;
  Mesh mesh = test::grid(kSide);
  Attribute colour{"COLOR_0", ComponentType::u8, 1, true, Bytes(kSide * kSide)};
  for (Index v = 0; v < kSide * kSide; ++v) {
    set_component(mesh.position, v, 2, 0);
    const bool spot = v % kSide / 8 == 1 && v / kSide / 8 == 2;
    colour.data[v] = std::byte{spot ? std::uint8_t{255} : std::uint8_t{0}};
  }
  mesh.wedge_attributes.push_back(colour);
  const Model model = model_of({mesh});
  const auto spot_vertices = [&](std::vector<AttributeWeight> weights) {
    EncodeOptions options;
    options.attribute_weights = std::move(weights);
    options.base_triangles = 16;
    const ProgressiveStrips strips = encoded(model, options);
    const Mesh base = decode(strips, 0)->meshes[0];
    return std::ranges::count(base.wedge_attributes[0].data, std::byte{255});
  };
  const auto as_usual = spot_vertices({}), unseen = spot_vertices({{"COLOR_0", 0}});
  EXPECT_GT(as_usual, unseen);
  EXPECT_GT(spot_vertices({{"COLOR", 1}}), unseen);
  EXPECT_EQ(spot_vertices({{"COLOR", 1}, {"COLOR_0", 0}}), unseen) << "the exact name wins";
}

TEST(Encode, EveryStripifierGivesTheMeshBack) {
  for (const NamedStripifier& stripifier : stripifiers())
    for (const Mesh& mesh : {test::grid(20), test::torus(12, 9), test::cube(true)}) {
      SCOPED_TRACE(stripifier.name);
      EncodeOptions options;
      options.stripifier = stripifier.name;
      options.keep_order = true;
      EXPECT_EQ(decode(encoded(model_of({mesh}), options))->meshes[0], mesh);
    }
}

TEST(Encode, TheSameModelGivesTheSameStrips) {
  const Model model = model_of({test::torus(30, 20), test::cube(true)});
  EXPECT_EQ(encoded(model, {}), encoded(model, {}));
}

TEST(Encode, EmptyModelsAreFine) {
  EXPECT_TRUE(decode(encoded({}, {}))->meshes.empty());
  const Model no_faces = model_of({test::triangle_mesh({0, 0, 0, 1, 1, 1}, {})});
  EXPECT_EQ(decode(encoded(no_faces, {.keep_order = true}))->meshes, no_faces.meshes);
  const Model nothing = model_of({test::triangle_mesh({}, {})});
  EXPECT_EQ(decode(encoded(nothing, {.keep_order = true}))->meshes, nothing.meshes);
}

TEST(Encode, TheBaseIsAsSmallAsAsked) {
  const Model model = model_of({test::torus(40, 40)});
  EncodeOptions options;
  options.base_share = 0.1;
  EXPECT_LE(encoded(model, options).bases[0].triangles, 320u);
  options.base_triangles = 50;
  EXPECT_LE(encoded(model, options).bases[0].triangles, 50u);
  options.base_triangles.reset();
  options.base_error = 0.05;
  const ProgressiveStrips by_error = encoded(model, options);
  EXPECT_LE(by_error.bases[0].error, 0.05f);
  EXPECT_LT(by_error.bases[0].triangles, 3200u);
}

TEST(Encode, LevelsSayWhatTheyShow) {
  const ProgressiveStrips strips = encoded(model_of({test::grid(30)}), {.packet_min = 20});
  ASSERT_GT(strips.packets.size(), 5u);
  for (std::size_t k = 0; k <= strips.packets.size(); ++k) {
    const Mesh mesh = decode(strips, k)->meshes[0];
    const Packet& said = k == 0 ? strips.bases[0] : strips.packets[k - 1];
    EXPECT_EQ(mesh.vertex_count(), said.vertices);
    EXPECT_EQ(mesh.face_count(), said.triangles);
    EXPECT_EQ(find_inconsistency(mesh), "");
  }
  EXPECT_EQ(strips.packets.back().error, 0);
}

TEST(Encode, PacketsOfSeveralMeshesAreInterleavedByError) {
  const ProgressiveStrips strips =
      encoded(model_of({test::grid(25), test::torus(25, 20)}), {.packet_min = 30});
  std::vector<float> error{strips.bases[0].error, strips.bases[1].error};
  bool switched = false;
  for (std::size_t k = 0; k < strips.packets.size(); ++k) {
    const Packet& p = strips.packets[k];
    if (k > 0) switched |= p.mesh != strips.packets[k - 1].mesh;
    const Index other = 1 - p.mesh;
    const bool other_is_done = error[other] == 0;
    if (!other_is_done) {
      EXPECT_GE(error[p.mesh], error[other]);
    }
    error[p.mesh] = p.error;
  }
  EXPECT_TRUE(switched);
}

TEST(PacketsFor, FindsTheLevelAsked) {
  const ProgressiveStrips strips = encoded(model_of({test::torus(40, 30)}), {.packet_min = 40});
  const std::size_t all = strips.packets.size();
  EXPECT_EQ(packets_for(strips, {}), all);
  EXPECT_EQ(packets_for(strips, {.packets = 3}), 3u);
  EXPECT_EQ(packets_for(strips, {.packets = 1'000'000}), all);
  EXPECT_EQ(packets_for(strips, {.triangles = 0}), 0u);
  EXPECT_EQ(packets_for(strips, {.triangles = strips.packets[4].triangles}), 5u);
  EXPECT_EQ(packets_for(strips, {.error = 0}), all);
  std::size_t k = 2;  // whose error is less than that of the packet before
  while (k + 1 < all && strips.packets[k].error == strips.packets[k - 1].error) ++k;
  EXPECT_EQ(packets_for(strips, {.error = strips.packets[k].error}), k + 1);
}

TEST(Cut, MakesAShorterFileOfTheSameLevels) {
  const ProgressiveStrips whole =
      encoded(model_of({test::grid(20), test::cube(true)}), {.keep_order = true, .packet_min = 10});
  for (std::size_t k = 0; k < whole.packets.size(); ++k) {
    const ProgressiveStrips shorter = cut(whole, k);
    ASSERT_TRUE(check(shorter)) << k;
    for (std::size_t level = 0; level <= k; ++level)
      ASSERT_EQ(decode(shorter, level)->meshes, decode(whole, level)->meshes) << k << ' ' << level;
  }
  EXPECT_EQ(cut(whole, whole.packets.size()), whole);
}

TEST(Digest, IsThatOfTheDecodedMesh) {
  const ProgressiveStrips strips = encoded(model_of({test::cube(true)}), {});
  const auto sum = digest(decode(strips)->meshes[0]);
  EXPECT_TRUE(std::ranges::equal(sum, strips.meshes[0].digest));
}

TEST(Encode, StopsWhenToldTo) {
  const auto strips =
      encode(model_of({test::grid(10)}), {}, [](std::string_view, double) { return false; });
  ASSERT_FALSE(strips);
  EXPECT_EQ(strips.error().code, ErrorCode::interrupted);
}

TEST(Encode, RefusesWhatIsNoMesh) {
  Model model = model_of({test::grid(3)});
  model.meshes[0].corners[0] = 99;
  EXPECT_EQ(encode(model, {}).error().code, ErrorCode::bad_argument);
  EncodeOptions options;
  options.stripifier = "none such";
  EXPECT_EQ(encode({}, options).error().code, ErrorCode::bad_argument);
}

TEST(KeepAttributes, JoinsWedgesThatThenAreTheSame) {
  Model model = model_of({test::cube(true)});
  keep_attributes(model, {});
  EXPECT_EQ(model.meshes[0].wedge_count(), 8u);
  EXPECT_EQ(find_inconsistency(model.meshes[0]), "");
  Model normals = model_of({test::cube(true)});
  keep_attributes(normals, {"NORMAL"});
  EXPECT_EQ(normals.meshes[0].wedge_count(), 24u);
  EXPECT_EQ(normals.meshes[0].wedge_attributes.size(), 1u);
}

}  // namespace
}  // namespace pstrips
