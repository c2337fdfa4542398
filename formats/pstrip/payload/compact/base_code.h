#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "core/fault_list.h"
#include "core/star_mesh.h"
#include "formats/pstrip/payload/compact/attribute_code.h"
#include "formats/pstrip/payload/compact/base_gates.h"
#include "formats/pstrip/payload/compact/split_models.h"

// For formats/pstrip/payload/compact: the base of a mesh, once for writing and for reading. Its
// triangles come in the order of their map. One that continues a triangle across an edge (a gate)
// costs its third vertex; any other is named corner by corner, so that no order and no complex is
// excluded. [spec/compact.md §5]

namespace pstrips::inline formats {

/// A mesh of wedges with its numbers as cells.
struct BaseMesh {
  std::vector<GridPoint> positions;       ///< a vertex each
  std::vector<Index> wedge_vertex;        ///< a wedge each
  std::vector<std::int32_t> wedge_cells;  ///< all attributes, `columns` a wedge
  unsigned columns = 0;
  std::vector<Index> corners;  ///< wedges, three a triangle
  std::vector<Index> group;    ///< a triangle each
  friend bool operator==(const BaseMesh&, const BaseMesh&) = default;
};

/// What a reader knows beforehand.
struct BaseCounts {
  Index vertices = 0, wedges = 0, triangles = 0, groups = 1;
  unsigned columns = 0;
  bool single_wedges = true;  ///< wedge i is vertex i
};

struct BaseModels {
  SymbolModel place;  ///< where the next triangle is
  /// Of a triangle at a gate: by whether either end of the gate has many triangles.
  std::array<std::array<SymbolModel, 2>, 2> third;
  BitModel next_vertex;   ///< of a triangle at no gate: the first that has not come yet
  BitModel usual_wedge;   ///< the one across the gate, or the last one at the vertex
  BitModel next_wedge;    ///< the first that has not come yet
  BitModel same_group;    ///< as the triangle before
  NumberModel near, far;  ///< positions, at a gate and at none
};

/// One base. A triangle at a gate begins with the gate's edge, turned round.
template <class Coder>
class BaseCode {
 public:
  /// cells, attributes  of a mesh with counts.columns
  /// mesh               to write; a reader fills it
  BaseCode(Coder& coder, const BaseCounts& counts, const MeshCells& cells,
           AttributeModels& attributes, BaseMesh& mesh)
      : coder_(coder),
        counts_(counts),
        mesh_(mesh),
        attributes_(coder, cells, attributes, mesh.wedge_cells) {
    is_known_.resize(counts.vertices);
    is_known_wedge_.resize(counts.wedges);
    last_wedge_of_.resize(counts.vertices, kNone);
    triangles_at_.resize(counts.vertices);
    newest_wedge_of_.resize(counts.vertices, kNone);
    older_wedge_.resize(counts.wedges, kNone);
    if constexpr (Coder::kReads) {
      mesh.columns = counts.columns;
      mesh.positions.resize(counts.vertices);
      mesh.wedge_vertex.resize(counts.wedges);
      mesh.wedge_cells.resize(std::size_t{counts.wedges} * counts.columns);
      mesh.corners.resize(std::size_t{3} * counts.triangles);
      mesh.group.resize(counts.triangles);
    }
  }

  /// cost    O(vertices + wedges + triangles)
  /// errors  corrupt: an index past the end, a vertex twice in a triangle, a wedge of two vertices.
  ///         Bytes that end early are the caller's to see
  Result<void> run() {
    for (Index t = 0; t < counts_.triangles; ++t) {
      if (auto ok = code_triangle(t); !ok) return ok;
      // What is read past the end would go on for as long as the counts say.
      if constexpr (Coder::kReads)
        if (coder_.overrun()) return broken(Fault::compact_run);
    }
    for (Index v = 0; v < counts_.vertices; ++v)
      if (!is_known_[v]) code_position(v, models_.far, last_position_);
    for (Index w = 0; w < counts_.wedges; ++w) {
      if (is_known_wedge_[w]) continue;
      const Index v =
          counts_.single_wedges ? w : coder_.raw(mesh_.wedge_vertex[w], bits_for(counts_.vertices));
      if (v >= counts_.vertices) return broken(Fault::compact_base);
      WedgeSurroundings around;
      if (last_wedge_ != kNone) around.add_neighbour(last_wedge_);
      code_new_wedge(w, v, around);
    }
    return {};
  }

