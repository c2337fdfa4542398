#include "codecs/stripify/face_strips.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "codecs/stripify/emit.h"
#include "codecs/triangulate/triangulate.h"
#include "core/point.h"

namespace pstrips::inline codecs {
namespace {

// ---- Which diagonals are open

constexpr std::uint8_t kBothDiagonals = 3;

// The outline of a face as seen along its Newell normal.
class Outline {
 public:
  Outline(std::span<const double> positions, std::span<const Index> loop) {
    for (const Index w : loop) {
      const double* p = positions.data() + std::size_t{3} * w;
      points_.push_back({p[0], p[1], p[2]});
    }
    for (std::size_t i = 1; i + 1 < points_.size(); ++i) {
      const Point c = cross(points_[i] - points_[0], points_[i + 1] - points_[0]);
      for (std::size_t k = 0; k < 3; ++k) normal_[k] += c[k];
    }
  }

  double area(std::size_t i, std::size_t j, std::size_t k) const {
    return dot(normal_, cross(points_[j] - points_[i], points_[k] - points_[i]));
  }

  std::uint8_t open_diagonals() const {
    const double from_0 = std::min(area(0, 1, 2), area(0, 2, 3));
    const double from_1 = std::min(area(1, 2, 3), area(1, 3, 0));
    if (from_0 > 0 && from_1 > 0) return kBothDiagonals;
    return from_1 > from_0 ? 2 : 1;  // as triangulate()
  }

  // Left turns only, once around: every fan from a corner winds one chosen.
  bool is_strictly_convex() const {
    const std::size_t n = points_.size();
    for (std::size_t i = 0; i < n; ++i)
      if (!(area(i, (i + 1) % n, (i + 2) % n) > 0)) return false;
    for (std::size_t i = 1; i + 1 < n; ++i)
      if (!(area(0, i, i + 1) > 0)) return false;
    return true;
  }

