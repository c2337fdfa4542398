// Vertices at one place are one for levels and strips, whatever the model's numbers say, and come
// back as they were.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "converters/decode.h"
#include "converters/encode.h"
#include "core/gather.h"
#include "core/strips.h"
#include "tests/support/meshes.h"
#include "tests/support/round_trip.h"

namespace pstrips {
namespace {

using Place = std::array<double, 3>;

// Every corner gets a vertex of its own.
Mesh unwelded(const Mesh& mesh) {
  Mesh out = mesh;
  std::vector<Index> vertices;
  for (const Index wedge : mesh.corners) vertices.push_back(mesh.vertex_of(wedge));
  out.position = gather(mesh.position, vertices);
  for (Attribute& a : out.wedge_attributes) a = gather(a, mesh.corners);
  out.wedge_vertex.clear();
  for (Index c = 0; c < out.corners.size(); ++c) out.corners[c] = c;
  return out;
}

// Every second triangle has vertices of its own, which stand at -0 where the others stand at 0.
Mesh with_negative_zeros(const Mesh& mesh) {
  Mesh out = mesh;
  Attribute negative = mesh.position;
  for (std::size_t v = 0; v < negative.elements(); ++v)
    for (std::size_t c = 0; c < 3; ++c)
      if (component(negative, v, c) == 0) set_component(negative, v, c, -0.);
  out.position.data.insert(out.position.data.end(), negative.data.begin(), negative.data.end());
  for (std::size_t c = 0; c < out.corners.size(); ++c)
    if (c / 3 % 2 == 1) out.corners[c] += mesh.vertex_count();
  return out;
}

std::array<std::uint64_t, 2> open_and_all_edges(const Mesh& mesh) {
  const auto place_of = [&](Index wedge) {
    Place out;
    for (std::size_t c = 0; c < 3; ++c)
      out[c] = component(mesh.position, mesh.vertex_of(wedge), c) + 0.;
    return out;
  };
  std::map<std::pair<Place, Place>, int> edges;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Place a = place_of(face[k]), b = place_of(face[(k + 1) % face.size()]);
      ++edges[std::minmax(a, b)];
    }
  }
  std::array<std::uint64_t, 2> out{0, edges.size()};
  for (const auto& [edge, faces] : edges) out[0] += faces != 2;
  return out;
}

std::vector<EncodeOptions> both_profiles() {
  std::vector<EncodeOptions> out(2);
  out[0].base_share = 0.25;
  out[1] = out[0];
  out[1].profile = Profile::compact;
  return out;
}

void expect_whole_levels(const Mesh& mesh, Index welded_vertices) {
  for (const EncodeOptions& options : both_profiles()) {
    const ProgressiveStrips strips = encode(test::model_of(mesh), options).value();
    EXPECT_EQ(strips.meshes[0].vertices, welded_vertices);
    for (std::size_t packets = 0; packets <= strips.packets.size(); ++packets) {
      const Mesh level = decode(strips, packets).value().meshes[0];
      const auto [open, all] = open_and_all_edges(level);
      EXPECT_EQ(open, 0u) << packets << " packets, profile " << static_cast<int>(options.profile);
      EXPECT_GT(all, 20u);
    }
  }
}

void expect_round_trip(const Mesh& mesh) {
  for (EncodeOptions options : both_profiles())
    for (const bool keep_order : {false, true})
      for (const bool xml : {false, true}) {
        options.keep_order = keep_order;
        EXPECT_EQ(test::round_trip(test::model_of(mesh), options, xml), "");
      }
}

TEST(Welding, ClosesTrianglesThatShareNoVertex) {
  const Mesh torus = test::torus(16, 12);
  expect_whole_levels(unwelded(torus), torus.vertex_count());
  expect_round_trip(unwelded(torus));
}

TEST(Welding, TakesNegativeZeroForZero) {
  const Mesh torus = test::torus(16, 12);
  expect_whole_levels(with_negative_zeros(torus), torus.vertex_count());
  expect_round_trip(with_negative_zeros(torus));
}

TEST(Welding, ClosesSeamsOfTheTexture) {
  const Mesh cube = test::cube(true);
  const ProgressiveStrips strips = encode(test::model_of(unwelded(cube)), {}).value();
  EXPECT_EQ(strips.meshes[0].vertices, cube.vertex_count());
  EXPECT_EQ(strips.meshes[0].wedges, cube.wedge_count());
  expect_round_trip(unwelded(cube));
}

TEST(Welding, LetsStripsGoOn) {
  const Mesh torus = test::torus(16, 12);
  const ProgressiveStrips whole = encode(test::model_of(torus), {}).value();
  const ProgressiveStrips parts = encode(test::model_of(unwelded(torus)), {}).value();
  EXPECT_EQ(parts.meshes[0].strips, whole.meshes[0].strips);
}

TEST(Welding, JoinsAcrossADistance) {
  Mesh apart = unwelded(test::torus(16, 12));
  for (std::size_t v = 0; v < apart.position.elements(); ++v)
    set_component(apart.position, v, 0,
                  component(apart.position, v, 0) + 1e-5 * static_cast<double>(v % 3));
  EncodeOptions options;
  const ProgressiveStrips exact = encode(test::model_of(apart), options).value();
  EXPECT_GT(exact.meshes[0].vertices, Index{16 * 12});
  options.weld = 1e-4;
  const ProgressiveStrips near = encode(test::model_of(apart), options).value();
  EXPECT_EQ(near.meshes[0].vertices, Index{16 * 12});
  EXPECT_EQ(test::round_trip(test::model_of(apart), options, false), "");
}

TEST(Welding, CanBeLeftOut) {
  const Mesh mesh = unwelded(test::torus(8, 6));
  EncodeOptions options;
  options.weld = std::nullopt;
  const ProgressiveStrips strips = encode(test::model_of(mesh), options).value();
  EXPECT_EQ(strips.meshes[0].vertices, mesh.vertex_count());
  EXPECT_TRUE(strips.meshes[0].welding.empty());
}

TEST(Welding, ComesBackFromAnySoup) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    Mesh mesh = seed % 2 == 0 ? test::random_soup(seed, 9, 14) : test::polygon_soup(seed, 9, 9);
    // Places that several have.
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      for (std::size_t c = 0; c < 3; ++c)
        set_component(mesh.position, v, c,
                      v % 4 == 0 && c == 0 ? -0. : static_cast<double>((v % 2 + c) % 2));
    for (const EncodeOptions& options : both_profiles()) {
      EncodeOptions ordered = options;
      ordered.keep_order = true;
      EXPECT_EQ(test::round_trip(test::model_of(mesh), options, false), "") << seed;
      EXPECT_EQ(test::round_trip(test::model_of(mesh), ordered, true), "") << seed;
    }
  }
}

}  // namespace
}  // namespace pstrips
