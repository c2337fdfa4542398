#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>
#include <span>
#include <vector>

#include "formats/pstrip/payload/compact/attribute_models.h"
#include "formats/pstrip/payload/compact/wedge_surroundings.h"

// For formats/pstrip/payload/compact: the attributes of a wedge, once for writing and for reading:
// as another wedge nearby has them, or what differs from the plane through its neighbours; of
// directions also from the normal of the faces. [spec/compact.md §7.3]

namespace pstrips::inline formats {

template <class Coder>
class AttributeCode {
 public:
  /// cells  a row a wedge, of columns_of(how); those of neighbours and siblings are there
  AttributeCode(Coder& coder, const MeshCells& how, AttributeModels& models,
                std::vector<std::int32_t>& cells)
      : coder_(coder), how_(how), models_(models), cells_(cells), columns_(columns_of(how)) {}

  /// arms      of the neighbours, see PlaneFit
  /// siblings  other wedges of the vertex, the likeliest first
  /// wanted    the row to write; a reader's null
  void code(Index wedge, const WedgeSurroundings& around, std::span<const GridPoint> arms,
            std::span<const Index> siblings, const std::int32_t* wanted) {
    const Octahedron::Vector normal = around.normal();
    unsigned up = 0;
    for (unsigned k = 1; k < 3; ++k)
      if (std::abs(normal[k]) > std::abs(normal[up])) up = k;
    const PlaneFit fit(arms, up);
    unsigned column = 0;
    for (std::size_t i = 0; i < how_.attributes.size(); ++i) {
      const Run run{i, column, how_.attributes[i].columns()};
      column += run.count;
      if (code_same(wedge, run, around.neighbours(), siblings, wanted)) continue;
      unsigned first = 0;
      if (how_.attributes[i].octahedron()) {
        code_direction(wedge, run, around.neighbours(), fit, normal, wanted);
        first = 2;
      }
      for (unsigned k = first; k < run.count; ++k)
        code_number(wedge, run.first + k, around.neighbours(), fit, wanted);
    }
  }

 private:
  /// The columns of an attribute.
  struct Run {
    std::size_t attribute;
    unsigned first, count;
  };

  std::int32_t* row(Index wedge) { return cells_.data() + std::size_t{wedge} * columns_; }

  /// Whether a sibling or a neighbour has the same, which the wedge then gets, too.
  bool code_same(Index wedge, const Run& run, std::span<const Index> neighbours,
                 std::span<const Index> siblings, const std::int32_t* wanted) {
    likely_.clear();
    for (const Index other : siblings) add_likely(other, run);
    const std::size_t of_siblings = likely_.size();
    for (const Index other : neighbours) add_likely(other, run);
    if (likely_.empty()) return false;
    auto& models = models_.attributes[run.attribute];
    const unsigned alike = how_alike(likely_.size() - of_siblings, neighbours.size());
    SymbolModel& model =
        models.same[std::min<std::size_t>(of_siblings, models.kSiblings - 1)][alike][models.before];
    unsigned symbol = kNone;
    if constexpr (!Coder::kReads)
      for (unsigned i = 0; i < likely_.size() && symbol == kNone; ++i)
        if (are_equal(row(likely_[i]), wanted, run)) symbol = i;
    symbol = coder_.symbol(model, symbol);
    models.before = symbol == kNone ? 0 : symbol < of_siblings ? 1 : 2;
    if (symbol >= likely_.size()) return false;
    std::copy_n(row(likely_[symbol]) + run.first, run.count, row(wedge) + run.first);
    return true;
  }

  /// different  values that siblings do not have among so many neighbours
  static unsigned how_alike(std::size_t different, std::size_t neighbours) {
    if (different == 0) return 0;
    if (different == neighbours) return 1;
    return 2 * different > neighbours ? 2 : different > 1 ? 3 : 4;
  }

  static bool are_equal(const std::int32_t* a, const std::int32_t* b, const Run& run) {
    return std::equal(a + run.first, a + run.first + run.count, b + run.first);
  }
  void add_likely(Index wedge, const Run& run) {
    const auto is_same = [&](Index other) { return are_equal(row(other), row(wedge), run); };
    if (likely_.size() < kNone && std::ranges::none_of(likely_, is_same)) likely_.push_back(wedge);
  }

