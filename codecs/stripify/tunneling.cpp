#include "codecs/stripify/tunneling.h"

#include <algorithm>
#include <cstddef>

#include "codecs/stripify/sgi.h"

namespace pstrips::inline codecs {
namespace {

using HalfEdge = LinkedPaths::HalfEdge;

class Tunneler {
 public:
  Tunneler(LinkedPaths& paths, const StripOptions& options, int most_swaps)
      : paths_(paths),
        stop_(options.stop),
        most_swaps_(most_swaps),
        max_depth_((std::max(options.tunnel_length, 1u) - 1) / 2),
        steps_left_(options.tunnel_length == 0
                        ? 0
                        : std::uint64_t{options.tunnel_effort} * paths.triangle_count()),
        place_(paths.triangle_count()),
        last_(paths.triangle_count(), kNone),
        reached_in_(paths.triangle_count()) {
    for (Index t = 0; t < paths.triangle_count(); ++t)
      if (paths.is_end(t)) number_path_of(t);
  }

  void run() {
    std::vector<Index> ends;
    for (Index t = 0; t < paths_.triangle_count(); ++t)
      if (paths_.is_end(t)) ends.push_back(t);
    for (bool again = true; again;) {
      again = false;
      for (const Index t : ends)
        while (paths_.is_end(t) && dig_from(t)) again = true;
      std::erase_if(ends, [&](Index t) { return !paths_.is_end(t); });  // none is made
    }
  }

 private:
  static constexpr std::uint64_t kStepsBetweenAsking = 4096;
  static constexpr std::uint64_t kStepsAsLongAsOne = 8;  // what a long branch costs to look through

  // On the path that is named after its first triangle; since when.
  struct Place {
    Index path, position, numbering = 0;
  };
  // Two edges of a tunnel: over `link` to triangle `by`, which is cut off over `cut` from `end`,
  // where the tunnel goes on. The first step of a search has an end alone.
  struct Step {
    Index parent, depth;
    HalfEdge link, cut;
    Index by, end;
  };
  // Between positions `before` and before + 1.
  struct Cut {
    Index path, before;
  };

  Index over(HalfEdge h) const { return LinkedPaths::triangle_of(paths_.opposite(h)); }

  // Digs the first tunnel that it finds.
  bool dig_from(Index start) {
    ++search_;
    reached_in_[start] = search_;
    steps_.assign(1, {0, 0, kNone, kNone, kNone, start});
    for (Index s = 0; s < steps_.size() && may_go_on(); ++s) {
      collect_branch(s);
      steps_left_ -= std::min<std::uint64_t>(steps_left_, branch_.size() / kStepsAsLongAsOne);
      for (Index k = 0; k < 3; ++k) {
        const HalfEdge link = LinkedPaths::half_edge(steps_[s].end, k);
        if (!paths_.has_opposite(link) || paths_.is_linked(link) || is_on_branch(over(link)))
          continue;
        if (leads_to_another_strip(link) &&
            (most_swaps_ == kAnySwaps || swaps_of(link) <= most_swaps_)) {
          dig(link);
          return true;
        }
        if (steps_[s].depth < max_depth_) add_steps(s, link);
      }
    }
    return false;
  }

  bool may_go_on() {
    if (steps_left_ == 0) return false;
    --steps_left_;
    if (++steps_made_ % kStepsBetweenAsking == 0 && stop_ && stop_()) steps_left_ = 0;
    return steps_left_ > 0;
  }

  bool leads_to_another_strip(HalfEdge link) const {
    const Index t = over(link);
    return paths_.is_end(t) && !leads_to_end_of_branch(t, place_[t].position == 0);
  }

  void add_steps(Index s, HalfEdge link) {
    const Index by = over(link);
    const HalfEdge first = paths_.is_single(by) ? kNone : paths_.first_link(by);
    for (HalfEdge cut = first; cut != kNone;
         cut = cut == first ? paths_.other_link(first) : kNone) {
      const Index end = over(cut);
      if (reached_in_[end] == search_ || is_on_branch(end)) continue;
      const HalfEdge kept = paths_.other_link(cut);
      if (kept != kNone && leads_to_end_of_branch(by, is_above(over(kept), by))) continue;
      reached_in_[end] = search_;
      steps_.push_back({s, steps_[s].depth + 1, link, cut, by, end});
    }
  }

  // The steps from the first one to s, and what they cut.
  void collect_branch(Index s) {
    branch_.clear();
    for (; s != 0; s = steps_[s].parent) branch_.push_back(steps_[s]);
    branch_.push_back(steps_[0]);
    std::reverse(branch_.begin(), branch_.end());
    cuts_.assign(1, {kNone, 0});
    for (std::size_t i = 1; i < branch_.size(); ++i) {
      const Place &by = place_[branch_[i].by], &end = place_[branch_[i].end];
      cuts_.push_back({by.path, std::min(by.position, end.position)});
    }
  }

