#pragma once

#include <vector>

#include "core/mesh.h"

// For formats/pstrip/payload/compact: which wedges a vertex has.

namespace pstrips::inline formats {

/// The wedges of each vertex, and how many corners show each.
class WedgeLists {
 public:
  Index size() const { return static_cast<Index>(vertex_.size()); }
  Index vertex_of(Index wedge) const { return vertex_[wedge]; }
  Index& uses(Index wedge) { return uses_[wedge]; }
  Index uses(Index wedge) const { return uses_[wedge]; }

  /// A new wedge, which no corner shows.
  void add(Index vertex) {
    vertex_.push_back(vertex);
    uses_.push_back(0);
    links_.emplace_back();
    link(size() - 1);
  }
  void move(Index wedge, Index vertex) {
    const auto [next, previous] = links_[wedge];
    if (next != kNone) links_[next].previous = previous;
    (previous != kNone ? links_[previous].next : first_[vertex_[wedge]]) = next;
    vertex_[wedge] = vertex;
    link(wedge);
  }

  /// Wedges of a vertex, the last one that came first, `most` of them at most.
  void list(Index vertex, std::size_t most, std::vector<Index>& out) const {
    out.clear();
    if (vertex >= first_.size()) return;
    for (Index w = first_[vertex]; w != kNone && out.size() < most; w = links_[w].next)
      out.push_back(w);
  }

 private:
  struct Link {
    Index next = kNone, previous = kNone;  // wedges of the same vertex
  };

  void link(Index wedge) {
    const Index vertex = vertex_[wedge];
    if (vertex >= first_.size()) first_.resize(std::size_t{vertex} + 1, kNone);
    Index& first = first_[vertex];
    links_[wedge] = {first, kNone};
    if (first != kNone) links_[first].previous = wedge;
    first = wedge;
  }

  std::vector<Index> vertex_, uses_;
  std::vector<Link> links_;
  std::vector<Index> first_;  // of each vertex
};

}  // namespace pstrips::inline formats
