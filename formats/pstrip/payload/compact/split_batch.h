#pragma once

#include <vector>

#include "core/fault_list.h"
#include "formats/pstrip/payload/compact/mixed_split.h"
#include "formats/pstrip/payload/compact/split_code.h"

// For formats/pstrip/payload/compact: a batch, the splits of one packet. [split_code.h]

namespace pstrips::inline formats {

/// A split that no chord of a ring describes: who gets each face, and the new faces one by one.
template <class Coder>
Result<void> code_any(Coder& coder, SplitState& state, Index vertex, std::size_t max_faces,
                      GridSplit& split) {
  SplitModels& models = state.models;
  std::vector<Index> corners, neighbours;
  coder.part(Part::connectivity);
  state.mesh.corners_of(vertex, corners);
  for (const Index corner : corners)
    for (const Index c : {StarMesh::next_in_face(corner), StarMesh::previous_in_face(corner)})
      if (std::ranges::find(neighbours, state.mesh.vertex_of(c)) == neighbours.end())
        neighbours.push_back(state.mesh.vertex_of(c));
  split.moves.resize(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i)
    split.moves[i] = coder.bit(models.moves, split.moves[i]);

  // 15 and more: the rest as it is.
  const auto wanted = static_cast<std::uint32_t>(split.third.size());
  std::uint32_t faces = coder.symbol(models.faces, std::min(wanted, 15u));
  if (faces == 15) faces += coder.raw(wanted - 15, 28);
  if (state.mesh.face_count() + std::uint64_t{faces} > max_faces)
    return broken(Fault::compact_counts);
  split.third.resize(faces);
  split.new_first.resize(faces);
  const auto near_bits = static_cast<unsigned>(std::bit_width(neighbours.size()));
  const auto any_bits = static_cast<unsigned>(std::bit_width(state.mesh.vertex_count()));
  for (std::uint32_t i = 0; i < faces; ++i) {
    split.new_first[i] = coder.raw(split.new_first[i] ? 1 : 0, 1) != 0;
    const auto near = static_cast<std::uint32_t>(std::ranges::find(neighbours, split.third[i]) -
                                                 neighbours.begin());
    const std::uint32_t coded = coder.raw(near, near_bits);
    split.third[i] =
        coded < neighbours.size() ? neighbours[coded] : coder.raw(split.third[i], any_bits);
    if (split.third[i] >= state.mesh.vertex_count() || split.third[i] == vertex)
      return broken(Fault::compact_face);
  }
  coder.part(Part::positions);
  split.step.x = models.free_step[0].code(coder, split.step.x);
  split.step.y = models.free_step[1].code(coder, split.step.y);
  split.step.z = models.free_step[2].code(coder, split.step.z);
  return {};
}

inline bool is_on_grid(GridPoint p) {
  const auto fits = [](std::int32_t x) { return x >= -kMaxGrid && x <= kMaxGrid; };
  return fits(p.x) && fits(p.y) && fits(p.z);
}

/// Carries out a split that was coded: mesh and positions. Nothing changes when it is refused.
inline Result<Index> apply(SplitState& state, Index vertex, const VertexRing& ring,
                           const GridSplit& split) {
  constexpr std::int32_t kLargest = 2 * kMaxGrid;
  const GridPoint step = split.step;
  for (const std::int32_t x : {step.x, step.y, step.z})
    if (x > kLargest || x < -kLargest) return broken(Fault::compact_step);
  GridPoint kept = state.position[vertex];
  if (state.placement == Placement::optimal) kept = kept - halved(step);
  const GridPoint at = kept + step;
  if (!is_on_grid(kept) || !is_on_grid(at)) return broken(Fault::compact_step);
  state.position[vertex] = kept;
  state.extend(at);
  if (split.chord) return state.mesh.split(vertex, ring, split.from, split.to);

  std::vector<Index> corners;
  state.mesh.corners_of(vertex, corners);
  const Index added = state.mesh.split_any(vertex, corners, split.moves);
  for (std::size_t i = 0; i < split.third.size(); ++i)
    if (split.new_first[i])
      state.mesh.add_face(vertex, added, split.third[i]);
    else
      state.mesh.add_face(vertex, split.third[i], added);
  return added;
}

/// Limits of the mesh that is being read, from its header.
struct BatchLimits {
  std::size_t vertices, faces;
};

/// For batches of which nothing but positions and faces is coded.
inline constexpr auto kNothingElse = [](Index, Index) -> Result<void> { return {}; };

/// One batch: for each vertex in order whether it splits, and how.
///
/// split_of  the split of a vertex or null, asked for in the order of the batch; a reader gives
///           null always
/// on_split  called with the vertex and the new one after each split; what it codes stands there
/// errors    corrupt: more vertices or faces than the limits, a vertex off the grid, and bytes that
///           end early. The state is of no use then.
template <class Coder, class SplitOf, class OnSplit = std::remove_const_t<decltype(kNothingElse)>>
Result<void> code_batch(Coder& coder, SplitState& state, const BatchLimits& limits,
                        SplitOf&& split_of, const OnSplit& on_split = kNothingElse) {
  std::vector<Index> order;
  order.reserve(std::min(state.order.size() * 2, limits.vertices));
  std::ranges::fill(state.split_around, std::uint8_t{0});
  for (Turn& turn : state.turn) turn = turn == Turn::split ? Turn::waits_recent : Turn::waits;
  if (state.mixed) state.mixed->start_batch();
  VertexRing ring;
  GridSplit split;
  for (const Index vertex : state.order) {
    order.push_back(vertex);
    const GridSplit* const wanted = split_of(vertex);
    coder.part(Part::parents);
    const bool splits = code_flag(coder, state, vertex, wanted != nullptr);
    state.turn[vertex] = Turn::passed;
    if (!splits) continue;
    if (state.mesh.vertex_count() >= limits.vertices) return broken(Fault::compact_counts);
    if (wanted != nullptr) split = *wanted;
    state.mesh.ring_of(vertex, ring);
    const RingGeometry geometry(state, vertex, ring);
    if (state.mixed)
      code_mixed_chord(coder, state, ring, geometry, split);
    else
      code_chord(coder, state, ring, geometry, split);
    if (split.chord) {
      code_step(coder, state, vertex, ring, geometry, split);
      if (state.mesh.face_count() + std::size_t{2} > limits.faces + (ring.open ? 1u : 0u))
        return broken(Fault::compact_counts);
    } else if (const auto ok = code_any(coder, state, vertex, limits.faces, split); !ok) {
      return ok;
    }
    const Result<Index> added = apply(state, vertex, ring, split);
    if (!added) return tl::unexpected<Error>(added.error());
    state.turn[vertex] = state.turn[*added] = Turn::split;
    state.normal_error[*added] = state.normal_error[vertex];
    if (state.mixed) state.mixed->follow(vertex, *added);
    for (unsigned i = 0; i < ring.size; ++i)
      if (ring.vertex[i] != kNone && state.split_around[ring.vertex[i]] < 255)
        ++state.split_around[ring.vertex[i]];
    order.push_back(*added);
    if (auto ok = on_split(vertex, *added); !ok) return ok;
  }
  state.order = std::move(order);
  return {};
}

}  // namespace pstrips::inline formats