 private:
  std::vector<Point> points_;
  Point normal_{};
};

std::span<const Index> loop_of(const PolygonInput& input, Index f) {
  return input.corners.subspan(input.face_first[f], input.face_first[f + 1] - input.face_first[f]);
}

Index face_count(const PolygonInput& input) {
  return input.face_first.empty() ? 0 : static_cast<Index>(input.face_first.size() - 1);
}

std::vector<Index> face_of_half_edges(std::span<const Index> first) {
  std::vector<Index> face(first.empty() ? 0 : first.back());
  for (Index f = 0; f + 1 < first.size(); ++f)
    std::fill(face.begin() + first[f], face.begin() + first[f + 1], f);
  return face;
}

// Calls visit(f, corner, other face) for every corner of a face of four and more that lies between
// two edges to the same face.
template <class Visit>
void for_each_double_corner(std::span<const Index> first, std::span<const Index> opposite,
                            std::span<const Index> face, Visit&& visit) {
  const auto over = [&](Index h) { return opposite[h] == kNone ? kNone : face[opposite[h]]; };
  for (Index f = 0; f + 1 < first.size(); ++f) {
    if (first[f + 1] - first[f] < 4) continue;
    Index before = over(first[f + 1] - 1);
    for (Index h = first[f]; h < first[f + 1]; ++h) {
      const Index after = over(h);
      if (after != kNone && after == before) visit(f, h, after);
      before = after;
    }
  }
}

// Faces of five and more corners that cannot be cut along any diagonal.
std::vector<std::uint8_t> faces_to_triangulate(const PolygonInput& input) {
  const Index n = face_count(input);
  std::vector<std::uint8_t> cut(n);
  bool any_large = false;
  for (Index f = 0; f < n; ++f) {
    if (loop_of(input, f).size() <= 4) continue;
    any_large = true;
    cut[f] = !input.positions.empty() &&
             !Outline(input.positions, loop_of(input, f)).is_strictly_convex();
  }
  if (any_large) {
    const std::vector<Index> opposite = opposite_half_edges(input);
    for_each_double_corner(input.face_first, opposite, face_of_half_edges(input.face_first),
                           [&](Index f, Index, Index) { cut[f] |= loop_of(input, f).size() > 4; });
  }
  return cut;
}

// The triangles of the marked faces; `face` counts the marked ones.
Triangulation triangulate_marked(const PolygonInput& input, std::span<const std::uint8_t> marked) {
  Mesh mesh;
  mesh.groups.resize(1);
  mesh.position.type = ComponentType::f64;
  const auto bytes = std::as_bytes(input.positions);
  mesh.position.data.assign(bytes.begin(), bytes.end());
  mesh.position.data.resize(std::size_t{input.wedge_count} * mesh.position.element_bytes());
  mesh.face_first.push_back(0);
  for (Index f = 0; f < marked.size(); ++f) {
    if (!marked[f]) continue;
    const auto loop = loop_of(input, f);
    mesh.corners.insert(mesh.corners.end(), loop.begin(), loop.end());
    mesh.face_first.push_back(static_cast<Index>(mesh.corners.size()));
  }
  return triangulate(mesh);
}

void add_face(StripFaces& faces, std::span<const Index> loop, const PolygonInput& input, Index f) {
  faces.corners.insert(faces.corners.end(), loop.begin(), loop.end());
  faces.first.push_back(static_cast<Index>(faces.corners.size()));
  if (!input.group.empty()) faces.group.push_back(input.group[f]);
  const bool is_shaped_quad = loop.size() == 4 && !input.positions.empty();
  faces.may_cut.push_back(is_shaped_quad ? Outline(input.positions, loop).open_diagonals()
                                         : kBothDiagonals);
}

void part_double_corners(StripFaces& faces) {
  for_each_double_corner(
      faces.first, faces.opposite, faces.face, [&](Index f, Index corner, Index other) {
        if (faces.size(f) != 4 || (faces.size(other) == 4 && other < f)) return;
        const auto through = static_cast<std::uint8_t>(1u << ((corner - faces.first[f]) % 2));
        if (faces.may_cut[f] & through) {
          faces.may_cut[f] = through;
        } else if (faces.size(other) == 4) {
          const Index there = faces.opposite[corner] - faces.first[other] + 1;
          const auto other_through = static_cast<std::uint8_t>(1u << (there % 2));
          if (faces.may_cut[other] & other_through) faces.may_cut[other] = other_through;
        }
      });
}

void join_faces(StripFaces& faces) {
  faces.opposite = opposite_half_edges(
      {faces.corners, faces.first, faces.group, faces.wedge_count, /*positions=*/{}});
  faces.face = face_of_half_edges(faces.first);
  part_double_corners(faces);
}

// ---- How a strip crosses a face
//
// A strip stands on an edge, which it has entered a face over. It goes on by triangles between the
// edge and a neighbouring corner of the face: either the edge's target moves on to the next corner
// or its origin moves back. Two equal steps in a row are a swap.

enum Step : std::uint8_t { kOrigin, kTarget };
constexpr Step other(Step s) { return s == kOrigin ? kTarget : kOrigin; }

// The steps that lead from one edge of a face to another.
struct Crossing {
  std::array<Index, 2> steps;  // of the origin, of the target
  std::array<bool, 2> may_start;

