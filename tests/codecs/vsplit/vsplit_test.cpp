// The law of the vsplit codec: whatever is collapsed, every level shows what the collapses left,
// and the last one is the source mesh bit for bit.

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>

#include "codecs/triangulate/triangulate.h"
#include "codecs/vsplit/faces.h"
#include "codecs/vsplit/level.h"
#include "codecs/vsplit/record.h"
#include "tests/support/meshes.h"

namespace pstrips {
namespace {

using Triple = std::array<Index, 3>;

// Strips of up to four triangles that happen to follow each other: enough to have shared entries.
StripMap simple_strips(const Mesh& mesh, const Triangulation& triangles) {
  StripMap out;
  out.group_entries.assign(mesh.groups.size(), 0);
  for (Index g = 0; g < mesh.groups.size(); ++g) {
    const std::size_t before = out.entries.size();
    std::size_t strip = before;
    const auto close = [&] {
      if (out.entries.size() > strip) out.entries.push_back(kRestart);
      strip = out.entries.size();
    };
    for (std::size_t t = 0; t < triangles.face.size(); ++t) {
      if (mesh.group_of(triangles.face[t]) != g) continue;
      Triple c{triangles.corners[3 * t], triangles.corners[3 * t + 1],
               triangles.corners[3 * t + 2]};
      bool joined = false;
      const std::size_t length = out.entries.size() - strip;
      if (length >= 3 && length < 7) {
        // The next entry continues over the last two, or, after a swap, over the last and third
        // last.
        for (const bool swap : {false, true}) {
          const Index a = out.entries[out.entries.size() - (swap ? 3 : 2)], b = out.entries.back();
          const bool odd =
              (length + (swap ? 1 : 0)) % 2 == 1;  // the window that the next entry makes
          for (int turn = 0; turn < 3 && !joined; ++turn) {
            std::ranges::rotate(c, c.begin() + 1);
            if (odd ? c[0] != b || c[1] != a : c[0] != a || c[1] != b) continue;
            if (swap) out.entries.insert(out.entries.end() - 1, a);
            out.entries.push_back(c[2]);
            joined = true;
          }
        }
      }
      if (joined) continue;
      close();
      out.entries.insert(out.entries.end(), c.begin(), c.end());
    }
    close();
    out.group_entries[g] = static_cast<Index>(out.entries.size() - before);
  }
  return out;
}

// Collapses on a plain list of triangles, straight from the definition.
struct Model {
  std::vector<Triple> triangles;
  std::vector<Index> wedge_vertex;

