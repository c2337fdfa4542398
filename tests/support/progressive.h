#pragma once

#include <cstdint>

#include "core/progressive_strips.h"

namespace pstrips::test {

/// What a generated file has. Every combination is valid.
struct ProgressiveOptions {
  Index meshes = 1;
  Index base_vertices = 5;  ///< of each mesh
  Index vsplits = 6;        ///< of each mesh
  Index packet_vsplits = 2;
  MapEncoding encoding = MapEncoding::naive;
  Placement placement = Placement::subset;
  bool single_wedges = true;
  bool scene = false;    ///< generator, nodes, materials, images, foreign entries
  bool faces = false;    ///< polygons, lines and face attributes beside the strips
  bool welding = false;  ///< of meshes that have wedges
  bool order = false;    ///< a random original order
  bool digest = false;
  bool unknown = false;  ///< chunks that nobody knows
};

/// A valid file with random strips, splits and attributes. It is made forwards: a random base, then
/// random splits, so that it shows every liberty the format gives and no surface at all. Same seed,
/// same file.
ProgressiveStrips random_progressive(std::uint32_t seed, const ProgressiveOptions& options = {});

/// As above with options drawn from the seed too.
ProgressiveStrips random_progressive_of_any_kind(std::uint32_t seed);

/// The mesh after the first `vsplits` records, straight from spec/vsplit.md, slowly. At full
/// resolution with the face table applied, otherwise the triangles alone. Names, groups and decoded
/// numbering; neither welding nor original order is applied.
Mesh decode_slowly(const ProgressiveMesh& mesh, std::size_t vsplits);

/// Recounts triangles and strips of every level of every mesh, e.g. after a test edited records.
void recount_levels(ProgressiveStrips& strips);

}  // namespace pstrips::test
