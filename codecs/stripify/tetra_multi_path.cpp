#include "codecs/stripify/tetra_multi_path.h"

#include <algorithm>
#include <array>

#include "codecs/stripify/random.h"

namespace pstrips::inline codecs {
namespace {

constexpr Index tetra_of(Index face) { return face / 4; }

/// Paths of tetrahedra under construction and change.
class TetraPaths {
 public:
  explicit TetraPaths(const TetraGraph& graph)
      : graph_(graph), links_(graph.opposite.size()), degree_(graph.tetra_count()) {}

  bool is_linked(Index face) const { return links_[face] != 0; }
  unsigned link_count(Index t) const { return degree_[t]; }
  Index neighbor(Index face) const {
    return graph_.opposite[face] == kNone ? kNone : tetra_of(graph_.opposite[face]);
  }
  void set_link(Index face, bool on) {
    const Index other = graph_.opposite[face];
    links_[face] = links_[other] = on;
    for (const Index t : {tetra_of(face), tetra_of(other)})
      degree_[t] = static_cast<std::uint8_t>(degree_[t] + (on ? 1 : -1));
  }
  // The link of t other than over `face`, or kNone.
  Index link_beside(Index t, Index face) const {
    for (Index f = 4 * t; f < 4 * t + 4; ++f)
      if (links_[f] && f != face) return f;
    return kNone;
  }
  Index opposite(Index face) const { return graph_.opposite[face]; }
  Index tetra_count() const { return graph_.tetra_count(); }
  const std::vector<std::uint8_t>& links() const { return links_; }

 private:
  const TetraGraph& graph_;
  std::vector<std::uint8_t> links_;
  std::vector<std::uint8_t> degree_;  // links of a tetrahedron
};

/// Links by classes: of tetrahedra that were alone in the beginning, and ends, all in the order in
/// which they came into their class. The class of a tetrahedron only falls.
class MultiPath {
 public:
  explicit MultiPath(TetraPaths& paths)
      : paths_(paths),
        open_(std::size_t{4} * paths.tetra_count()),
        degree_(paths.tetra_count()),
        mate_(paths.tetra_count()) {
    for (Index t = 0; t < paths.tetra_count(); ++t) {
      mate_[t] = t;
      for (Index f = 4 * t; f < 4 * t + 4; ++f) {
        open_[f] = paths.opposite(f) != kNone;
        degree_[t] += open_[f];
      }
      file(t);
    }
  }

  void run() {
    for (Index t; (t = next()) != kNone;) {
      Index f = 4 * t;
      while (!open_[f]) ++f;
      link(f);
    }
  }

 private:
  static constexpr std::size_t kClasses = 7;  // U1 C1 U2 C2 U3 C3 U4

  unsigned class_of(Index t) const { return 2u * degree_[t] - (paths_.link_count(t) ? 1 : 2); }
  void file(Index t) {
    if (degree_[t] > 0) queues_[class_of(t)].push_back(t);
  }
  Index next() {
    for (std::size_t c = 0; c < kClasses; ++c)
      for (std::size_t& head = heads_[c]; head < queues_[c].size(); ++head) {
        const Index t = queues_[c][head];
        if (degree_[t] > 0 && class_of(t) == c) return t;
      }
    return kNone;
  }

  void close(Index f) {
    const Index o = paths_.opposite(f);
    open_[f] = open_[o] = false;
    --degree_[tetra_of(f)];
    --degree_[tetra_of(o)];
  }

  void link(Index f) {
    const Index a = tetra_of(f), b = paths_.neighbor(f);
    paths_.set_link(f, true);
    close(f);
    for (const Index t : {a, b}) {
      if (paths_.link_count(t) < 2) continue;
      for (Index g = 4 * t; g < 4 * t + 4; ++g)
        if (open_[g]) {
          close(g);
          file(paths_.neighbor(g));
        }
    }
    const Index end = mate_[a], other = mate_[b];
    mate_[end] = other;
    mate_[other] = end;
    for (Index g = 4 * end; g < 4 * end + 4; ++g)
      if (open_[g] && paths_.neighbor(g) == other) close(g);
    for (const Index t : {a, b, end, other}) file(t);
  }

  TetraPaths& paths_;
  std::vector<std::uint8_t> open_, degree_;
  std::vector<Index> mate_;
  std::array<std::vector<Index>, kClasses> queues_;
  std::array<std::size_t, kClasses> heads_{};
};

/// Moves ends of strips until they meet ends of others.
///
/// An end steps over to a neighbour m in the middle of a strip, and what came after m is cut off:
/// there are as many strips as before, and the end is elsewhere. When m is on the end's own strip
/// the link of m on the way to the end must be the one that goes, or there were a ring.
class Slides {
 public:
  Slides(TetraPaths& paths, const StripOptions& options)
      : paths_(paths),
        options_(options),
        random_(options.seed),
        steps_left_(std::uint64_t{kStepsPerTetra} * options.effort * paths.tetra_count()),
        mate_(paths.tetra_count(), kNone),
        surplus_(paths.tetra_count() - component_count()) {
    Index links = 0;  // both ways
    for (Index t = 0; t < paths.tetra_count(); ++t) {
      links += paths.link_count(t);
      if (paths.link_count(t) > 1) continue;
      ends_.push_back(t);
      mate_[t] = far_end(t);
    }
    surplus_ -= links / 2;
  }

