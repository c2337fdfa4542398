#include "codecs/stripify/anneal.h"

#include <algorithm>
#include <array>
#include <utility>

#include "codecs/stripify/random.h"

namespace pstrips::inline codecs {
namespace {

using HalfEdge = LinkedPaths::HalfEdge;
constexpr std::uint64_t kOne = 1ull << 32;

// exp(-1 / T) * 2^32 for T from 1.2 to 0.3 in geometric steps. Tuned on bunny and nefertiti: a
// start between 1 and 1.5 is best at any effort, an end above 0.35 or below 0.25 costs 0.001
// indices a triangle.
constexpr std::array<std::uint64_t, 17> kCooling = {
    1866585092, 1730979610, 1594305170, 1457531588, 1321718308, 1187996474,
    1057544715, 931558647,  811214537,  697628225,  591811020,  494625030,
    406740998,  328602181,  260397984,  202050784,  153218634};

class Annealer {
 public:
  Annealer(LinkedPaths& paths, const StripOptions& options)
      : paths_(paths),
        random_(options.seed),
        stop_(options.stop),
        strip_price_(static_cast<int>(std::min(options.strip_price, kMaxStripPrice))),
        budget_(std::uint64_t{options.effort} * paths.triangle_count()),
        walk_moves_(options.effort < kLongRun ? 4 : 8),
        first_step_(options.effort < kShortRun ? 12 : 0),
        race_steps_(options.effort < kShortRun ? 100 : 5000) {}

  void run() {
    const LinkedPaths start = paths_;
    while (moves_ < budget_ && !stopped_) {
      set_temperature();
      sweep();
    }
    chance_.fill(0);
    for (int pass = 0; pass < 2; ++pass)
      for (Index t = 0; t < paths_.triangle_count(); ++t)
        if (paths_.is_end(t)) walk_end(t, kQuenchMoves);
    if (cost_ > 0) paths_ = start;
  }

 private:
  static constexpr std::uint32_t kShortRun =
      10;  // too short to mend what a high temperature breaks
  static constexpr std::uint32_t kLongRun = 100;
  static constexpr int kQuenchMoves = 11;
  static constexpr Index kStepsBetweenAsking = 4096;

  void set_temperature() {
    const std::uint64_t steps = kCooling.size() - 1 - first_step_;
    const std::uint64_t at = first_step_ * 256 + moves_ * steps * 256 / budget_;
    const std::uint64_t step = at / 256, part = at % 256;
    const std::uint64_t q = (kCooling[step] * (256 - part) + kCooling[step + 1] * part) / 256;
    std::uint64_t power = kOne - 1;
    for (std::uint32_t& chance : chance_) {
      chance = static_cast<std::uint32_t>(power);
      power = power * q >> 32;
    }
  }

  bool accepts(int rise) {
    if (rise <= 0) return true;
    return static_cast<std::size_t>(rise) < chance_.size() &&
           random_.bits() < chance_[static_cast<std::size_t>(rise)];
  }

  void sweep() {
    for (Index t = 0; t < paths_.triangle_count() && !stopped_; ++t) {
      if (t % kStepsBetweenAsking == 0) stopped_ = stop_ && stop_();
      for (Index k = 0; k < 3; ++k) {
        const HalfEdge h = LinkedPaths::half_edge(t, k);
        if (paths_.is_linked(h) && h < paths_.opposite(h)) try_cut(h);
      }
      if (paths_.is_end(t)) walk_end(t, walk_moves_);
    }
    ++moves_;  // of a mesh without links or ends there is nothing to count
  }

  void try_cut(HalfEdge h) {
    ++moves_;
    const int rise = strip_price_ - paths_.link_cost(h);
    if (!accepts(rise)) return;
    paths_.flip(h);
    cost_ += rise;
  }

  void walk_end(Index t, int moves) {
    for (; moves > 0 && paths_.is_end(t); --moves) {
      ++moves_;
      const HalfEdge h = random_free_edge(t);
      if (!paths_.has_opposite(h)) continue;
      const Index neighbor = LinkedPaths::triangle_of(paths_.opposite(h));
      if (paths_.is_end(neighbor) && try_join(h, neighbor)) continue;
      if (!paths_.is_single(neighbor)) t = try_slide(h, neighbor);
    }
  }

  HalfEdge random_free_edge(Index end) {
    if (paths_.is_single(end)) return LinkedPaths::half_edge(end, random_.below(3));
    const HalfEdge link = paths_.first_link(end);
    return random_.below(2) != 0 ? LinkedPaths::next(link) : LinkedPaths::previous(link);
  }

  bool try_join(HalfEdge h, Index neighbor) {
    const int rise = paths_.link_cost(h) - strip_price_;
    if (!accepts(rise)) return false;
    if (paths_.on_same_path(LinkedPaths::triangle_of(h), neighbor, race_steps_)) return false;
    paths_.flip(h);
    cost_ += rise;
    return true;
  }

  // Links h and cuts one of the neighbour's links; gives the end to walk on with.
  Index try_slide(HalfEdge h, Index neighbor) {
    const Index t = LinkedPaths::triangle_of(h);
    HalfEdge cut = paths_.first_link(neighbor), kept = paths_.other_link(cut);
    if (kept != kNone && random_.below(2) != 0) std::swap(cut, kept);
    const int before = paths_.link_cost(cut);
    paths_.flip(cut);
    const int rise = paths_.link_cost(h) - before;
    if (!accepts(rise) || (kept != kNone && paths_.leads_to(kept, t, race_steps_))) {
      paths_.flip(cut);
      return t;
    }
    paths_.flip(h);
    cost_ += rise;
    const Index new_end = LinkedPaths::triangle_of(paths_.opposite(cut));
    return !paths_.is_end(t) || random_.below(2) != 0 ? new_end : t;
  }

  LinkedPaths& paths_;
  Random random_;
  const std::function<bool()>& stop_;
  bool stopped_ = false;
  int strip_price_;
  std::uint64_t budget_;
  int walk_moves_;
  std::uint64_t first_step_;
  std::uint32_t race_steps_;
  std::uint64_t moves_ = 0;
  std::int64_t cost_ = 0;                   // against the start
  std::array<std::uint32_t, 16> chance_{};  // of accepting a rise in cost, times 2^32
};

}  // namespace

void anneal(LinkedPaths& paths, const StripOptions& options) { Annealer(paths, options).run(); }

}  // namespace pstrips::inline codecs
