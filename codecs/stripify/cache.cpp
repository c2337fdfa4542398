#include "codecs/stripify/cache.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "codecs/stripify/dual_graph.h"
#include "codecs/stripify/emit.h"

namespace pstrips::inline codecs {
namespace {

constexpr Index kCacheEntries = 16;
constexpr Index kMaxLength = 2 * kCacheEntries;  // of a row: it loads a wedge every other triangle
constexpr std::uint64_t kLoadPrice = 2;          // in entries

// Which edge of a triangle a row leaves over if it can, seen from the edge it came in over. With
// the strip beside it on that side, it winds along that strip.
enum class ExitSide : std::uint8_t { none, before, after };

struct Start {
  Index triangle;
  Index exit;  // kNone: the row is this triangle
  ExitSide exit_side;
};

// The average cost of a triangle, as a fraction.
struct Cost {
  std::uint64_t entries;
  std::uint64_t triangles;
  friend bool operator<(const Cost& a, const Cost& b) {
    return a.entries * b.triangles < b.entries * a.triangles;
  }
};

struct Trial {
  Start start{};
  Index length = 0;  // 0: nothing tried yet
  Cost cost{};
};

class Rows {
 public:
  Rows(const StripInput& input, const DualGraph& graph)
      : input_(input),
        graph_(graph),
        is_taken_(graph.triangle_count()),
        loaded_(input.wedge_count) {}

  Strips run() {
    for (const Index seed : triangles_by_group(input_)) {
      if (is_taken_[seed]) continue;
      lay_from(seed);
      while (lay_beside()) continue;
    }
    return std::move(strips_);
  }

 private:
  // A row under way. Its last triangle is taken, but its apex not written: whether that takes a
  // swap depends on the edge the row leaves over.
  struct Head {
    Index triangle;
    Index entry;       // kNone in the first triangle
    Index first_exit;  // where the row leaves that
    Index older, newer;
    bool even;  // the turn without swap is to the edge before
    ExitSide exit_side;
  };

  struct Mark {
    Head head;
    Index loads;
    std::size_t reloaded, taken, sides, strips;
  };

  struct Reloaded {
    Index wedge;
    Index loaded_before;
  };

  Index origin(Index h) const { return input_.triangles[h]; }
  Index target(Index h) const { return input_.triangles[next_in_triangle(h)]; }

  bool is_cached(Index wedge) const { return loads_ - loaded_[wedge] < kCacheEntries; }
  bool is_open(Index h) const {
    const Index n = graph_.neighbor(h);
    return n != kNone && !is_taken_[n];
  }
  bool is_ready(Index side) const {
    return is_open(side) && is_cached(origin(side)) && is_cached(target(side));
  }

  // Everything a row changes, so that a trial can be undone.

  Mark mark() const {
    return {head_, loads_, reloaded_.size(), taken_.size(), sides_.size(), strips_.size()};
  }

  void undo(const Mark& mark) {
    for (; reloaded_.size() > mark.reloaded; reloaded_.pop_back())
      loaded_[reloaded_.back().wedge] = reloaded_.back().loaded_before;
    for (; taken_.size() > mark.taken; taken_.pop_back()) is_taken_[taken_.back()] = false;
    head_ = mark.head;
    loads_ = mark.loads;
    sides_.resize(mark.sides);
    strips_.resize(mark.strips);
  }

  Cost cost_since(const Mark& mark) const {
    return {kLoadPrice * (loads_ - mark.loads) + (strips_.size() - mark.strips),
            taken_.size() - mark.taken};
  }

  void take(Index t) {
    is_taken_[t] = true;
    taken_.push_back(t);
  }

  void write(Index wedge) {
    strips_.push_back(wedge);
    if (is_cached(wedge)) return;
    reloaded_.push_back({wedge, loaded_[wedge]});
    loaded_[wedge] = ++loads_;
  }

  // A row, step by step: begin, any number of steps, end.

  void begin(const Start& start) {
    const Index lead = start.exit == kNone ? 3 * start.triangle : start.exit;
    head_ = {start.triangle, kNone, start.exit, origin(lead), target(lead), true, start.exit_side};
    take(start.triangle);
    if (!strips_.empty()) strips_.push_back(kRestart);
    write(origin(previous_in_triangle(lead)));
    write(head_.older);
    write(head_.newer);
  }

  // Over the next edge; false where there is none.
  bool step() {
    const Index exit = next_exit();
    if (exit == kNone) return false;
    leave_over(exit);
    head_.entry = graph_.opposite[exit];
    head_.triangle = triangle_of(head_.entry);
    take(head_.triangle);
    return true;
  }

  void end() { leave_over(kNone); }

  Index next_exit() const {
    if (head_.entry == kNone) return head_.first_exit;
    Index wanted = previous_in_triangle(head_.entry), other = next_in_triangle(head_.entry);
    const bool wants_before =
        head_.exit_side == ExitSide::none ? head_.even : head_.exit_side == ExitSide::before;
    if (!wants_before) std::swap(wanted, other);
    return is_open(wanted) ? wanted : is_open(other) ? other : kNone;
  }

  void leave_over(Index exit) {
    if (head_.entry != kNone) write_apex(exit);
    for (Index h = 3 * head_.triangle; h < 3 * head_.triangle + 3; ++h)
      if (h != exit && is_open(h)) sides_.push_back(h);
  }

