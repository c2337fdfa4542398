#include "codecs/filter/derived_strips.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "core/edge_pairs.h"
#include "core/group_by.h"

namespace pstrips::inline codecs {
namespace {

struct Triangles {
  std::span<const Index> corners;
  std::span<const Index> group;  // ascending, or empty
  Index wedge_count;
};

// How a triangle is left that was entered over a half-edge: over the next one or the previous one.
enum Turn : std::uint8_t { kAfter, kBefore, kNoTurn };

constexpr Index exit_of(Index entry, Turn turn) {
  return turn == kAfter ? next_half_edge(entry) : previous_half_edge(entry);
}

// A triangle of a spanning tree, with a child at either turn.
struct Node {
  static constexpr std::int8_t kImpossible = 100;

  Index entry;
  std::array<Index, 2> child{};  // nodes; 0: none, for the first node of all is nobody's child
  // What a link to its parent adds to the cost of a cut there, if the strip ends in this triangle
  // or goes on to that child.
  std::int8_t end = 0;
  std::array<std::int8_t, 2> onward{kImpossible, kImpossible};
  bool turned_after : 1 = false;  // its parent, to it
  bool is_linked : 1 = false;     // to its parent
};

// Spanning trees, depth first, over the neighbour that has fewer free neighbours itself, of two
// equals over the one at which turns alternate. Nodes stand in the order in which they are reached.
class Forest {
 public:
  explicit Forest(std::span<const Index> opposite)
      : opposite_(opposite), free_neighbors_(opposite.size() / 3) {
    for (std::size_t t = 0; t < free_neighbors_.size(); ++t)
      for (const Index h : opposite.subspan(3 * t, 3))
        if (h != kNone) ++free_neighbors_[t];
    nodes_.reserve(free_neighbors_.size());
  }

  std::vector<Node> grow() {
    std::vector<Index> open;
    for (Index root = 0; root < free_neighbors_.size(); ++root) {
      if (!is_free(root)) continue;
      open.push_back(reach(entry_of_root(root), kNoTurn));
      while (!open.empty()) {
        const Index child = next_child(open.back());
        if (child == 0)
          open.pop_back();
        else
          open.push_back(child);
      }
    }
    return std::move(nodes_);
  }

 private:
  static constexpr std::uint8_t kTaken = 0x80;

  bool is_free(Index t) const { return free_neighbors_[t] < kTaken; }
  bool is_free_over(Index h) const { return opposite_[h] != kNone && is_free(opposite_[h] / 3); }

  // A half-edge without a free neighbour, so that none is left out, or the first.
  Index entry_of_root(Index t) const {
    for (Index h = 3 * t; h < 3 * t + 3; ++h)
      if (!is_free_over(h)) return h;
    return 3 * t;
  }

  Index reach(Index entry, Turn turn) {
    const Index t = entry / 3;
    free_neighbors_[t] += kTaken;
    for (Index h = 3 * t; h < 3 * t + 3; ++h)
      if (opposite_[h] != kNone) --free_neighbors_[opposite_[h] / 3];
    nodes_.push_back({.entry = entry, .turned_after = turn == kAfter});
    return static_cast<Index>(nodes_.size() - 1);
  }

  // 0: there is none.
  Index next_child(Index node) {
    const Index entry = nodes_[node].entry;
    if (free_neighbors_[entry / 3] == kTaken) return 0;
    const Index after = next_half_edge(entry), before = previous_half_edge(entry);
    const bool has_after = is_free_over(after), has_before = is_free_over(before);
    if (!has_after && !has_before) return 0;  // but a root may have one over `entry`
    Turn turn = has_after ? kAfter : kBefore;
    if (has_after && has_before) {
      const unsigned of_after = free_neighbors_[opposite_[after] / 3],
                     of_before = free_neighbors_[opposite_[before] / 3];
      if (of_before < of_after || (of_before == of_after && nodes_[node].turned_after))
        turn = kBefore;
    }
    const Index child = reach(opposite_[exit_of(entry, turn)], turn);
    nodes_[node].child[turn] = child;
    return child;
  }

  std::span<const Index> opposite_;
  std::vector<std::uint8_t> free_neighbors_;  // of each triangle, and whether it is taken itself
  std::vector<Node> nodes_;
};

// Cuts trees into strips: with the least sum of three a strip and one a swap.
class StripMaker {
 public:
  StripMaker(std::span<const Index> corners, std::span<const Index> opposite)
      : corners_(corners), opposite_(opposite), nodes_(Forest(opposite).grow()) {
    out_.reserve(corners.size() / 2);
  }

  DisplayStrips run() {
    for (std::size_t node = nodes_.size(); node-- > 0;) weigh(nodes_[node]);
    for (const Node& node : nodes_)
      if (!node.is_linked) add_strip(node);
    return std::move(out_);
  }

 private:
  static constexpr int kStrip = 3;

  struct Way {
    int cost;
    Turn turn;  // kNoTurn: the strip ends
  };
  // The way on from a triangle that was entered after a turn; the same turn again is a swap.
  static Way way_on(const Node& node, Turn turn) {
    Way best{node.end, kNoTurn};
    for (const Turn next : {kAfter, kBefore})
      if (const int cost = node.onward[next] + (next == turn ? 1 : 0); cost < best.cost)
        best = {cost, next};
    return best;
  }
  int cost_of(Index child, Turn turn) const {
    return child == 0 ? Node::kImpossible : way_on(nodes_[child], turn).cost;
  }