 private:
  enum Place : unsigned { kAtGate, kGateIsOpen, kAtNone };
  static constexpr unsigned kNext = 0, kNamed = SymbolModel::kSymbols - 1;

  static unsigned bits_for(Index count) { return static_cast<unsigned>(std::bit_width(count)); }
  Index vertex(Index t, unsigned k) const { return mesh_.wedge_vertex[mesh_.corners[3 * t + k]]; }

  Result<void> code_triangle(Index t) {
    coder_.part(Part::base_map);
    const BaseGate* const gate = code_place(t);
    if (gate == nullptr && !at_none_) return broken(Fault::compact_base);
    std::array<Index, 3> v{};
    BaseGate at{};
    if (gate != nullptr) at = *gate;
    for (unsigned k = 0; k < 3; ++k) {
      const Index wanted = Coder::kReads ? 0 : vertex(t, k);
      if (gate == nullptr)
        v[k] = code_vertex(wanted);
      else
        v[k] = k == 0 ? at.to : k == 1 ? at.from : code_third(at, wanted);
      if (v[k] >= counts_.vertices) return broken(Fault::compact_base);
      for (unsigned i = 0; i < k; ++i)
        if (v[i] == v[k]) return broken(Fault::compact_base);
      if (auto ok = code_corner(t, k, v[k], gate != nullptr ? &at : nullptr); !ok) return ok;
    }
    code_group(t);
    if (gate != nullptr) gates_.pop();
    for (const unsigned k : {1u, 2u}) gates_.add({v[k], v[(k + 1) % 3], t, k});
    if (gate == nullptr) gates_.add({v[0], v[1], t, 0});
    for (const Index corner : v) ++triangles_at_[corner];
    return {};
  }

  /// The gate of the next triangle, or null: `at_none_` says whether that is right.
  const BaseGate* code_place(Index t) {
    while (true) {
      const unsigned place = coder_.symbol(models_.place, Coder::kReads ? 0 : place_of(t));
      at_none_ = place == kAtNone;
      if (gates_.empty() || place > kGateIsOpen) return nullptr;
      if (place == kAtGate) return &gates_.front();
      gates_.pop();
    }
  }

  unsigned place_of(Index t) const {
    // As far as this a writer looks for the gate of its next triangle.
    constexpr Index kReach = 256;
    const Index behind = gates_.places_behind(vertex(t, 1), vertex(t, 0));
    return behind == 0 ? kAtGate : behind < kReach ? kGateIsOpen : kAtNone;
  }

  static std::int64_t distance(GridPoint a, GridPoint b) {
    const GridPoint off = a - b;
    return std::int64_t{std::abs(off.x)} + std::abs(off.y) + std::abs(off.z);
  }

  /// Where the third vertex may lie: a parallelogram, which is too long where triangles are large
  /// and turn, and half of one.
  std::array<GridPoint, 2> beyond_positions(const BaseGate& gate) const {
    const GridPoint both = mesh_.positions[gate.from] + mesh_.positions[gate.to];
    const GridPoint behind = mesh_.positions[opposite(gate)];
    const auto half = [](std::int32_t sum, std::int32_t x) { return (3 * sum - 2 * x) >> 2; };
    return {both - behind,
            {half(both.x, behind.x), half(both.y, behind.y), half(both.z, behind.z)}};
  }
  /// The one that was nearer of late.
  GridPoint beyond_position(const BaseGate& gate) const {
    return beyond_positions(gate)[misses_[0] < misses_[1] ? 0 : 1];
  }
  void learn_from(const BaseGate& gate, GridPoint at) {
    const std::array<GridPoint, 2> guesses = beyond_positions(gate);
    for (unsigned i = 0; i < 2; ++i) misses_[i] += distance(at, guesses[i]) - (misses_[i] >> 3);
  }

