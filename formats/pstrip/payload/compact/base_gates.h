#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "core/star_mesh.h"

// For formats/pstrip/payload/compact: where the triangles of a base that are coded end, so that
// others may begin. [spec/compact.md §5]

namespace pstrips::inline formats {

/// An edge of a triangle, as that one has it.
struct BaseGate {
  Index from = kNone, to = kNone;
  Index triangle = kNone;
  unsigned from_corner = 0;  ///< of the triangle
};

/// The gates that wait for a triangle, first come, first served. No two have the same edge,
/// whichever way. Each call is O(log of the gates) but for what it returns.
class BaseGates {
 public:
  bool empty() const { return queue_.empty(); }
  const BaseGate& front() const { return queue_.begin()->second; }
  void pop() { remove(queue_.begin()); }

  /// The edge of a new triangle: it closes the gate that it meets, else it is one itself.
  void add(const BaseGate& gate) {
    if (const auto met = by_start_.find({gate.to, gate.from}); met != by_start_.end())
      return remove(queue_.find(met->second));
    if (!by_start_.emplace(Edge{gate.from, gate.to}, next_).second) return;
    by_end_.emplace(gate.to, gate.from);
    queue_.emplace(next_++, gate);
  }

  /// How many gates at most are served before that one; kNone: there is no such gate.
  Index places_behind(Index from, Index to) const {
    const auto found = by_start_.find({from, to});
    return found == by_start_.end() ? kNone : found->second - queue_.begin()->first;
  }

  /// Where gates that end at the start of this one start, and where gates that start at its end
  /// end, in turns, both ascending, without its ends.
  std::vector<Index> beside(const BaseGate& gate, std::size_t most) const {
    std::vector<Index> out;
    auto before = by_end_.lower_bound({gate.from, 0});
    auto after = by_start_.lower_bound({gate.to, 0});
    const auto is_before = [&] { return before != by_end_.end() && before->first == gate.from; };
    const auto is_after = [&] { return after != by_start_.end() && after->first.first == gate.to; };
    while (out.size() < most && (is_before() || is_after())) {
      if (is_before()) add_once((before++)->second, gate, out);
      if (is_after()) add_once((after++)->first.second, gate, out);
    }
    if (out.size() > most) out.resize(most);
    return out;
  }

  /// The ends of the gates that are served first, without those of `gate` and without `known`.
  std::vector<Index> others(const BaseGate& gate, const std::vector<Index>& known) const {
    constexpr int kGates = 32;
    std::vector<Index> out = known;
    int left = kGates;
    for (auto at = queue_.begin(); at != queue_.end() && left-- > 0; ++at)
      for (const Index v : {at->second.from, at->second.to}) add_once(v, gate, out);
    out.erase(out.begin(), out.begin() + std::ssize(known));
    return out;
  }

 private:
  using Edge = std::pair<Index, Index>;

  static void add_once(Index v, const BaseGate& gate, std::vector<Index>& out) {
    if (v != gate.from && v != gate.to && std::ranges::find(out, v) == out.end()) out.push_back(v);
  }
  void remove(std::map<Index, BaseGate>::iterator at) {
    by_start_.erase({at->second.from, at->second.to});
    by_end_.erase({at->second.to, at->second.from});
    queue_.erase(at);
  }

  std::map<Index, BaseGate> queue_;  // by the order in which they came
  std::map<Edge, Index> by_start_;   // start and end to that order
  std::set<Edge> by_end_;            // end and start
  Index next_ = 0;
};

}  // namespace pstrips::inline formats