  void code_number(Index wedge, unsigned column, std::span<const Index> neighbours,
                   const PlaneFit& fit, const std::int32_t* wanted) {
    const auto [value, missed] =
        fit.of([&](unsigned i) { return std::int64_t{row(neighbours[i])[column]}; });
    const auto guess =
        static_cast<std::int32_t>(std::clamp<std::int64_t>(value, -kMaxCell, kMaxCell));
    const std::int32_t off = models_.columns[column].code(
        coder_, Coder::kReads ? 0 : wanted[column] - guess, half_octaves(4 * missed));
    row(wedge)[column] = std::clamp(guess + off, -kMaxCell, kMaxCell);
  }

  /// Guesses of a direction: by the faces, by the neighbours, by both.
  static std::array<Octahedron::Point, 3> guesses_of(const Octahedron& octahedron,
                                                     const Octahedron::Vector& normal,
                                                     const Octahedron::Vector& by_neighbours) {
    constexpr Octahedron::Vector kNothing{};
    const Octahedron::Vector none_of_faces = normal == kNothing ? by_neighbours : normal;
    const Octahedron::Point by_faces = octahedron.near(none_of_faces);
    const Octahedron::Point by_near =
        by_neighbours == kNothing ? by_faces : octahedron.near(by_neighbours);
    Octahedron::Vector both = shortened(octahedron.unit(by_faces));
    for (unsigned k = 0; k < 3; ++k) both[k] += by_neighbours[k];
    return {by_faces, by_near, octahedron.near(both)};
  }

  /// From units of 2^-24 to 2^-15.
  static Octahedron::Vector shortened(Octahedron::Vector unit) {
    for (std::int64_t& c : unit) c >>= 9;
    return unit;
  }

  Octahedron::Vector by_neighbours(const Octahedron& octahedron, unsigned column,
                                   std::span<const Index> neighbours, const PlaneFit& fit) {
    std::array<Octahedron::Vector, PlaneFit::kMost> of;
    for (std::size_t i = 0; i < neighbours.size(); ++i) {
      const std::int32_t* const at = row(neighbours[i]) + column;
      of[i] = shortened(octahedron.unit(octahedron.placed(at[0], at[1])));
    }
    Octahedron::Vector out;
    for (unsigned k = 0; k < 3; ++k) out[k] = fit.of([&](unsigned i) { return of[i][k]; }).value;
    return out;
  }

  static unsigned distance(Octahedron::Point a, Octahedron::Point b) {
    const std::int64_t u = std::int64_t{a.u} - b.u, v = std::int64_t{a.v} - b.v;
    return half_octaves(static_cast<std::uint64_t>(4 * (u * u + v * v)));
  }

  void code_direction(Index wedge, const Run& run, std::span<const Index> neighbours,
                      const PlaneFit& fit, const Octahedron::Vector& normal,
                      const std::int32_t* wanted) {
    const Octahedron& octahedron = *how_.attributes[run.attribute].octahedron();
    auto& distances = models_.attributes[run.attribute].distance;
    auto guesses =
        guesses_of(octahedron, normal, by_neighbours(octahedron, run.first, neighbours, fit));
    const auto best =
        static_cast<std::size_t>(std::ranges::min_element(distances) - distances.begin());
    // In the square that has the guess in its middle half, nearly all that is near it is near.
    const bool turns = octahedron.is_below(guesses[best]);
    const auto turned = [&](Octahedron::Point p) { return turns ? octahedron.turned(p) : p; };
    for (Octahedron::Point& guess : guesses) guess = turned(guess);
    const unsigned size = distance(guesses[0], guesses[1]);
    Octahedron::Point off;
    if constexpr (!Coder::kReads) {
      const Octahedron::Point at =
          turned(octahedron.placed(wanted[run.first], wanted[run.first + 1]));
      off = {at.u - guesses[best].u, at.v - guesses[best].v};
    }
    off.u = models_.columns[run.first].code(coder_, off.u, size);
    off.v = models_.columns[run.first + 1].code(coder_, off.v, size);
    const Octahedron::Point at = octahedron.placed(std::int64_t{guesses[best].u} + off.u,
                                                   std::int64_t{guesses[best].v} + off.v);
    for (std::size_t k = 0; k < guesses.size(); ++k)
      distances[k] += (static_cast<int>(distance(at, guesses[k]) << 8) - distances[k]) >> 5;
    const Octahedron::Point placed = turned(at);
    row(wedge)[run.first] = placed.u;
    row(wedge)[run.first + 1] = placed.v;
  }

  static constexpr unsigned kNone = SymbolModel::kSymbols - 1;  // has the same

  Coder& coder_;
  const MeshCells& how_;
  AttributeModels& models_;
  std::vector<std::int32_t>& cells_;
  const unsigned columns_;
  std::vector<Index> likely_;  // scratch: wedges that differ from each other
};

}  // namespace pstrips::inline formats
