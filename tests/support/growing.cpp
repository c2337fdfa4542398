#include "tests/support/growing.h"

#include <algorithm>
#include <array>

#include "core/strip_state.h"

namespace pstrips::test {
namespace {

class Growth {
 public:
  explicit Growth(const ProgressiveMesh& mesh)
      : mesh_(mesh), out_(mesh), state_(mesh), place_(state_.resolved().size(), kNone) {
    out_.encoding = MapEncoding::triangles;
    out_.base_map.clear();
    out_.map_offsets.clear();
    std::ranges::fill(out_.wedge_offset_counts, 0);
    out_.group_entries.assign(mesh.groups.size(), 0);
    std::size_t entry = 0;
    for (Index group = 0; group < mesh.group_entries.size(); ++group)
      for (Index i = 0; i < mesh.group_entries[group]; ++i, ++entry) {
        group_.push_back(group);
        const bool starts = entry == 0 || state_.resolved()[entry - 1] == kRestart;
        odd_.push_back(!starts && !odd_.back());
      }
    state_.list_uses();
  }

  ProgressiveMesh run() {
    for (Index window = 0; window < place_.size(); ++window) add_if_new(window, out_.base_map);
    for (RecordStart at; at.vsplit < mesh_.vsplits.size(); at.skip(mesh_.vsplits[at.vsplit]))
      add_record(at);
    out_.triangles = out_.strips = static_cast<Index>(map_.size() / 3);
    if (mesh_.groups.size() < 2) out_.triangle_group.clear();
    return std::move(out_);
  }

 private:
  std::array<Index, 3> entries_of(Index window) const {
    if (odd_[window]) return {window + 1, window, window + 2};
    return {window, window + 1, window + 2};
  }

  // The triangle that a window shows for the first time goes to the end of the map.
  void add_if_new(Index window, std::vector<Index>& corners) {
    const std::span<const Index> shown = state_.resolved();
    if (place_[window] != kNone || window + 2 >= shown.size()) return;
    const auto entries = entries_of(window);
    for (const Index e : entries)
      if (shown[e] == kRestart) return;
    const Index a = state_.vertex_at(window), b = state_.vertex_at(window + 1),
                c = state_.vertex_at(window + 2);
    if (a == b || b == c || a == c) return;
    place_[window] = static_cast<Index>(map_.size());
    for (const Index e : entries) {
      corners.push_back(shown[e]);
      map_.push_back(shown[e]);
    }
    out_.triangle_group.push_back(group_[window]);
    out_.group_entries[group_[window]] += 3;
  }

  void add_record(const RecordStart& at) {
    const Index first_wedge = state_.wedge_count();
    std::vector<Index> windows;
    state_.apply(
        record_at(mesh_, at),
        [&](Index entry) {
          for (Index back = 0; back < 3 && back <= entry; ++back) windows.push_back(entry - back);
        },
        kUnobserved);
    std::ranges::sort(windows);
    windows.erase(std::unique(windows.begin(), windows.end()), windows.end());
    std::vector<std::pair<Index, Index>> rewritten;  // wedge, entry of the new map
    for (const Index window : windows) {
      if (place_[window] == kNone) continue;
      const auto entries = entries_of(window);
      for (Index k = 0; k < 3; ++k) {
        const Index wedge = state_.resolved()[entries[k]];
        Index& known = map_[place_[window] + k];
        if (known != wedge) rewritten.emplace_back(wedge, place_[window] + k);
        known = wedge;
      }
    }
    std::ranges::sort(rewritten);
    Vsplit& split = out_.vsplits[at.vsplit];
    split.map_offsets = static_cast<Index>(rewritten.size());
    for (const auto& [wedge, entry] : rewritten) {
      ++out_.wedge_offset_counts[at.offset_count + (wedge - first_wedge)];
      out_.map_offsets.push_back(entry);
    }
    const std::size_t before = out_.new_corners.size();
    for (const Index window : windows) add_if_new(window, out_.new_corners);
    split.triangles = static_cast<Index>((out_.new_corners.size() - before) / 3);
  }

  const ProgressiveMesh& mesh_;
  ProgressiveMesh out_;
  StripState state_;
  std::vector<Index> place_;  // of the triangle of each window in the new map, or kNone
  std::vector<Index> map_;    // the new one
  std::vector<Index> group_;  // of each window
  std::vector<bool> odd_;     // windows that are wound the other way
};

}  // namespace

ProgressiveMesh growing(const ProgressiveMesh& mesh) { return Growth(mesh).run(); }

}  // namespace pstrips::test