  bool is_on_branch(Index t) const {
    return std::ranges::any_of(branch_, [t](const Step& b) { return b.by == t || b.end == t; });
  }

  // Precondition: both are on one path.
  bool is_above(Index a, Index b) const { return place_[a].position > place_[b].position; }

  // Whether, once the branch is changed, the path from t on, upwards or downwards, ends where the
  // branch does. Numbers are those of the paths as they are: the walk goes to the next cut, and
  // from there over the link made by the same step or by the one after it.
  bool leads_to_end_of_branch(Index t, bool up) const {
    for (;;) {
      const std::size_t i = next_cut(place_[t], up);
      const Index before_cut = cuts_[i].before + (up ? 0 : 1);
      if (i == 0 && (up ? last_[place_[t].path] : place_[t].path) != branch_[0].end) return false;
      if (i == 0 || place_[branch_[i].end].position == before_cut) {
        if (i + 1 == branch_.size()) return true;
        t = branch_[i + 1].by;
        up = is_above(t, branch_[i + 1].end);
      } else {
        t = branch_[i - 1].end;
        if (i == 1 && paths_.is_single(t)) return false;
        up = i == 1 ? place_[t].position == 0 : is_above(t, branch_[i - 1].by);
      }
    }
  }

  // The step whose cut is the next one from a place; 0 when there is none before the path's end.
  std::size_t next_cut(const Place& from, bool up) const {
    std::size_t next = 0;
    for (std::size_t i = 1; i < cuts_.size(); ++i) {
      const Cut& cut = cuts_[i];
      if (cut.path != from.path || (cut.before >= from.position) != up) continue;
      if (next == 0 || (cut.before < cuts_[next].before) == up) next = i;
    }
    return next;
  }

  // Changes the branch and the link that makes it a tunnel, or changes them back; gives the swaps
  // that this adds.
  int change_tunnel(HalfEdge last_link) {
    int swaps = 0;
    const auto flip = [&](HalfEdge h) {
      swaps += paths_.is_linked(h) ? -paths_.link_cost(h) : paths_.link_cost(h);
      paths_.flip(h);
    };
    for (std::size_t i = 1; i < branch_.size(); ++i) {
      flip(branch_[i].cut);
      flip(branch_[i].link);
    }
    flip(last_link);
    return swaps;
  }

  int swaps_of(HalfEdge last_link) {
    const int swaps = change_tunnel(last_link);
    change_tunnel(last_link);
    return swaps;
  }

  void dig(HalfEdge last_link) {
    change_tunnel(last_link);
    ++numbering_;
    number_path_of(over(last_link));
    for (std::size_t i = 1; i < branch_.size(); ++i) {
      number_path_of(branch_[i].by);
      number_path_of(branch_[i].end);
    }
  }

  void number_path_of(Index t) {
    if (place_[t].numbering == numbering_) return;
    if (!paths_.is_single(t)) {
      HalfEdge entry = paths_.first_link(t);
      for (HalfEdge exit; (exit = paths_.other_link(entry)) != kNone;)
        entry = paths_.opposite(exit);
      t = LinkedPaths::triangle_of(entry);
    }
    const Index first = t;
    HalfEdge exit = paths_.is_single(t) ? kNone : paths_.first_link(t);
    for (Index position = 0;; ++position) {
      place_[t] = {first, position, numbering_};
      if (exit == kNone) break;
      t = over(exit);
      exit = paths_.other_link(paths_.opposite(exit));
    }
    last_[first] = t;
  }

  LinkedPaths& paths_;
  const std::function<bool()>& stop_;
  int most_swaps_;
  Index max_depth_;
  std::uint64_t steps_left_, steps_made_ = 0;
  std::vector<Place> place_;
  std::vector<Index> last_;  // of the first triangle of a path
  Index numbering_ = 1;
  std::vector<Index> reached_in_;  // the last search with a step that ends there
  Index search_ = 0;
  std::vector<Step> steps_;   // of the search, in order of depth
  std::vector<Step> branch_;  // from the first step to the one that is followed
  std::vector<Cut> cuts_;     // those of branch_; the first is none
};

}  // namespace

void dig_tunnels(LinkedPaths& paths, const StripOptions& options, int most_swaps) {
  Tunneler(paths, options, most_swaps).run();
}

Strips tunneling(const StripInput& input, const StripOptions& options) {
  const DualGraph graph = make_dual_graph(input);
  LinkedPaths paths(graph, sgi_strips_links(graph));
  dig_tunnels(paths, options);
  return emit_strips(input, graph, paths.links());
}

}  // namespace pstrips::inline codecs