  struct Runs {
    Index first_kind = 0, other_kind = 0;  // runs of equal steps
  };
  // As many as can be, with these steps at either end; none when there is no such order.
  Runs runs(Step first, Step last) const {
    const Index own = steps[first], others = steps[other(first)];
    if (!may_start[first]) return {};
    if (first != last) {
      const Index n = std::min(own, others);
      return {n, n};
    }
    const Index n = own == 0 ? 0 : std::min(others, own - 1);
    if (own == 0 || (others > 0 && n == 0)) return {};
    return {n + 1, n};
  }
  std::uint32_t swaps(Step first, Step last) const {
    const Runs r = runs(first, last);
    if (r.first_kind == 0) return SwapCounts::kImpossible;
    return steps[0] + steps[1] - r.first_kind - r.other_kind;
  }
};

Crossing crossing_of(const StripFaces& faces, Index entry, Index exit) {
  const Index f = faces.face[entry], n = faces.size(f);
  const Index ahead = (exit + n - entry) % n;  // both in the same face
  Crossing p{{n - ahead - 1, ahead - 1}, {true, true}};
  if (n == 4) {
    const Index corner = entry - faces.first[f];
    p.may_start[kTarget] = (faces.may_cut[f] >> (corner % 2) & 1) != 0;
    p.may_start[kOrigin] = (faces.may_cut[f] >> ((corner + 1) % 2) & 1) != 0;
  }
  return p;
}

// Calls visit(entry, exit) with the half-edges of a face visit. Where there is none, the face's
// corners are shared out evenly between the two sides, which takes no swap.
template <class Visit>
void for_each_crossing(const StripFaces& faces, const FaceVisit& v, Visit&& visit) {
  const Index n = faces.size(v.face);
  for (const Index half : {n / 2, n - n / 2}) {
    const Index entry = v.entry != kNone  ? v.entry
                        : v.exit != kNone ? faces.turned(v.exit, half)
                                          : faces.first[v.face];
    const Index exit = v.exit != kNone ? v.exit : faces.turned(entry, half);
    visit(entry, exit);
    if (2 * half == n || (v.entry != kNone && v.exit != kNone)) return;
  }
}

// How the cheapest crossing of a face begins, given the step that it ends with.
struct CheapestCrossing {
  std::uint32_t swaps = SwapCounts::kImpossible;  // of the strip so far
  Index entry = kNone, exit = kNone;
  Step first = kOrigin, last_before = kOrigin;
};

// A strip that leaves its second triangle over the wrong side repeats an entry there, unless it is
// written from the other end; see emit_strips().
bool starts_badly(const StripFaces& faces, const FaceVisit& visit, Step first) {
  return visit.entry == kNone && faces.size(visit.face) == 4 && first == kTarget;
}

std::array<CheapestCrossing, 2> cheapest_crossings(const StripFaces& faces, const FaceVisit& visit,
                                                   const SwapCounts& before) {
  std::array<CheapestCrossing, 2> out;
  for_each_crossing(faces, visit, [&](Index entry, Index exit) {
    const Crossing p = crossing_of(faces, entry, exit);
    for (const Step last : {kOrigin, kTarget})
      for (const Step first : {kOrigin, kTarget}) {
        const std::uint32_t inside = p.swaps(first, last) + starts_badly(faces, visit, first);
        for (const Step last_before : {other(first), first}) {
          const std::uint32_t swaps = before.by_last_step[last_before] + inside +
                                      (visit.entry != kNone && first == last_before);
          if (swaps < out[last].swaps) out[last] = {swaps, entry, exit, first, last_before};
        }
      }
  });
  return out;
}

SwapCounts counts_of(const std::array<CheapestCrossing, 2>& w) {
  return {{std::min(w[0].swaps, SwapCounts::kImpossible),
           std::min(w[1].swaps, SwapCounts::kImpossible)}};
}

// ---- Triangles

class Cutter {
 public:
  explicit Cutter(const StripFaces& faces) : faces_(faces) {
    const std::size_t most = 3 * faces.corners.size();  // 3 (size - 2) a face
    triangles_.reserve(most);
    graph_.opposite.reserve(most);
    links_.reserve(most);
  }

  Strips run(std::span<const FaceVisit> visits) {
    while (!visits.empty()) {
      std::size_t size = 1;
      while (size < visits.size() && visits[size].entry != kNone) ++size;
      cut(visits.first(size));
      visits = visits.subspan(size);
    }
    return emit_strips({triangles_, group_, faces_.wedge_count, {}}, graph_, links_);
  }

 private:
  void cut(std::span<const FaceVisit> strip) {
    choose(strip);
    last_exit_ = kNone;
    for (std::size_t i = 0; i < strip.size(); ++i)
      write(strip[i].face, crossings_[i][last_[i]], last_[i]);
  }

  void choose(std::span<const FaceVisit> strip) {
    crossings_.clear();
    SwapCounts counts;
    for (const FaceVisit& visit : strip) {
      crossings_.push_back(cheapest_crossings(faces_, visit, counts));
      counts = counts_of(crossings_.back());
    }
    assert(counts.fewest() < SwapCounts::kImpossible);
    last_.resize(strip.size());
    Step last = counts.by_last_step[kOrigin] <= counts.by_last_step[kTarget] ? kOrigin : kTarget;
    for (std::size_t i = strip.size(); i-- > 0;) {
      last_[i] = last;
      last = crossings_[i][last].last_before;
    }
  }