  void write_apex(Index exit) {
    const Index before = previous_in_triangle(head_.entry);
    if (exit != kNone && (exit == before) != head_.even) {
      write(head_.older);
      std::swap(head_.older, head_.newer);
      head_.even = !head_.even;
    }
    write(origin(before));
    head_.older = std::exchange(head_.newer, origin(before));
    head_.even = !head_.even;
  }

  void walk(const Start& start, Index length) {
    begin(start);
    for (Index i = 1; i < length && step(); ++i) continue;
    end();
  }

  // Which row comes next.

  Start toward_origin(Index side) const {
    const Index entry = graph_.opposite[side];
    return {triangle_of(entry), previous_in_triangle(entry), ExitSide::before};
  }
  Start toward_target(Index side) const {
    const Index entry = graph_.opposite[side];
    return {triangle_of(entry), next_in_triangle(entry), ExitSide::after};
  }

  // The row along `side` the way the wedges of the strip beside it were loaded.
  Start row_along(Index side) const {
    Start ahead = toward_origin(side), back = toward_target(side);
    if (loaded_[target(side)] < loaded_[origin(side)]) std::swap(ahead, back);
    if (is_open(ahead.exit)) return ahead;
    if (is_open(back.exit)) return back;
    return {ahead.triangle, kNone, ExitSide::none};
  }

  // The first side from there on that the next row can start at with two wedges in the cache.
  Index ready_side_from(std::size_t place) const {
    for (; place < sides_.size(); ++place)
      if (is_ready(sides_[place])) return sides_[place];
    return kNone;
  }

  // Every length of the row, each with a row as long beside it.
  Trial try_lengths(const Start& start) {
    const Mark before = mark();
    Trial best{start, 0, {}};
    begin(start);
    for (Index length = 1;; ++length) {
      const Mark here = mark();
      end();
      if (const Index side = ready_side_from(before.sides); side != kNone)
        walk(row_along(side), length);
      const Cost cost = cost_since(before);
      undo(here);
      if (best.length == 0 || !(best.cost < cost)) best = {start, length, cost};
      if (length == kMaxLength || !step()) break;
    }
    undo(before);
    return best;
  }

  void consider(const Start& start, Trial& best) {
    if (start.exit != kNone && !is_open(start.exit)) return;
    const Trial trial = try_lengths(start);
    if (best.length == 0 || !(best.cost < trial.cost)) best = trial;
  }

  void consider_along(Index side, Trial& best) {
    const Start row = row_along(side);
    consider(row, best);
    if (row.exit == kNone) return;
    consider(row.exit_side == ExitSide::before ? toward_target(side) : toward_origin(side), best);
  }

  void lay(const Trial& trial) {
    last_row_ = sides_.size();
    walk(trial.start, trial.length);
    reloaded_.clear();
    taken_.clear();
  }

  // A row without another beside it that is cached.
  void lay_from(Index t) {
    Trial best;
    for (Index exit = 3 * t; exit < 3 * t + 3; ++exit)
      for (const ExitSide exit_side : {ExitSide::none, ExitSide::before, ExitSide::after})
        consider({t, exit, exit_side}, best);
    if (best.length == 0) consider({t, kNone, ExitSide::none}, best);
    lay(best);
  }

  // A row beside one that is there; false when nothing free is left beside any.
  bool lay_beside() {
    drop_cold_sides();
    Trial best;
    if (oldest_ < sides_.size()) consider_along(sides_[oldest_], best);
    int left = 2;
    for (std::size_t i = std::max(oldest_ + 1, last_row_); i < sides_.size() && left > 0; ++i) {
      if (!is_ready(sides_[i])) continue;
      consider_along(sides_[i], best);
      --left;
    }
    if (best.length > 0) {
      lay(best);
      return true;
    }
    for (; !cold_.empty(); cold_.pop_back())
      if (is_open(cold_.back())) {
        lay_from(graph_.neighbor(cold_.back()));
        return true;
      }
    return false;
  }

  void drop_cold_sides() {
    for (; oldest_ < sides_.size() && !is_ready(sides_[oldest_]); ++oldest_)
      if (is_open(sides_[oldest_])) cold_.push_back(sides_[oldest_]);
  }

  const StripInput& input_;
  const DualGraph& graph_;
  std::vector<std::uint8_t> is_taken_;
  std::vector<Index> loaded_;    // at which load each wedge was; long ago if never
  Index loads_ = kCacheEntries;  // so that 0 is long ago
  std::vector<Index> sides_;     // of all rows in their order, towards triangles free at the time
  std::size_t oldest_ = 0;       // in sides_; those before are in cold_ or of no more use
  std::size_t last_row_ = 0;     // where its sides begin
  std::vector<Index> cold_;      // sides whose wedges have left the cache
  Head head_{};
  std::vector<Reloaded> reloaded_;  // since the last row was laid
  std::vector<Index> taken_;        // likewise
  Strips strips_;
};

}  // namespace

Strips cache_strips(const StripInput& input, const StripOptions&) {
  const DualGraph graph = make_dual_graph(input);
  return Rows(input, graph).run();
}

}  // namespace pstrips::inline codecs