  /// Vertices that the third one is likely to be, kNamed - 1 at most: those beside the gate, and
  /// from there on those of other gates, the nearest first.
  std::vector<Index> likely_thirds(const BaseGate& gate, bool with_others) const {
    std::vector<Index> out = gates_.beside(gate, kNamed - 1);
    if (!with_others) return out;
    const GridPoint middle = beyond_position(gate);
    std::vector<Index> others = gates_.others(gate, out);
    std::ranges::stable_sort(others, {},
                             [&](Index v) { return distance(mesh_.positions[v], middle); });
    others.resize(std::min<std::size_t>(others.size(), kNamed - 1 - out.size()));
    out.insert(out.end(), others.begin(), others.end());
    return out;
  }

  Index code_third(const BaseGate& gate, Index wanted) {
    constexpr Index kMany = 4;  // triangles
    coder_.part(Part::base_map);
    std::vector<Index> likely = likely_thirds(gate, false);
    unsigned symbol = kNamed;
    if constexpr (!Coder::kReads) {
      const auto place = [&] { return std::ranges::find(likely, wanted) - likely.begin(); };
      if (wanted != next_vertex_ && place() == std::ssize(likely))
        likely = likely_thirds(gate, true);
      if (wanted == next_vertex_)
        symbol = kNext;
      else if (place() < std::ssize(likely))
        symbol = static_cast<unsigned>(1 + place());
    }
    symbol = coder_.symbol(models_.third[triangles_at_[gate.from] > kMany ? 1 : 0]
                                        [triangles_at_[gate.to] > kMany ? 1 : 0],
                           symbol);
    if (symbol == kNext) return next_vertex_;
    if (symbol > likely.size() && symbol < kNamed) likely = likely_thirds(gate, true);
    if (symbol <= likely.size()) return likely[symbol - 1];
    return coder_.raw(wanted, bits_for(counts_.vertices));
  }

  Index code_vertex(Index wanted) {
    coder_.part(Part::base_map);
    if (coder_.bit(models_.next_vertex, wanted == next_vertex_)) return next_vertex_;
    return coder_.raw(wanted, bits_for(counts_.vertices));
  }

  /// gate  of the triangle, or null
  Result<void> code_corner(Index t, unsigned k, Index v, const BaseGate* gate) {
    const bool is_third = gate != nullptr && k == 2;
    if (!is_known_[v] && is_third) {
      code_position(v, models_.near, beyond_position(*gate));
      learn_from(*gate, mesh_.positions[v]);
    } else if (!is_known_[v]) {
      code_position(v, models_.far, last_position_);
    }
    Index usual = last_wedge_of_[v];
    if (gate != nullptr && k < 2)
      usual = mesh_.corners[3 * gate->triangle + (gate->from_corner + 1 - k) % 3];
    return code_wedge(t, k, v, usual, gate);
  }

  Index opposite(const BaseGate& gate) const {
    return vertex(gate.triangle, (gate.from_corner + 2) % 3);
  }

  /// What is there already of the triangle, and of the one behind its gate if that shows the same
  /// wedges.
  WedgeSurroundings surroundings(Index t, unsigned k, Index v, Index usual,
                                 const BaseGate* gate) const {
    WedgeSurroundings out;
    const GridPoint at = mesh_.positions[v];
    const Index* const corner = mesh_.corners.data() + 3 * t;
    for (unsigned i = 0; i < k; ++i) out.add_neighbour(corner[i]);
    if (k == 2)
      out.add_face(mesh_.positions[vertex(t, 0)] - at, mesh_.positions[vertex(t, 1)] - at);
    if (k == 2 && gate != nullptr) {
      const auto behind = [&](unsigned i) { return (gate->from_corner + i) % 3; };
      const Index* const other = mesh_.corners.data() + 3 * gate->triangle;
      if (other[behind(0)] == corner[1] && other[behind(1)] == corner[0]) {
        out.add_neighbour(other[behind(2)]);
        const GridPoint from = mesh_.positions[gate->from];
        out.add_face(mesh_.positions[gate->to] - from, mesh_.positions[opposite(*gate)] - from);
      }
    }
    if (const Index near = usual != kNone ? usual : last_wedge_;
        out.neighbours().empty() && near != kNone)
      out.add_neighbour(near);
    return out;
  }

  void code_position(Index v, NumberModel& model, GridPoint predicted) {
    GridPoint& at = mesh_.positions[v];
    coder_.part(Part::base_positions);
    code_number(model, predicted.x, at.x);
    code_number(model, predicted.y, at.y);
    code_number(model, predicted.z, at.z);
    is_known_[v] = true;
    while (next_vertex_ < counts_.vertices && is_known_[next_vertex_]) ++next_vertex_;
    last_position_ = at;
  }