  bool degenerate(const Triple& t) const {
    const Index a = wedge_vertex[t[0]], b = wedge_vertex[t[1]], c = wedge_vertex[t[2]];
    return a == b || b == c || a == c;
  }
  std::vector<WedgeMove> collapse(Index removed, Index kept) {
    std::vector<WedgeMove> moves;
    for (Index w = 0; w < wedge_vertex.size(); ++w)
      if (wedge_vertex[w] == removed) moves.push_back({w, kNone});
    for (const Triple& t : triangles)
      for (const Index from : t)
        for (const Index to : t)
          if (wedge_vertex[from] == removed && wedge_vertex[to] == kept) {
            auto& move = *std::ranges::find(moves, from, &WedgeMove::from);
            if (move.to == kNone) move.to = to;
          }
    for (const WedgeMove& move : moves) {
      wedge_vertex[move.from] = move.to == kNone ? kept : kNone;
      for (Triple& t : triangles)
        for (Index& w : t)
          if (w == move.from && move.to != kNone) w = move.to;
    }
    std::erase_if(triangles, [&](const Triple& t) { return degenerate(t); });
    return moves;
  }
  std::multiset<Triple> canonical() const {
    std::multiset<Triple> out;
    for (Triple t : triangles) {
      std::ranges::rotate(t, std::ranges::min_element(t));
      out.insert(t);
    }
    return out;
  }
};

struct Scenario {
  Mesh mesh;
  Triangulation triangles;
  StripMap strips;
  CollapseSequence sequence;
  std::vector<std::multiset<Triple>> levels;  // coarse to fine, in source wedges
};

Scenario random_scenario(Mesh mesh, std::uint32_t seed) {
  Scenario s;
  s.mesh = std::move(mesh);
  s.triangles = triangulate(s.mesh);
  s.strips = simple_strips(s.mesh, s.triangles);
  Model model;
  for (std::size_t t = 0; t < s.triangles.face.size(); ++t)
    model.triangles.push_back({s.triangles.corners[3 * t], s.triangles.corners[3 * t + 1],
                               s.triangles.corners[3 * t + 2]});
  for (Index w = 0; w < s.mesh.wedge_count(); ++w)
    model.wedge_vertex.push_back(s.mesh.vertex_of(w));
  std::mt19937 random(seed);
  s.levels.push_back(model.canonical());
  for (std::size_t n = random() % 40; n > 0 && !model.triangles.empty(); --n) {
    const Triple t = model.triangles[random() % model.triangles.size()];
    const std::size_t k = random() % 3;
    const Index removed = model.wedge_vertex[t[k]], kept = model.wedge_vertex[t[(k + 1) % 3]];
    const auto moves = model.collapse(removed, kept);
    s.sequence.collapses.push_back(
        {removed, kept, static_cast<float>(s.levels.size()), static_cast<Index>(moves.size())});
    s.sequence.moves.insert(s.sequence.moves.end(), moves.begin(), moves.end());
    s.levels.push_back(model.canonical());
  }
  std::ranges::reverse(s.levels);
  return s;
}

std::multiset<Triple> shown_by(const Level& level, const Recording& recording) {
  Model shown;
  for_each_triangle(
      level.resolved(), [&](Index w) { return level.vertex_of(w); },
      [&](Index a, Index b, Index c) {
        shown.triangles.push_back(
            {recording.wedge_from[a], recording.wedge_from[b], recording.wedge_from[c]});
      });
  return shown.canonical();
}

void expect_exact(const Scenario& s, MapEncoding encoding) {
  const Recording recording = record(s.mesh, s.strips, s.sequence, encoding);
  Level level(recording.mesh);
  ASSERT_EQ(recording.levels.size(), recording.mesh.vsplits.size() + 1);
  for (std::size_t k = 0; k < recording.levels.size(); ++k) {
    const auto shown = shown_by(level, recording);
    const std::size_t expected = std::min(k, s.levels.size() - 1);  // isolated vertices come last
    ASSERT_EQ(shown, s.levels[expected]) << "after " << k << " vsplits";
    ASSERT_EQ(recording.levels[k].triangles, shown.size());
    level.refine(1);
  }
  ASSERT_EQ(level.vertex_count(), s.mesh.vertex_count());
  ASSERT_EQ(level.wedge_count(), s.mesh.wedge_count());

  FaceRecord faces = record_faces(s.mesh, s.triangles, s.strips, recording);
  Recording whole = recording;
  whole.mesh.faces = faces.faces;
  Level full(whole.mesh);
  full.refine_fully();
  const Mesh decoded = mesh_of(full).value();
  ASSERT_EQ(decoded, mesh_to_decode(s.mesh, s.strips, whole));
  ASSERT_EQ(restore_order(decoded, faces.order), s.mesh);

  const FaceRecord unordered = record_faces(s.mesh, s.triangles, s.strips, recording, false);
  ASSERT_EQ(unordered.faces, faces.faces);
  ASSERT_EQ(unordered.order, OriginalOrder{});
}

RC_GTEST_PROP(Vsplit, RandomCollapsesOfRandomSoupAreUndoneExactly, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const auto vertices = *rc::gen::inRange<Index>(0, 30);
  const auto faces = *rc::gen::inRange<Index>(0, 60);
  const Scenario s = random_scenario(test::random_soup(seed, vertices, faces), seed);
  expect_exact(s, MapEncoding::naive);
  expect_exact(s, MapEncoding::offset);
  RC_ASSERT(!::testing::Test::HasFatalFailure());
}

TEST(Vsplit, OrderlyMeshesAreUndoneExactly) {
  for (const std::uint32_t seed : {1u, 2u, 3u})
    for (const Mesh& mesh :
         {test::grid(6), test::torus(6, 5), test::cube(true), test::cube(false)}) {
      const Scenario s = random_scenario(mesh, seed);
      expect_exact(s, MapEncoding::naive);
      expect_exact(s, MapEncoding::offset);
    }
}

TEST(Vsplit, PolygonsLinesAndFaceAttributesComeBack) {
  Mesh mesh = test::grid(3);
  mesh.groups = {{"surface"}, {"edges", kNone, FaceKind::lines}};
  // A quad, a triangle, a degenerate triangle, a line, an empty face, a pentagon.
  mesh.corners = {0, 1, 4, 3, 1, 2, 5, 3, 3, 4, 0, 4, 8, 4, 5, 8, 7, 3};
  mesh.face_first = {0, 4, 7, 10, 13, 13, 18};
  mesh.face_group = {0, 0, 0, 1, 0, 0};
  Attribute label{"label", ComponentType::u8, 1, false, {}};
  for (int f = 0; f < 6; ++f) label.data.push_back(std::byte(f));
  mesh.face_attributes = {label};
  ASSERT_EQ(find_inconsistency(mesh), "");
  for (const std::uint32_t seed : {1u, 2u, 3u, 4u}) {
    const Scenario s = random_scenario(mesh, seed);
    expect_exact(s, MapEncoding::offset);
  }
}

// One entry at the head of a long chain, rewritten by every record: following the chain each time
// would take 10^10 steps.
TEST(Level, LongChainsRewrittenOftenStayCheap) {
  constexpr Index kMany = 100'000;
  ProgressiveMesh mesh;
  mesh.encoding = MapEncoding::offset;
  mesh.groups.resize(1);
  mesh.base_vertices = mesh.base_wedges = 1;
  mesh.base_map.assign(kMany, kSameAsMinus1);
  mesh.base_map[0] = 0;
  mesh.group_entries = {kMany};
  for (Index v = 1; v <= kMany; ++v) {
    mesh.vsplits.push_back({v - 1, 1, 0, 1});
    mesh.wedge_offset_counts.push_back(1);
    mesh.map_offsets.push_back(0);
  }
  mesh.position.data.resize(12 * (std::size_t{kMany} + 1));
  Level level(mesh);
  level.refine_fully();
  EXPECT_EQ(level.resolved().back(), kMany);
  EXPECT_EQ(level.resolved().front(), kMany);
}

// A long chain is rewritten until the work granted for it is spent, then a short one once: both
// have to be up to date, whenever that happens.
TEST(Level, EveryChainIsUpToDateAfterOneWasRewrittenTooOften) {
  constexpr Index kLength = 1000;
  for (Index writes = 120; writes < 180; ++writes) {
    ProgressiveMesh mesh;
    mesh.encoding = MapEncoding::offset;
    mesh.groups.resize(1);
    mesh.base_vertices = mesh.base_wedges = 1;
    mesh.base_map.assign(kLength + 2, kSameAsMinus1);
    mesh.base_map[0] = mesh.base_map[kLength] = 0;
    mesh.base_map[kLength - 1] = kRestart;
    mesh.group_entries = {kLength + 2};
    mesh.position.data.resize(12 * (std::size_t{writes} + 1));
    mesh.vsplits.assign(writes, {0, 1, 0, 1});
    mesh.wedge_offset_counts.assign(writes, 1);
    mesh.map_offsets.assign(writes, 0);
    mesh.map_offsets.back() = kLength;
    Level level(mesh);
    level.refine_fully();
    EXPECT_EQ(level.resolved()[kLength - 2], writes - 1) << writes;
    EXPECT_EQ(level.resolved().back(), writes) << writes;
  }
}

// [Kim04 Fig. 5]: with symbols fewer entries are rewritten.
TEST(Vsplit, SymbolsKeepEntriesOutOfTheRecords) {
  const Scenario s = random_scenario(test::grid(8), 5);
  const auto naive =
      record(s.mesh, s.strips, s.sequence, MapEncoding::naive).mesh.map_offsets.size();
  const auto offset =
      record(s.mesh, s.strips, s.sequence, MapEncoding::offset).mesh.map_offsets.size();
  EXPECT_LT(offset, naive);
}

}  // namespace
}  // namespace pstrips
