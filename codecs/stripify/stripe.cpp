#include "codecs/stripify/stripe.h"

#include <utility>

#include "codecs/stripify/face_walk.h"
#include "codecs/stripify/straight_runs.h"

namespace pstrips::inline codecs {
namespace {

enum class Tie { lookahead, no_swap };

// Shorter rows are left to the local rule. Ours: from 3 to 10, strips and swaps hardly change.
constexpr Index kLeastRow = 5;

class Stripe {
 public:
  Stripe(const StripFaces& faces, Tie tie) : faces_(faces), tie_(tie), walk_(faces), runs_(faces) {}

  Strips run() {
    for (std::span<const Index> row; !(row = runs_.longest(kLeastRow)).empty();) take_patch(row);
    for (Index seed; (seed = walk_.free().lowest()) != kNone;) {
      walk_.start(seed);
      grow_both_ways();
    }
    return emit_face_strips(faces_, walk_.visits());
  }

 private:
  using Row = std::vector<FaceVisit>;
  enum Side : Index { kRight = 1, kLeft = 3 };  // edges from a quad's entry to that side

  void take_patch(std::span<const Index> exits) {
    std::vector<Row> patch(1);
    for (const Index exit : exits) {
      const Index f = faces_.face[exit];
      if (!walk_.free().contains(f)) break;  // the row crosses itself
      walk_.free().take(f);
      patch[0].push_back({f, faces_.turned(exit, 2), exit});
    }
    add_rows_beside(patch, kLeft);
    std::reverse(patch.begin(), patch.end());
    add_rows_beside(patch, kRight);
    for (Row& row : patch) {
      row.front().entry = row.back().exit = kNone;
      walk_.start(std::move(row));
      grow_both_ways();
    }
  }

  void add_rows_beside(std::vector<Row>& patch, Side side) {
    for (Row row; !(row = row_beside(patch.back(), side)).empty();) {
      for (const FaceVisit& visit : row) walk_.free().take(visit.face);
      patch.push_back(std::move(row));
    }
  }

  // The quads beside a row when all of them are free and make a row themselves; else none.
  Row row_beside(const Row& row, Side side) const {
    Row out;
    for (const FaceVisit& visit : row) {
      const Index door = faces_.opposite[faces_.turned(visit.entry, side)];
      if (door == kNone) return {};
      const Index f = faces_.face[door];
      if (faces_.size(f) != 4 || !walk_.free().contains(f)) return {};
      const FaceVisit beside{f, faces_.turned(door, side), faces_.turned(door, 4 - side)};
      if (!out.empty() && faces_.opposite[out.back().exit] != beside.entry) return {};
      out.push_back(beside);
    }
    return out;
  }

  void grow_both_ways() {
    const auto rank = [&](Index exit, std::uint32_t swaps) {
      return std::pair(walk_.free().degree(faces_.neighbor(exit)),
                       tie_ == Tie::lookahead ? walk_.lowest_degree_beyond(exit) : Index{swaps});
    };
    walk_.grow(rank);
    walk_.reverse();
    walk_.grow(rank);
    for (const FaceVisit& visit : walk_.strip()) runs_.take(visit.face);
    walk_.finish();
  }

  const StripFaces& faces_;
  Tie tie_;
  FaceWalk walk_;
  StraightRuns runs_;
};

Strips strips_of(const StripFaces& faces, Tie tie) { return Stripe(faces, tie).run(); }

}  // namespace

Strips stripe_lookahead(const StripInput& input, const StripOptions&) {
  return strips_of(make_strip_faces(input), Tie::lookahead);
}
Strips stripe_lookahead_polygons(const PolygonInput& input, const StripOptions&) {
  return strips_of(make_strip_faces(input), Tie::lookahead);
}

Strips stripe_noswap(const StripInput& input, const StripOptions&) {
  return strips_of(make_strip_faces(input), Tie::no_swap);
}
Strips stripe_noswap_polygons(const PolygonInput& input, const StripOptions&) {
  return strips_of(make_strip_faces(input), Tie::no_swap);
}

}  // namespace pstrips::inline codecs
