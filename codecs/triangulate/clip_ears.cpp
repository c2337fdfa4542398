#include "codecs/triangulate/clip_ears.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "codecs/triangulate/live_points.h"

namespace pstrips::inline codecs {
namespace {

// What makes a corner an ear, the strictest first.
enum class Degree : std::uint8_t {
  spike,    // the loop turns back: what lies between has no area
  clear,    // convex, and no other corner in the closed triangle but where it coincides
  touched,  // the same, but corners may lie on the two sides that the polygon has
  flat,     // no area
  rounded,  // convex, and no corner inside by more than coordinates are rounded
  convex,   // self-intersecting polygons have nothing better
  any,
};
constexpr std::size_t kDegrees = 7;

// Depth inside as a share of the larger side of the box around the polygon.
constexpr double kRounded = 1e-7;

bool is_before(const Point2& p, const Point2& q) { return p.x < q.x || (p.x == q.x && p.y < q.y); }

// Of three points on a line.
bool is_between(const Point2& p, const Point2& a, const Point2& b) {
  return (is_before(a, p) && is_before(p, b)) || (is_before(b, p) && is_before(p, a));
}

class EarClipper {
 public:
  explicit EarClipper(std::span<const Point2> loop);
  std::vector<std::array<Index, 3>> clip();

 private:
  struct Candidate {
    Index corner, stamp;
  };
  struct Queue {
    std::vector<Candidate> candidates;
    std::size_t next = 0;
    bool is_empty() const { return next == candidates.size(); }
  };

  void put(Degree degree, Index corner) {
    queues_[static_cast<std::size_t>(degree)].candidates.push_back({corner, stamp_[corner]});
  }
  Degree take(Candidate& candidate);
  bool is_ear(Index corner, Degree degree);
  bool is_blocked(Index corner, Degree degree);
  bool blocks(Index other, const std::array<Index, 3>& ear, Degree degree) const;
  bool leads_between(Index other, const Point2& before, const Point2& apex,
                     const Point2& after) const;
  bool is_deep(const Point2& p, const std::array<Index, 3>& ear) const;
  void cut(Index corner);

  std::span<const Point2> loop_;
  std::vector<Index> previous_, next_;
  std::vector<Index> stamp_;  // changes with a corner's neighbours; kNone: cut off
  std::array<Queue, kDegrees> queues_;
  LivePoints points_;
  std::uint64_t most_work_;
  double depth_ = 0;
  std::vector<std::array<Index, 3>> out_;
};

EarClipper::EarClipper(std::span<const Point2> loop)
    : loop_(loop), stamp_(loop.size(), 0), points_(loop) {
  const auto n = static_cast<Index>(loop.size());
  Point2 low = loop[0], high = loop[0];
  for (Index i = 0; i < n; ++i) {
    previous_.push_back(i == 0 ? n - 1 : i - 1);
    next_.push_back(i + 1 == n ? 0 : i + 1);
    low = {std::min(low.x, loop[i].x), std::min(low.y, loop[i].y)};
    high = {std::max(high.x, loop[i].x), std::max(high.y, loop[i].y)};
    put(Degree::spike, i);
  }
  depth_ = kRounded * std::max(high.x - low.x, high.y - low.y);
  // Far more than polygons take that do not cross themselves.
  constexpr std::uint64_t kWork = 256;
  most_work_ = kWork * n * static_cast<std::uint64_t>(std::bit_width(n));
}

// The next of the strictest queue that has one.
Degree EarClipper::take(Candidate& candidate) {
  std::size_t degree = 0;
  while (queues_[degree].is_empty()) ++degree;
  candidate = queues_[degree].candidates[queues_[degree].next++];
  return static_cast<Degree>(degree);
}

std::vector<std::array<Index, 3>> EarClipper::clip() {
  out_.reserve(loop_.size() - 2);
  while (out_.size() + 2 < loop_.size()) {
    Candidate candidate{};
    const Degree degree = take(candidate);
    if (candidate.stamp != stamp_[candidate.corner]) continue;
    if (is_ear(candidate.corner, degree))
      cut(candidate.corner);
    else
      put(static_cast<Degree>(static_cast<int>(degree) + 1), candidate.corner);
  }
  return std::move(out_);
}

void EarClipper::cut(Index corner) {
  const Index before = previous_[corner], after = next_[corner];
  out_.push_back({before, corner, after});
  next_[before] = after;
  previous_[after] = before;
  stamp_[corner] = kNone;
  points_.remove(corner);
  for (const Index neighbour : {before, after}) {
    ++stamp_[neighbour];
    put(Degree::spike, neighbour);
  }
}

bool EarClipper::is_ear(Index corner, Degree degree) {
  if (degree == Degree::any) return true;
  const Point2 &a = loop_[previous_[corner]], &b = loop_[corner], &c = loop_[next_[corner]];
  const int turn = orient(a, b, c);
  if (degree == Degree::spike) return turn == 0 && !is_between(b, a, c);
  if (degree == Degree::flat) return turn == 0;
  return turn > 0 && (degree == Degree::convex || !is_blocked(corner, degree));
}

bool EarClipper::is_blocked(Index corner, Degree degree) {
  if (points_.work() > most_work_) return true;
  const std::array<Index, 3> ear = {previous_[corner], corner, next_[corner]};
  return points_.any_near({loop_[ear[0]], loop_[ear[1]], loop_[ear[2]]},
                          [&](Index other) { return blocks(other, ear, degree); });
}

bool EarClipper::blocks(Index other, const std::array<Index, 3>& ear, Degree degree) const {
  const Point2 &a = loop_[ear[0]], &b = loop_[ear[1]], &c = loop_[ear[2]], &p = loop_[other];
  if (degree == Degree::rounded) return is_deep(p, ear);
  if (p == a) return leads_between(other, c, a, b);
  if (p == b) return leads_between(other, a, b, c);
  if (p == c) return leads_between(other, b, c, a);
  const int least = degree == Degree::clear ? 0 : 1;
  return orient(a, b, p) >= least && orient(b, c, p) >= least && orient(c, a, p) >= 0;
}

// Whether a side of a corner that coincides with `apex` goes into the ear there.
bool EarClipper::leads_between(Index other, const Point2& before, const Point2& apex,
                               const Point2& after) const {
  const auto is_inside = [&](const Point2& p) {
    return orient(before, apex, p) > 0 && orient(apex, after, p) > 0;
  };
  return is_inside(loop_[previous_[other]]) || is_inside(loop_[next_[other]]);
}

bool EarClipper::is_deep(const Point2& p, const std::array<Index, 3>& ear) const {
  for (std::size_t i = 0; i < 3; ++i) {
    const Point2 &a = loop_[ear[i]], &b = loop_[ear[(i + 1) % 3]];
    const double x = b.x - a.x, y = b.y - a.y;
    if (x * (p.y - a.y) - y * (p.x - a.x) <= depth_ * std::hypot(x, y)) return false;
  }
  return true;
}

}  // namespace

std::vector<std::array<Index, 3>> clip_ears(std::span<const Point2> loop) {
  return EarClipper(loop).clip();
}

}  // namespace pstrips::inline codecs
