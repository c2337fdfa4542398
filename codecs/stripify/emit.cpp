#include "codecs/stripify/emit.h"

#include <algorithm>
#include <numeric>

namespace pstrips::inline codecs {
namespace {

// In a triangle entered over half-edge e, a strip leaves over the edge before e or the one after
// it. A strip that needs no repeated entry leaves its second triangle over the edge before, the
// third over the one after, and so on; each departure from that costs one entry and changes the
// parity.
class Emitter {
 public:
  Emitter(const StripInput& input, const DualGraph& graph, const Links& links)
      : input_(input), graph_(graph), links_(links), done_(graph.triangle_count()) {
    strips_.reserve(graph.triangle_count() + graph.triangle_count() / 2);
  }

  Strips run() {
    for (const Index t : triangles_by_group(input_))
      if (!done_[t] && is_end(t)) emit_strip_from(t);
    if (!strips_.empty()) strips_.pop_back();  // the last restart
    return std::move(strips_);
  }

 private:
  // The link of triangle t that is not `entry`, or kNone.
  Index exit_of(Index t, Index entry) const {
    for (Index h = 3 * t; h < 3 * t + 3; ++h)
      if (links_[h] && h != entry) return h;
    return kNone;
  }

  // Finds the half-edges over which the strip leaves each triangle from `exit` on.
  void follow(Index exit) {
    exits_.clear();
    while (exit != kNone) {
      exits_.push_back(exit);
      const Index entry = graph_.opposite[exit];
      exit = exit_of(triangle_of(entry), entry);
    }
  }

  bool is_end(Index t) const { return links_[3 * t] + links_[3 * t + 1] + links_[3 * t + 2] < 2; }

  void emit_strip_from(Index end) {
    const Index exit = exit_of(end, kNone);
    if (exit == kNone) {
      const auto corners = input_.triangles.subspan(std::size_t{3} * end, 3);
      strips_.insert(strips_.end(), corners.begin(), corners.end());
      strips_.push_back(kRestart);
      return;
    }
    follow(exit);
    done_[triangle_of(graph_.opposite[exits_.back()])] = true;
    if (repeats_at_start(false) > repeats_at_start(true)) reverse();
    write();
  }

  // 1 when the first turn goes the wrong way, seen from the front or from the back.
  int repeats_at_start(bool from_back) const {
    if (exits_.size() < 2) return 0;
    const Index entry = from_back ? exits_.back() : graph_.opposite[exits_.front()];
    const Index exit = from_back ? graph_.opposite[exits_[exits_.size() - 2]] : exits_[1];
    return exit == previous_in_triangle(entry) ? 0 : 1;
  }

  void reverse() {
    std::reverse(exits_.begin(), exits_.end());
    for (Index& exit : exits_) exit = graph_.opposite[exit];
  }

  Index origin(Index h) const { return input_.triangles[h]; }

  void write() {
    const Index start = exits_.front();
    // The last two entries, which are the edge the strip stands on.
    Index older = origin(start), newer = origin(next_in_triangle(start));
    strips_.insert(strips_.end(), {origin(previous_in_triangle(start)), older, newer});
    bool even = true;
    for (std::size_t i = 0; i < exits_.size(); ++i) {
      const Index entry = graph_.opposite[exits_[i]];
      if (i + 1 < exits_.size() && (exits_[i + 1] == previous_in_triangle(entry)) != even) {
        strips_.push_back(older);
        std::swap(older, newer);
        even = !even;
      }
      const Index apex = origin(previous_in_triangle(entry));
      strips_.push_back(apex);
      older = newer;
      newer = apex;
      even = !even;
    }
    strips_.push_back(kRestart);
  }

  const StripInput& input_;
  const DualGraph& graph_;
  const Links& links_;
  std::vector<std::uint8_t> done_;  // ends of strips that were begun at the other end
  std::vector<Index> exits_;
  Strips strips_;
};

}  // namespace

std::vector<Index> triangles_by_group(const StripInput& input) {
  std::vector<Index> order(input.triangles.size() / 3);
  std::iota(order.begin(), order.end(), Index{0});
  if (!std::is_sorted(input.group.begin(), input.group.end()))
    std::stable_sort(order.begin(), order.end(),
                     [&](Index a, Index b) { return input.group[a] < input.group[b]; });
  return order;
}

Strips emit_strips(const StripInput& input, const DualGraph& graph, const Links& links) {
  return Emitter(input, graph, links).run();
}

}  // namespace pstrips::inline codecs
