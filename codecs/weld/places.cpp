#include "codecs/weld/places.h"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "core/equal_elements.h"
#include "core/point.h"

namespace pstrips::inline codecs {
namespace {

template <class T>
void clear_sign_of_zero(Bytes& data) {
  for (std::size_t at = 0; at + sizeof(T) <= data.size(); at += sizeof(T)) {
    T x;
    std::memcpy(&x, data.data() + at, sizeof x);
    if (x != 0) continue;
    x = 0;
    std::memcpy(data.data() + at, &x, sizeof x);
  }
}

std::vector<Index> same_places(const Attribute& position) {
  if (position.type != ComponentType::f32 && position.type != ComponentType::f64)
    return first_equals(position.data, position.element_bytes(), 1);
  Bytes values = position.data;
  if (position.type == ComponentType::f32)
    clear_sign_of_zero<float>(values);
  else
    clear_sign_of_zero<double>(values);
  return first_equals(values, position.element_bytes(), 1);
}

using Cell = std::array<double, 3>;
struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    std::size_t out = 0;
    for (const double x : cell) out = out * 0x9e37'79b9'7f4a'7c15u + std::hash<double>()(x);
    return out;
  }
};

// Centres of balls in cells of the balls' radius: those near a point are in 27 cells, and in each
// there are only a few, since no ball has another's centre.
class Balls {
 public:
  explicit Balls(double radius) : radius_(radius) {}

  // The first ball that holds the point, or one around it with this number.
  Index find_or_add(Index number, const Point& p) {
    const Cell middle = {std::floor(p[0] / radius_), std::floor(p[1] / radius_),
                         std::floor(p[2] / radius_)};
    Index best = kNone;
    for (int i = 0; i < 27; ++i) {
      const auto cell =
          cells_.find({middle[0] + i % 3 - 1, middle[1] + i / 3 % 3 - 1, middle[2] + i / 9 - 1});
      if (cell == cells_.end()) continue;
      for (Index b = cell->second; b != kNone; b = balls_[b].next)
        if (balls_[b].number < best && is_near(balls_[b].centre, p)) best = balls_[b].number;
    }
    if (best != kNone) return best;
    const auto [cell, is_new] = cells_.try_emplace(middle, kNone);
    balls_.push_back({p, number, cell->second});
    cell->second = static_cast<Index>(balls_.size() - 1);
    return number;
  }

 private:
  struct Ball {
    Point centre;
    Index number, next;
  };
  bool is_near(const Point& a, const Point& b) const {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) <= radius_;
  }

  double radius_;
  std::vector<Ball> balls_;
  std::unordered_map<Cell, Index, CellHash> cells_;  // the last ball in each
};

}  // namespace

std::vector<Index> places(const Attribute& position, double distance) {
  if (distance == 0) return same_places(position);
  std::vector<Index> out(position.elements());
  std::iota(out.begin(), out.end(), Index{0});
  Balls balls(distance);
  for (Index v = 0; v < out.size(); ++v) {
    Point p{0, 0, 0};
    for (std::size_t c = 0; c < std::min<std::size_t>(3, position.count); ++c)
      p[c] = component(position, v, c);
    // Where a step of the numbers is a cell or more, cells have no neighbours.
    constexpr double kMostCells = 9e15;
    const auto is_counted = [&](double x) { return std::abs(x) / distance < kMostCells; };
    if (is_counted(p[0]) && is_counted(p[1]) && is_counted(p[2])) out[v] = balls.find_or_add(v, p);
  }
  return out;
}

}  // namespace pstrips::inline codecs