  void code_number(NumberModel& model, std::int32_t predicted, std::int32_t& value) {
    const std::int32_t coded =
        predicted + model.code(coder_, Coder::kReads ? 0 : value - predicted);
    if constexpr (Coder::kReads) value = std::clamp(coded, -kMaxGrid, kMaxGrid);
  }

  /// usual  a wedge of v, or kNone
  Result<void> code_wedge(Index t, unsigned k, Index v, Index usual, const BaseGate* gate) {
    Index& wedge = mesh_.corners[3 * t + k];
    coder_.part(Part::base_wedges);
    if (counts_.single_wedges) {
      wedge = v;
      if (!is_known_wedge_[v]) code_new_wedge(v, v, surroundings(t, k, v, usual, gate));
      return {};
    }
    if (usual != kNone && coder_.bit(models_.usual_wedge, wedge == usual)) {
      wedge = last_wedge_of_[v] = usual;
      return {};
    }
    if (coder_.bit(models_.next_wedge, wedge == next_wedge_))
      wedge = next_wedge_;
    else
      wedge = coder_.raw(wedge, bits_for(counts_.wedges));
    if (wedge >= counts_.wedges) return broken(Fault::compact_base);
    if (!is_known_wedge_[wedge])
      code_new_wedge(wedge, v, surroundings(t, k, v, usual, gate));
    else if (mesh_.wedge_vertex[wedge] != v)
      return broken(Fault::compact_base);
    last_wedge_of_[v] = wedge;
    return {};
  }

  void code_new_wedge(Index wedge, Index v, const WedgeSurroundings& around) {
    mesh_.wedge_vertex[wedge] = v;
    if (counts_.columns > 0) code_attributes(wedge, v, around);
    older_wedge_[wedge] = newest_wedge_of_[v];
    newest_wedge_of_[v] = wedge;
    is_known_wedge_[wedge] = true;
    while (next_wedge_ < counts_.wedges && is_known_wedge_[next_wedge_]) ++next_wedge_;
    last_wedge_ = last_wedge_of_[v] = wedge;
  }

  void code_attributes(Index wedge, Index v, const WedgeSurroundings& around) {
    constexpr std::size_t kMostLooks = 64;
    siblings_.clear();
    for (Index w = newest_wedge_of_[v]; w != kNone && siblings_.size() < kMostLooks;
         w = older_wedge_[w])
      siblings_.push_back(w);
    std::array<GridPoint, PlaneFit::kMost> arms;
    std::size_t count = 0;
    for (const Index w : around.neighbours())
      arms[count++] = mesh_.positions[mesh_.wedge_vertex[w]] - mesh_.positions[v];
    attributes_.code(wedge, around, {arms.data(), count}, siblings_,
                     mesh_.wedge_cells.data() + std::size_t{wedge} * counts_.columns);
  }

  void code_group(Index t) {
    if (counts_.groups < 2) return;
    coder_.part(Part::base_map);
    const Index before = t > 0 ? mesh_.group[t - 1] : 0;
    Index& group = mesh_.group[t];
    if (coder_.bit(models_.same_group, group == before))
      group = before;
    else
      group = std::min(coder_.raw(group, bits_for(counts_.groups - 1)), counts_.groups - 1);
  }

  Coder& coder_;
  const BaseCounts counts_;
  BaseMesh& mesh_;
  BaseModels models_;
  BaseGates gates_;
  std::vector<bool> is_known_, is_known_wedge_;
  std::vector<Index> last_wedge_of_;                  // a vertex each; kNone: it has none yet
  std::vector<Index> triangles_at_;                   // likewise, so far
  std::vector<Index> newest_wedge_of_, older_wedge_;  // of a vertex, in the order of coming
  std::vector<Index> siblings_;                       // scratch: those of one vertex
  AttributeCode<Coder> attributes_;
  Index next_vertex_ = 0, next_wedge_ = 0, last_wedge_ = kNone;
  GridPoint last_position_;
  std::array<std::int64_t, 2> misses_{};  // of the guesses, so that old ones fade
  bool at_none_ = false;
};

}  // namespace pstrips::inline formats