  void write(Index face, const CheapestCrossing& chosen, Step last) {
    const Crossing p = crossing_of(faces_, chosen.entry, chosen.exit);
    Crossing::Runs runs = p.runs(chosen.first, last);
    const Index count = runs.first_kind + runs.other_kind;
    // What is left over goes into the first run of its kind.
    std::array<Index, 2> spare{};
    spare[chosen.first] = p.steps[chosen.first] - runs.first_kind;
    spare[other(chosen.first)] = p.steps[other(chosen.first)] - runs.other_kind;
    origin_ = chosen.entry;
    target_ = faces_.turned(chosen.entry, 1);
    Step step = chosen.first;
    for (Index i = 0; i < count; ++i, step = other(step))
      for (Index k = 1 + std::exchange(spare[step], 0); k > 0; --k) add_triangle(face, step);
  }

  // Over its first half-edge a triangle is entered; over the second one the strip leaves it when
  // the origin moves, over the third when the target does.
  void add_triangle(Index face, Step step) {
    const Index apex =
        step == kTarget ? faces_.turned(target_, 1) : faces_.turned(origin_, faces_.size(face) - 1);
    const auto entry = static_cast<Index>(triangles_.size());
    triangles_.insert(triangles_.end(),
                      {faces_.corners[origin_], faces_.corners[target_], faces_.corners[apex]});
    group_.push_back(faces_.group.empty() ? 0 : faces_.group[face]);
    graph_.opposite.insert(graph_.opposite.end(), {last_exit_, kNone, kNone});
    links_.insert(links_.end(), {last_exit_ != kNone, 0, 0});
    if (last_exit_ != kNone) {
      graph_.opposite[last_exit_] = entry;
      links_[last_exit_] = 1;
    }
    last_exit_ = entry + (step == kTarget ? 2 : 1);
    (step == kTarget ? target_ : origin_) = apex;
  }

  const StripFaces& faces_;
  std::vector<Index> triangles_, group_;
  DualGraph graph_;  // of the triangles that follow each other only
  Links links_;
  // Of the strip at hand.
  std::vector<std::array<CheapestCrossing, 2>> crossings_;
  std::vector<Step> last_;
  Index origin_ = kNone, target_ = kNone, last_exit_ = kNone;
};

}  // namespace

StripFaces make_strip_faces(const PolygonInput& input) {
  const std::vector<std::uint8_t> cut = faces_to_triangulate(input);
  const bool any = std::ranges::find(cut, 1) != cut.end();
  const Triangulation triangles = any ? triangulate_marked(input, cut) : Triangulation{};
  StripFaces faces;
  faces.wedge_count = input.wedge_count;
  faces.first.push_back(0);
  Index marked = 0;
  std::size_t t = 0;
  for (Index f = 0; f < face_count(input); ++f) {
    if (!cut[f]) {
      add_face(faces, loop_of(input, f), input, f);
      continue;
    }
    for (; t < triangles.face.size() && triangles.face[t] == marked; ++t)
      add_face(faces, std::span(triangles.corners).subspan(3 * t, 3), input, f);
    ++marked;
  }
  join_faces(faces);
  return faces;
}

StripFaces make_strip_faces(const StripInput& input) {
  StripFaces faces;
  faces.wedge_count = input.wedge_count;
  faces.corners.assign(input.triangles.begin(), input.triangles.end());
  faces.group.assign(input.group.begin(), input.group.end());
  for (Index h = 0; h <= faces.corners.size(); h += 3) faces.first.push_back(h);
  faces.may_cut.assign(faces.count(), kBothDiagonals);
  join_faces(faces);
  return faces;
}

std::uint32_t SwapCounts::fewest() const { return std::min(by_last_step[0], by_last_step[1]); }

SwapCounts pass(const StripFaces& faces, const FaceVisit& visit, const SwapCounts& before) {
  return counts_of(cheapest_crossings(faces, visit, before));
}

Strips emit_face_strips(const StripFaces& faces, std::span<const FaceVisit> visits) {
  return Cutter(faces).run(visits);
}

}  // namespace pstrips::inline codecs