  // To which children a triangle is best linked that is cut off from its parent.
  struct Links {
    int cost = 0;
    bool after = false, before = false;
  };
  Links links_below(const Node& node) const {
    const auto [after, before] = node.child;
    Links best;
    if (const int cost = cost_of(after, kNoTurn); cost < best.cost) best = {cost, true, false};
    if (const int cost = cost_of(before, kNoTurn); cost < best.cost) best = {cost, false, true};
    if (const int cost = cost_of(after, kBefore) + cost_of(before, kAfter); cost < best.cost)
      best = {cost, true, true};
    return best;
  }

  void weigh(Node& node) const {
    const int cut = kStrip + links_below(node).cost;
    node.end = static_cast<std::int8_t>(-cut);
    for (const Turn turn : {kAfter, kBefore})
      if (node.child[turn] != 0)
        node.onward[turn] = static_cast<std::int8_t>(cost_of(node.child[turn], turn) - cut);
  }

  void add_strip(const Node& top) {
    const Links links = links_below(top);
    exits_.clear();
    if (links.after) follow(top, kAfter, links.before ? kBefore : kNoTurn);
    if (links.before) {
      reverse();
      follow(top, kBefore, links.after ? kAfter : kNoTurn);
    }
    write(top.entry / 3);
  }

  // Goes down from a node to a child, as if `turn` had been the turn to it.
  void follow(const Node& top, Turn to, Turn turn) {
    for (const Node* node = &top; to != kNoTurn;) {
      exits_.push_back(exit_of(node->entry, to));
      Node& child = nodes_[node->child[to]];
      child.is_linked = true;
      to = way_on(child, turn).turn;
      turn = to;
      node = &child;
    }
  }

  void reverse() {
    std::ranges::reverse(exits_);
    for (Index& exit : exits_) exit = opposite_[exit];
  }

  // The first turn has to be kBefore, whichever end is the first.
  bool starts_with_swap() const {
    return exits_.size() > 1 && exits_[1] != previous_half_edge(opposite_[exits_[0]]);
  }

  void write(Index triangle) {
    if (!out_.empty()) out_.push_back(kRestart);
    if (exits_.empty()) {
      for (Index h = 3 * triangle; h < 3 * triangle + 3; ++h) out_.push_back(corners_[h]);
      return;
    }
    if (starts_with_swap()) {
      reverse();
      if (starts_with_swap()) reverse();
    }
    // The last two entries are the edge that the strip stands on.
    Index older = corners_[exits_[0]], newer = corners_[next_half_edge(exits_[0])];
    out_.insert(out_.end(), {corners_[previous_half_edge(exits_[0])], older, newer});
    Turn straight = kBefore;
    for (std::size_t i = 0; i < exits_.size(); ++i) {
      const Index entry = opposite_[exits_[i]];
      if (i + 1 < exits_.size() && exits_[i + 1] != exit_of(entry, straight)) {
        out_.push_back(older);
        std::swap(older, newer);
        straight = straight == kBefore ? kAfter : kBefore;
      }
      out_.push_back(corners_[previous_half_edge(entry)]);
      older = std::exchange(newer, out_.back());
      straight = straight == kBefore ? kAfter : kBefore;
    }
  }

  std::span<const Index> corners_, opposite_;
  std::vector<Node> nodes_;
  std::vector<Index> exits_;  // half-edges over which the strip at hand leaves its triangles
  DisplayStrips out_;
};

void sort_by_group(std::size_t groups, std::vector<Index>& corners, std::vector<Index>& group) {
  const Grouped<Index> triangles =
      group_by(groups, group.size(), [&](Index t) { return group[t]; });
  std::vector<Index> sorted;
  sorted.reserve(corners.size());
  for (const Index t : triangles.elements) {
    const auto triangle = std::span(corners).subspan(std::size_t{3} * t, 3);
    sorted.insert(sorted.end(), triangle.begin(), triangle.end());
  }
  corners = std::move(sorted);
  std::ranges::sort(group);
}

}  // namespace

DisplayStrips derive_strips(std::span<const Index> corners, std::span<const Index> group,
                            Index wedge_count) {
  assert(corners.size() % 3 == 0 && (group.empty() || group.size() == corners.size() / 3));
  const Triangles triangles{corners, group, wedge_count};
  const std::vector<Index> opposite =
      pair_half_edges(triangles.corners, triangles.group, triangles.wedge_count);
  return StripMaker(corners, opposite).run();
}

DisplayStrips derive_strips(const LevelView& level) {
  const bool grouped = level.mesh->groups.size() > 1;
  std::size_t shown = 0;
  for_each_triangle(level, [&](Index, Index, Index, Index) { ++shown; });
  if (!grouped && 3 * shown == level.resolved.size())
    return derive_strips(level.resolved, {}, level.wedges);

  std::vector<Index> corners, group;
  corners.reserve(3 * shown);
  bool sorted = true;
  for_each_triangle(level, [&](Index a, Index b, Index c, Index g) {
    corners.insert(corners.end(), {a, b, c});
    if (!grouped) return;
    sorted &= group.empty() || group.back() <= g;
    group.push_back(g);
  });
  if (!sorted) sort_by_group(level.mesh->groups.size(), corners, group);
  return derive_strips(corners, group, level.wedges);
}

}  // namespace pstrips::inline codecs