  void run() {
    while (surplus_ > 0 && steps_left_ > 0) {
      --steps_left_;
      const Index at = random_.below(static_cast<Index>(ends_.size()));
      if (options_.stop && options_.stop()) return;
      if (paths_.link_count(ends_[at]) < 2) {
        walk(ends_[at]);
      } else {
        ends_[at] = ends_.back();
        ends_.pop_back();
      }
    }
  }

 private:
  // Steps along strips that an effort of 1 grants; about twice the time the paths take.
  static constexpr std::uint32_t kStepsPerTetra = 32;
  static constexpr int kSlidesOfAWalk = 100;

  Index component_count() const {
    Index count = 0;
    std::vector<std::uint8_t> seen(paths_.tetra_count());
    std::vector<Index> open;
    for (Index start = 0; start < paths_.tetra_count(); ++start) {
      if (seen[start]) continue;
      ++count;
      for (seen[start] = true, open.assign(1, start); !open.empty();) {
        const Index t = open.back();
        open.pop_back();
        for (Index f = 4 * t; f < 4 * t + 4; ++f) {
          const Index n = paths_.neighbor(f);
          if (n == kNone || seen[n]) continue;
          seen[n] = true;
          open.push_back(n);
        }
      }
    }
    return count;
  }

  // Follows the strip of t from its link over `exit`.
  Index far_end(Index t) const {
    Index exit = paths_.link_beside(t, kNone);
    while (exit != kNone) {
      const Index entry = paths_.opposite(exit);
      t = tetra_of(entry);
      exit = paths_.link_beside(t, entry);
    }
    return t;
  }

  void walk(Index end) {
    Index back = kNone;  // the face over which the last link was cut
    for (int slides = 0; slides < kSlidesOfAWalk; ++slides) {
      if (join(end)) return;
      const Index face = way_from(end, back);
      if (face == kNone) return;
      back = slide(end, face);
      if (back == kNone) return;
      end = tetra_of(back);
    }
  }

  // Links the end to the end of another strip next to it, if there is one.
  bool join(Index end) {
    for (Index f = 4 * end; f < 4 * end + 4; ++f) {
      const Index n = paths_.neighbor(f);
      if (n == kNone || paths_.link_count(n) > 1 || n == mate_[end]) continue;
      const Index a = mate_[end], b = mate_[n];
      paths_.set_link(f, true);
      set_mates(a, b);
      --surplus_;
      return true;
    }
    return false;
  }
  void set_mates(Index a, Index b) {
    mate_[a] = b;
    mate_[b] = a;
  }

  // One of the faces over which the end can slide, at random; not where it came from.
  Index way_from(Index end, Index back) {
    Index best = kNone, seen = 0;
    for (Index f = 4 * end; f < 4 * end + 4; ++f) {
      const Index n = paths_.neighbor(f);
      if (n == kNone || f == back || paths_.is_linked(f) || paths_.link_count(n) < 2) continue;
      if (random_.below(++seen) == 0) best = f;
    }
    return best;
  }

  // Returns the face over which the new end lost its link; kNone when the strips are too long for
  // the steps that are left.
  Index slide(Index end, Index face) {
    const Index m = paths_.neighbor(face);
    const Index one = paths_.link_beside(m, kNone), two = paths_.link_beside(m, one);
    const auto [found, over] = nearest_end(one, two);
    if (found == kNone) return kNone;
    const Index beside = over == one ? two : one;
    const bool is_own = found == end || found == mate_[end];
    const Index cut = found == end ? over : beside;
    const Index new_end_face = paths_.opposite(cut);
    const Index new_end = tetra_of(new_end_face);
    const Index near = mate_[end], far = mate_[found];
    paths_.set_link(cut, false);
    paths_.set_link(face, true);
    if (is_own) {
      set_mates(new_end, near);
    } else {
      set_mates(near, found);
      set_mates(new_end, far);
    }
    ends_.push_back(new_end);
    return new_end_face;
  }

  struct Found {
    Index end, over;  // the end, and by which link of m it is reached
  };

  // Follows two links of a tetrahedron at once, so that the nearer end decides the cost.
  Found nearest_end(Index one, Index two) {
    Index exit_one = one, exit_two = two;
    for (; steps_left_ > 0; --steps_left_) {
      const Index entry_one = paths_.opposite(exit_one), entry_two = paths_.opposite(exit_two);
      exit_one = paths_.link_beside(tetra_of(entry_one), entry_one);
      if (exit_one == kNone) return {tetra_of(entry_one), one};
      exit_two = paths_.link_beside(tetra_of(entry_two), entry_two);
      if (exit_two == kNone) return {tetra_of(entry_two), two};
    }
    return {kNone, kNone};
  }

  TetraPaths& paths_;
  const StripOptions& options_;
  Random random_;
  std::uint64_t steps_left_;
  std::vector<Index> mate_;  // of an end, the other end of its strip
  std::vector<Index> ends_;  // all of them, and some that were
  Index surplus_;            // strips beyond one a component
};

}  // namespace

TetraStrips tetra_multi_path(std::span<const Index> tetrahedra, Index vertex_count,
                             const StripOptions& options) {
  const TetraGraph graph = make_tetra_graph(tetrahedra, vertex_count);
  TetraPaths paths(graph);
  MultiPath(paths).run();
  Slides(paths, options).run();
  return emit_tetra_strips(tetrahedra, graph, paths.links());
}

}  // namespace pstrips::inline codecs
