// The state machine against the plain definition: after every step the map as stored, resolved as a
// whole, shows what the machine shows.

#include "core/strip_state.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "tests/support/progressive.h"

namespace pstrips {
namespace {

/// All that can be seen of a state.
struct Snapshot {
  std::vector<Index> stored, resolved, vertex_of;
  std::vector<std::set<Index>> uses;
  friend bool operator==(const Snapshot&, const Snapshot&) = default;
};

Snapshot snapshot_of(const StripState& state) {
  Snapshot out;
  out.resolved.assign(state.resolved().begin(), state.resolved().end());
  for (Index i = 0; i < out.resolved.size(); ++i) out.stored.push_back(state.stored(i));
  for (Index w = 0; w < state.wedge_count(); ++w) {
    out.vertex_of.push_back(state.vertex_of(w));
    state.for_each_use(w, [&, uses = &out.uses.emplace_back()](Index at) { uses->insert(at); });
  }
  return out;
}

/// The same from the steps' definition.
struct Definition {
  std::vector<Index> map, vertex_of;

  explicit Definition(const ProgressiveMesh& mesh)
      : map(mesh.base_map), vertex_of(mesh.base_wedge_vertex) {
    for (Index w = 0; mesh.single_wedges && w < mesh.base_wedges; ++w) vertex_of.push_back(w);
  }
  void apply(const VsplitRecord& record) {
    for (const Index w : record.reassigned) vertex_of[w] = record.vertex;
    std::size_t k = 0;
    for (const Index count : record.offset_counts) {
      for (Index i = 0; i < count; ++i)
        map[record.map_offsets[k++]] = static_cast<Index>(vertex_of.size());
      vertex_of.push_back(record.vertex);
    }
    map.insert(map.end(), record.new_corners.begin(), record.new_corners.end());
  }
  Snapshot snapshot() const {
    Snapshot out{map, resolve(map).value(), vertex_of, {}};
    out.uses.resize(vertex_of.size());
    for (Index i = 0; i < map.size(); ++i)
      if (out.resolved[i] != kRestart) out.uses[out.resolved[i]].insert(i);
    return out;
  }
};

/// Entries that show another wedge or another vertex, and those that only one has.
std::set<Index> difference(const Snapshot& a, const Snapshot& b) {
  std::set<Index> out;
  const auto vertex = [](const Snapshot& s, Index i) {
    return s.resolved[i] == kRestart ? kRestart : s.vertex_of[s.resolved[i]];
  };
  const auto both = static_cast<Index>(std::min(a.resolved.size(), b.resolved.size()));
  for (Index i = 0; i < both; ++i)
    if (a.resolved[i] != b.resolved[i] || vertex(a, i) != vertex(b, i)) out.insert(i);
  for (Index i = both; i < std::max(a.resolved.size(), b.resolved.size()); ++i) out.insert(i);
  return out;
}

ProgressiveMesh random_mesh(std::uint32_t seed) {
  test::ProgressiveOptions options;
  const MapEncoding encodings[] = {MapEncoding::naive, MapEncoding::triangles, MapEncoding::offset};
  options.encoding = encodings[std::min(seed % 4, 2u)];
  options.single_wedges = seed % 3 == 0;
  options.vsplits = seed % 40;
  return test::random_progressive(seed, options).meshes[0];
}

RC_GTEST_PROP(StripState, ShowsWhatTheDefinitionShowsAfterEveryRecord, ()) {
  const ProgressiveMesh mesh = random_mesh(*rc::gen::arbitrary<std::uint32_t>());
  StripState state(mesh);
  state.list_uses();
  Definition definition(mesh);
  Snapshot before = snapshot_of(state);
  RC_ASSERT(before == definition.snapshot());
  for (RecordStart at; at.vsplit < mesh.vsplits.size(); at.skip(mesh.vsplits[at.vsplit])) {
    std::set<Index> changed;
    state.apply(
        record_at(mesh, at), [&](Index entry) { changed.insert(entry); }, kUnobserved);
    definition.apply(record_at(mesh, at));
    const Snapshot after = snapshot_of(state);
    RC_ASSERT(after == definition.snapshot());
    RC_ASSERT(changed == difference(before, after));
    before = after;
  }
}

RC_GTEST_PROP(StripState, ComesBackStepByStep, ()) {
  const ProgressiveMesh mesh = random_mesh(*rc::gen::arbitrary<std::uint32_t>());
  StripState state(mesh);
  state.list_uses();
  std::vector<Snapshot> snapshots;
  std::vector<std::vector<StripChange>> changes;
  for (RecordStart at; at.vsplit < mesh.vsplits.size(); at.skip(mesh.vsplits[at.vsplit])) {
    snapshots.push_back(snapshot_of(state));
    changes.emplace_back();
    state.apply(record_at(mesh, at), kUnobserved,
                [&](const StripChange& change) { changes.back().push_back(change); });
  }
  Snapshot before = snapshot_of(state);
  for (; !changes.empty(); changes.pop_back(), snapshots.pop_back()) {
    std::set<Index> changed;
    for (; !changes.back().empty(); changes.back().pop_back())
      state.undo(changes.back().back(), [&](Index entry) { changed.insert(entry); });
    const Snapshot after = snapshot_of(state);
    RC_ASSERT(after == snapshots.back());
    std::set<Index> differing = difference(before, after);
    // Entries that are taken away are nobody's to look at again.
    differing.erase(differing.lower_bound(static_cast<Index>(after.resolved.size())),
                    differing.end());
    RC_ASSERT(std::ranges::includes(changed, differing));
    before = after;
  }
}

ProgressiveMesh mesh_of_map(std::vector<Index> map, Index wedges) {
  ProgressiveMesh mesh;
  mesh.encoding = MapEncoding::offset;
  mesh.base_vertices = mesh.base_wedges = wedges;
  mesh.base_map = std::move(map);
  return mesh;
}

TEST(StripState, ACollapseWritesSymbolsAndIsUndone) {
  // Entry 3 follows entry 1; the collapse of wedge 1 into 0 lets entry 1 follow entry 0.
  const ProgressiveMesh mesh = mesh_of_map({0, 1, 2, kSameAsMinus2, kRestart, 1}, 3);
  StripState state(mesh);
  state.list_uses();
  const Snapshot before = snapshot_of(state);
  std::vector<Index> changed;
  const auto observe = [&](Index entry) { changed.push_back(entry); };
  const StripChange first = state.write(1, kSameAsMinus1, 0, observe);
  const StripChange second = state.write(5, 0, 0, observe);
  EXPECT_EQ(changed, (std::vector<Index>{1, 3, 5}));
  EXPECT_EQ(snapshot_of(state).resolved, (std::vector<Index>{0, 0, 2, 0, kRestart, 0}));
  EXPECT_EQ(state.stored(1), kSameAsMinus1);
  state.undo(second, kUnobserved);
  state.undo(first, kUnobserved);
  EXPECT_EQ(snapshot_of(state), before);
}

TEST(StripState, ARecordIsFoundByTheRecordsBefore) {
  const ProgressiveMesh mesh = random_mesh(21);
  RecordStart at;
  for (const Vsplit& split : mesh.vsplits) {
    const VsplitRecord record = record_at(mesh, at);
    EXPECT_EQ(record.vertex, mesh.base_vertices + at.vsplit);
    EXPECT_EQ(record.parent, split.parent);
    EXPECT_EQ(record.offset_counts.size(), split.wedges);
    EXPECT_EQ(record.reassigned.size(), split.reassigned);
    EXPECT_EQ(record.map_offsets.size(), split.map_offsets);
    EXPECT_EQ(record.new_corners.size(), 3 * split.triangles);
    at.skip(split);
  }
  EXPECT_EQ(
      at, (RecordStart{mesh.vsplits.size(), mesh.wedge_offset_counts.size(), mesh.reassigned.size(),
                       mesh.map_offsets.size(), mesh.new_corners.size()}));
}

// A long chain behind one entry that is written again and again.
TEST(StripState, WorkIsBoundedByWhatWasGranted) {
  constexpr Index kEntries = 10'000, kWrites = 10'000;
  std::vector<Index> map(kEntries, kSameAsMinus1);
  map[0] = 0;
  StripState state(mesh_of_map(std::move(map), 1));
  std::uint64_t changed = 0;
  const auto count = [&](Index) { ++changed; };
  for (Index i = 1; i <= kWrites; ++i) {
    state.grant_work(1);
    state.add_wedge(i);
    state.write(0, i, i, count);
  }
  EXPECT_TRUE(state.is_exhausted());
  EXPECT_GT(changed, StripState::kMaxWorkPerItem * kEntries);
  EXPECT_LT(changed, StripState::kMaxWorkPerItem * (kEntries + kWrites) + kWrites + 2000);
  EXPECT_EQ(state.resolved().front(), kWrites);
  EXPECT_LT(state.resolved().back(), kWrites);
  state.resolve_again();
  EXPECT_FALSE(state.is_exhausted());
  EXPECT_EQ(state.resolved().back(), kWrites);
}

TEST(StripState, UsesAreRightAgainWhenTheMapIs) {
  std::vector<Index> map(100, kSameAsMinus1);
  map[0] = 0;
  StripState state(mesh_of_map(std::move(map), 1));
  state.list_uses();
  state.limit_work(10);
  state.add_wedge(1);
  state.write(0, 1, 1, kUnobserved);
  ASSERT_TRUE(state.is_exhausted());
  state.resolve_again();
  std::size_t uses = 0;
  state.for_each_use(1, [&](Index) { ++uses; });
  EXPECT_EQ(uses, 100u);
  state.for_each_use(0, [&](Index at) { ADD_FAILURE() << at; });
}

}  // namespace
}  // namespace pstrips
