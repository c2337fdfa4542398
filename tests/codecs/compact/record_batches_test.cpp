// The law of the recorder of batches: whatever is collapsed, each batch ends with a level that
// shows what the collapses left, and the last one is the source mesh bit for bit.

#include "codecs/compact/record_batches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <set>

#include "codecs/compact/base_order.h"
#include "codecs/simplify/simplify.h"
#include "codecs/vsplit/faces.h"
#include "codecs/vsplit/level.h"
#include "tests/support/meshes.h"

namespace pstrips {
namespace {

using Triple = std::array<Index, 3>;

Triple turned(Triple t) {
  std::ranges::rotate(t, std::ranges::min_element(t));
  return t;
}

/// Which vertex each became after the first `count` collapses.
class Merged {
 public:
  Merged(Index vertices, std::span<const Collapse> collapses) : now_(vertices) {
    std::iota(now_.begin(), now_.end(), Index{0});
    for (const Collapse& c : collapses) now_[c.removed] = c.kept;
  }
  Index operator()(Index v) const {
    while (now_[v] != v) v = now_[v];
    return v;
  }

 private:
  std::vector<Index> now_;
};

/// Collapses along edges at random, one in twenty between any two vertices; some vertices are left.
CollapseSequence random_collapses(const Mesh& mesh, const Triangulation& triangles,
                                  std::uint32_t seed, Placement placement) {
  std::mt19937 random(seed);
  CollapseSequence out;
  std::vector<Index> alive(mesh.vertex_count());
  std::iota(alive.begin(), alive.end(), Index{0});
  for (std::size_t tries = 8 * alive.size(); tries > 0 && alive.size() > 4; --tries) {
    const Merged now(mesh.vertex_count(), out.collapses);
    Index kept = alive[random() % alive.size()], removed = alive[random() % alive.size()];
    if (random() % 20 != 0 && !triangles.corners.empty()) {
      const std::size_t corner = random() % triangles.corners.size();
      kept = now(mesh.vertex_of(triangles.corners[corner]));
      removed = now(mesh.vertex_of(triangles.corners[corner / 3 * 3 + (corner + 1) % 3]));
    }
    if (kept == removed) continue;
    out.collapses.push_back({.removed = removed, .kept = kept, .error = 0, .moves = 0});
    std::erase(alive, removed);
    if (placement == Placement::optimal)
      for (int k = 0; k < 3; ++k) out.placements.push_back(static_cast<double>(random() % 1000));
  }
  return out;
}

CollapseSequence chosen_collapses(const Mesh& mesh, const Triangulation& triangles,
                                  std::uint64_t target, Placement placement) {
  const std::vector<double> positions = positions_as_double(mesh);
  return simplify({.positions = positions,
                   .wedge_vertex = mesh.wedge_vertex,
                   .triangles = triangles.corners,
                   .group = {},
                   .attributes = {}},
                  {.target_triangles = target, .placement = placement});
}

std::multiset<Triple> merged_triangles(const Mesh& mesh, const Triangulation& triangles,
                                       const Merged& now) {
  std::multiset<Triple> out;
  for (std::size_t c = 0; c < triangles.corners.size(); c += 3) {
    Triple t;
    for (std::size_t k = 0; k < 3; ++k) t[k] = now(mesh.vertex_of(triangles.corners[c + k]));
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) out.insert(turned(t));
  }
  return out;
}

std::multiset<Triple> shown_by(const Level& level, const Recording& recording, const Merged& now) {
  std::multiset<Triple> out;
  for (std::size_t c = 0; c < level.resolved().size(); c += 3) {
    Triple t;
    for (std::size_t k = 0; k < 3; ++k)
      t[k] = now(recording.vertex_from[level.vertex_of(level.resolved()[c + k])]);
    out.insert(turned(t));
  }
  return out;
}

/// No vertex is split or new twice in a batch, and records stand in the order of the list.
void expect_batches(const BatchRecording& made) {
  const ProgressiveMesh& mesh = made.recording.mesh;
  std::vector<Index> order(mesh.base_vertices);
  std::iota(order.begin(), order.end(), Index{0});
  std::size_t record = 0;
  for (const Index size : made.batches) {
    ASSERT_GT(size, 0u);
    const std::size_t end = record + size;
    std::vector<Index> after;
    for (const Index v : order) {
      after.push_back(v);
      if (record < end && mesh.vsplits[record].parent == v)
        after.push_back(mesh.base_vertices + static_cast<Index>(record++));
    }
    ASSERT_EQ(record, end) << "out of order";
    order = std::move(after);
  }
  for (; record < mesh.vsplits.size(); ++record)
    ASSERT_EQ(mesh.vsplits[record].parent, mesh.base_vertices + record);
}

/// The triangles of a record start with its parent; of its first two, the one in which the new
/// vertex comes last is first.
void expect_canonical(const Level& level, const Vsplit& split) {
  const auto map = level.resolved();
  const Index added = level.vertex_count() - 1;
  bool second = false;
  for (std::size_t c = map.size() - std::size_t{3} * split.triangles; c < map.size(); c += 3) {
    ASSERT_EQ(level.vertex_of(map[c]), split.parent);
    const bool at_end = level.vertex_of(map[c + 2]) == added;
    ASSERT_TRUE(at_end || level.vertex_of(map[c + 1]) == added);
    ASSERT_FALSE(at_end && second);
    second = !at_end;
  }
}

void expect_full(const Mesh& mesh, const BatchRecording& made, const Level& level) {
  const Recording& recording = made.recording;
  ASSERT_EQ(level.vertex_count(), mesh.vertex_count());
  ASSERT_EQ(level.wedge_count(), mesh.wedge_count());
  std::vector<Index> map;
  for (const Index w : level.resolved()) map.push_back(recording.wedge_from[w]);
  ASSERT_EQ(map, made.map.entries);
  for (Index w = 0; w < mesh.wedge_count(); ++w)
    ASSERT_EQ(recording.vertex_from[level.vertex_of(w)], mesh.vertex_of(recording.wedge_from[w]));
  const ByteView positions = level.positions();
  const std::size_t bytes = mesh.position.element_bytes();
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    ASSERT_TRUE(std::ranges::equal(positions.subspan(v * bytes, bytes),
                                   mesh.position.element(recording.vertex_from[v])));
  for (std::size_t a = 0; a < mesh.wedge_attributes.size(); ++a)
    for (Index w = 0; w < mesh.wedge_count(); ++w)
      ASSERT_TRUE(std::ranges::equal(recording.mesh.wedge_attributes[a].element(w),
                                     mesh.wedge_attributes[a].element(recording.wedge_from[w])));
}

/// Faces and order, too.
void expect_faces(const Mesh& mesh, const Triangulation& triangles, const BatchRecording& made) {
  Recording whole = made.recording;
  FaceRecord faces = record_faces(mesh, triangles, made.map, whole);
  whole.mesh.faces = std::move(faces.faces);
  Level level(whole.mesh);
  level.refine_fully();
  const Mesh decoded = mesh_of(level).value();
  ASSERT_EQ(decoded, mesh_to_decode(mesh, made.map, whole));
  ASSERT_EQ(restore_order(decoded, faces.order), mesh);
}

/// The source's triangles, each once and in its group.
void expect_map(const Mesh& mesh, const Triangulation& triangles, const BatchRecording& made) {
  const ProgressiveMesh& to = made.recording.mesh;
  std::multiset<std::pair<Index, Triple>> got, want;
  for (std::size_t t = 0; t < triangles.face.size(); ++t) {
    const Index* s = triangles.corners.data() + 3 * t;
    const Index* d = made.map.entries.data() + 3 * t;
    want.insert({mesh.group_of(triangles.face[t]), turned({s[0], s[1], s[2]})});
    got.insert({to.triangle_group.empty() ? 0 : to.triangle_group[t], turned({d[0], d[1], d[2]})});
  }
  ASSERT_EQ(got, want);
  ASSERT_EQ(made.map.entries.size(), triangles.corners.size());
  for (Index g = 0; g < mesh.groups.size(); ++g)
    ASSERT_EQ(to.group_entries[g],
              3 * std::ranges::count(got, g, [](const auto& t) { return t.first; }));
}

void expect_exact(const Mesh& mesh, const CollapseSequence& sequence,
                  const BatchOptions& options = {}) {
  const Triangulation triangles = triangulate(mesh);
  const BatchRecording made = record_batches(mesh, triangles, sequence, options);
  const ProgressiveMesh& to = made.recording.mesh;
  const std::vector<Collapse>& collapses = made.collapses.collapses;
  ASSERT_EQ(made.recording.levels.size(), to.vsplits.size() + 1);
  ASSERT_EQ(to.base_vertices + to.vsplits.size(), mesh.vertex_count());
  ASSERT_EQ(std::accumulate(made.batches.begin(), made.batches.end(), std::size_t{0}),
            collapses.size());
  expect_batches(made);
  expect_map(mesh, triangles, made);
  Level level(to);
  std::set<std::size_t> ends{0};
  for (const Index size : made.batches) ends.insert(*ends.rbegin() + size);
  for (std::size_t k = 0;; ++k) {
    const std::size_t left = collapses.size() - std::min(k, collapses.size());
    if (ends.contains(k)) {
      const Merged now(mesh.vertex_count(), std::span(collapses).first(left));
      ASSERT_EQ(shown_by(level, made.recording, now), merged_triangles(mesh, triangles, now))
          << "after " << k << " vsplits";
    }
    ASSERT_EQ(level.resolved().size(), 3 * made.recording.levels[k].triangles);
    if (k == to.vsplits.size()) break;
    level.refine(1);
    expect_canonical(level, to.vsplits[k]);
    ASSERT_FALSE(::testing::Test::HasFatalFailure()) << "record " << k;
  }
  expect_full(mesh, made, level);
  expect_faces(mesh, triangles, made);
}

constexpr Placement kPlacements[] = {Placement::subset, Placement::optimal};

TEST(RecordBatches, OrderlyMeshesAreUndoneExactly) {
  for (const Mesh& mesh : {test::grid(12), test::torus(16, 9), test::cube(true), test::cube(false),
                           test::triangle_mesh({}, {})})
    for (const Placement placement : kPlacements)
      for (std::uint32_t seed = 0; seed < 4; ++seed) {
        expect_exact(mesh, random_collapses(mesh, triangulate(mesh), seed, placement));
        expect_exact(mesh, chosen_collapses(mesh, triangulate(mesh), seed * 10, placement));
        ASSERT_FALSE(HasFatalFailure()) << seed;
      }
}

TEST(RecordBatches, AnyComplexIsUndoneExactly) {
  for (std::uint32_t seed = 0; seed < 200; ++seed)
    for (const Mesh& mesh : {test::random_soup(seed, 4 + seed % 40, seed),
                             test::polygon_soup(seed, 4 + seed % 30, seed / 2)})
      for (const Placement placement : kPlacements) {
        expect_exact(mesh, random_collapses(mesh, triangulate(mesh), seed, placement));
        ASSERT_FALSE(HasFatalFailure()) << seed;
      }
}

TEST(RecordBatches, BatchesOfAnyShare) {
  const Mesh mesh = test::torus(16, 9);
  const CollapseSequence sequence = random_collapses(mesh, triangulate(mesh), 1, Placement::subset);
  for (const double share : {0.001, 0.1, 0.5, 1.0})
    for (const double window : {0.1, 1.0, 2.0})
      expect_exact(mesh, sequence,
                   {.schedule = {{share, 1}, {share, 1}, {share, 1}, 0.5}, .window = window});
}

// A level shows of a seam what the collapses left of it: nothing is reassigned where edges along
// the seam collapse, and each wedge of the new vertex splits one of the parent's.
TEST(RecordBatches, WedgesOfASeamSplitInPairs) {
  Mesh mesh = test::grid(3);  // 0 1 2 / 3 4 5 / 6 7 8, a seam along 1 4 7
  const std::vector<Index> left = mesh.corners;
  for (Index v = 0; v < 9; ++v) mesh.wedge_vertex.push_back(v);
  for (const Index v : {1, 4, 7}) mesh.wedge_vertex.push_back(v);
  for (std::size_t c = 0; c < mesh.corners.size(); c += 3) {
    const auto face = std::span(mesh.corners).subspan(c, 3);
    if (std::ranges::none_of(face, [](Index v) { return v % 3 == 2; })) continue;
    for (Index& w : face)
      if (w % 3 == 1) w = 9 + w / 3;
  }
  ASSERT_EQ(find_inconsistency(mesh), "");
  CollapseSequence sequence;
  sequence.collapses = {{.removed = 4, .kept = 1, .error = 1, .moves = 0}};
  expect_exact(mesh, sequence);
  const ProgressiveMesh made = record_batches(mesh, triangulate(mesh), sequence).recording.mesh;
  ASSERT_EQ(made.vsplits.size(), 1u);
  EXPECT_EQ(made.vsplits[0].wedges, 2u);
  EXPECT_EQ(made.vsplits[0].reassigned, 0u);
  EXPECT_EQ(made.vsplits[0].triangles, 2u);
  EXPECT_EQ(made.vsplits[0].map_offsets, 4u);
}

// Thousands of vertices around one go to it one batch each: the base keeps what is left.
TEST(RecordBatches, CollapsesOntoOneVertexEnd) {
  constexpr Index kRim = 3000;
  std::vector<float> positions{0, 0, 1};
  std::vector<Index> corners;
  CollapseSequence sequence;
  for (Index v = 1; v <= kRim; ++v) {
    positions.insert(positions.end(), {static_cast<float>(v), 1, 0});
    if (v > 1) corners.insert(corners.end(), {0, v - 1, v});
    sequence.collapses.push_back({.removed = v, .kept = 0, .error = 0, .moves = 0});
  }
  const Mesh mesh = test::triangle_mesh(positions, corners);
  const BatchRecording made = record_batches(mesh, triangulate(mesh), sequence);
  EXPECT_EQ(made.batches.size(), kMostBatches);
  EXPECT_EQ(made.recording.mesh.base_vertices, 1 + kRim - kMostBatches);
  Level level(made.recording.mesh);
  level.refine_fully();
  expect_full(mesh, made, level);
}

TEST(RecordBatches, ErrorsOfTheCollapsesDoNotFall) {
  const Mesh mesh = test::torus(20, 12);
  const BatchRecording made = record_batches(
      mesh, triangulate(mesh), chosen_collapses(mesh, triangulate(mesh), 20, Placement::optimal));
  EXPECT_TRUE(std::ranges::is_sorted(made.collapses.collapses, {}, &Collapse::error));
  EXPECT_EQ(made.collapses.placements.size(), 3 * made.collapses.collapses.size());
  EXPECT_EQ(made.collapses.triangles_left, made.recording.levels[0].triangles);
}

TEST(BaseOrder, NeighboursFollowEachOther) {
  // Two triangles on one edge, one elsewhere, one more on the first edge; vertex 8 is unused.
  const std::vector<Index> triangles = {0, 1, 2, 4, 5, 6, 2, 1, 3, 1, 2, 7};
  const BaseOrder order = base_order(triangles, 9);
  EXPECT_EQ(order.triangle, (std::vector<Index>{0, 2, 3, 1}));
  EXPECT_EQ(order.turn, (std::vector<std::uint8_t>{0, 0, 0, 0}));
  EXPECT_EQ(order.vertex, (std::vector<Index>{0, 1, 2, 3, 7, 4, 5, 6, 8}));
}

TEST(BaseOrder, EveryTriangleOfOneEdgeIsReachedAtOnce) {
  constexpr Index kMany = 200'000;
  std::vector<Index> triangles;
  for (Index v = 2; v < kMany; ++v) triangles.insert(triangles.end(), {0, 1, v});
  EXPECT_EQ(base_order(triangles, kMany).triangle.size(), kMany - 2);
}

}  // namespace
}  // namespace pstrips
