#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codecs/vsplit/level.h"
#include "core/progressive_strips.h"

namespace pstrips::inline converters {

/// How far to refine; the first limit that is set decides.
struct LevelChoice {
  /// So many packets of the file, in file order.
  std::int64_t packets = -1;
  /// The most packets whose triangles, all meshes together, do not exceed this.
  std::int64_t triangles = -1;
  /// The fewest packets after which the scene's error is at most this, see SceneLevel.
  double error = -1;
};

/// How many packets a choice comes to; all of them when nothing is set. The base always counts, so
/// 0 is the coarsest answer.
std::size_t packets_for(const ProgressiveStrips& strips, const LevelChoice& choice);

/// The model after `packets` packets of the file, with original order, polygons and face attributes
/// where a mesh is fully refined and the file has them.
///
/// errors  corrupt when a vertex has no wedge or a full mesh shows other triangles than the file
///         announced
/// cost    O(decoded size); precondition as for Level
Result<Model> decode(const ProgressiveStrips& strips, std::size_t packets);
Result<Model> decode(const ProgressiveStrips& strips);
/// The same for strips that are not needed any more: their parts are freed as soon as they are
/// used, so that the peak is little more than the larger of strips and model.
Result<Model> decode(ProgressiveStrips&& strips, std::size_t packets);

/// A level that may end inside a packet.
struct SplitLevel {
  std::size_t packets = 0;           ///< whole ones
  std::vector<Index> vsplits{};      ///< of each mesh
  Index more_vsplits = 0;            ///< of them, those of the packet after
  std::uint64_t more_triangles = 0;  ///< that these bring
};

/// The packets of packets_for(), and then as many vsplits of the next one as leave no more than so
/// many triangles. Cost O(decoded size · log of a packet).
SplitLevel split_level(const ProgressiveStrips& strips, std::uint64_t triangles);

/// The model at that level, as decode() makes it.
Result<Model> decode(const ProgressiveStrips& strips, const SplitLevel& level);

/// One mesh at a level, as decode() gives it.
Result<Mesh> decoded_mesh(const Level& level);

/// A shorter progressive file: the first `packets` packets, complete in itself even if `strips` is
/// not. What belongs to the full resolution only (order, face table, digest) is left out of the
/// meshes that are cut.
ProgressiveStrips cut(const ProgressiveStrips& strips, std::size_t packets);

}  // namespace pstrips::inline converters
