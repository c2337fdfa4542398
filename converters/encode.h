#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "codecs/simplify/simplify.h"
#include "codecs/stripify/stripify.h"
#include "converters/attribute_grid.h"
#include "core/limits.h"
#include "core/progress.h"
#include "core/progressive_strips.h"
#include "core/result.h"

namespace pstrips::inline converters {

/// What a full swing of an attribute costs, as a share of the bounding-box diagonal by which a
/// surface would have to be off: of UVs and colours their range, of normals the unit length. 0: it
/// does not count.
struct AttributeWeight {
  std::string semantic;  ///< as in the mesh; without its number it is meant for all numbers
  double weight = 0;     ///< from 0 to 1e6
};

inline constexpr std::uint32_t kMaxLevelCost = 100;

/// A base of the compact profile has so many triangles at most, unless told otherwise: about twice
/// as many as vertices.
inline constexpr std::uint64_t kCompactBaseTriangles = 400;

struct EncodeOptions {
  /// In the compact profile maps are of triangles, packets are batches [record_batches()], and
  /// optimal placement is the middle of two vertices.
  Profile profile = Profile::plain;
  /// With the compact profile: positions are moved to a grid of so many bits, see position_grid().
  /// 0: they stay as they are.
  unsigned position_bits = 0;
  /// With the compact profile: wedge attributes are moved to grids, see AttributeGrids.
  AttributeBits attribute_bits{};
  /// With the compact profile: bits makes files smaller and levels a little worse.
  CollapseOrder order = CollapseOrder::error;
  /// With the compact profile: small takes fewer bits and decodes several times as slowly.
  Effort effort = Effort::fast;
  /// What follows up to `level_cost` matters only where maps are of strips.
  MapEncoding encoding = MapEncoding::offset;
  std::string stripifier = "best";  ///< a name of stripifiers()
  StripOptions strip_options{};     ///< `stop` may be called by several threads at once
  /// What a step counts for, in indices, that tears its strip at coarser levels; see
  /// level_step_cost(). Of the stripifiers, `best` looks at it. 1 is free: files get no larger.
  /// More shortens the strips of coarse levels and lengthens the file; 0 looks at the full mesh
  /// alone. At most kMaxLevelCost.
  std::uint32_t level_cost = 1;
  /// Of each mesh's triangles that the base keeps. Not given: 0.05, in the compact profile 0.1 and
  /// kCompactBaseTriangles at most; of a small mesh each component keeps some.
  std::optional<double> base_share{};
  std::optional<std::uint64_t> base_triangles{};  ///< instead: of all meshes together
  std::optional<double> base_error{};  ///< instead: largest Packet::error of it, model units
  Placement placement = Placement::subset;
  Metric metric = Metric::memoryless;
  /// How much attributes count when collapses are chosen, see AttributeWeight; the others as usual.
  std::vector<AttributeWeight> attribute_weights{};
  /// That a mesh may take, see check_capacity(), and that those encoded side by side may take
  /// together.
  std::uint64_t memory_bytes = Limits{}.memory_bytes;
  /// Vertices at most so far apart, model units, are one for levels and strips, whatever the model
  /// says: 0 those at one place. Decoding parts them again. Not given: only what the model says.
  std::optional<double> weld = 0;
  /// Vertex, wedge and face order of the source; kept at any rate where the scene has rows that go
  /// by it, see has_rows_bound_to_order().
  bool keep_order = false;
  /// Vertices a packet adds, as a share of those before it, unless it is a batch …
  double packet_growth = 1.0 / 16;
  Index packet_min = 256;  ///< … and at least so many
  unsigned threads = 0;    ///< to work with; 0: one a core. Results do not depend on it
};

/// How the collapses of one mesh were chosen.
struct SimplifyReport {
  std::string mesh;  ///< its name
  std::uint64_t triangles = 0, base_triangles = 0;
  SimplifyStop stop = SimplifyStop::target;
  ConstraintCounts refused, forced;
  double moved = 0;  ///< how far, at most, a vertex was moved to the grid, model units
  std::vector<QuantizedAttribute> quantized;
};

/// Turns a model into progressive strips: triangulate, stripify, simplify, record, pack.
///
/// Takes any mesh that find_inconsistency() accepts. Packets of several meshes are interleaved by
/// the error that a viewer sees, largest first: that of the mesh times its instance_scales(). Up to
/// any error of the scene the file then holds the fewest packets. Same model and options, same
/// result, whatever the number of threads.
///
/// progress is called by several threads, one at a time
/// reports  one a mesh is added, unless null
/// errors   bad_argument for an unknown stripifier, position bits that the profile does not take,
/// or
///          an inconsistent mesh or scene; unsupported as position_grid(); over_limit for a mesh
///          that check_capacity() refuses (before any work) or that comes to more than kMaxCount
///          map entries; interrupted
Result<ProgressiveStrips> encode(const Model& model, const EncodeOptions& options,
                                 const Progress& progress = {},
                                 std::vector<SimplifyReport>* reports = nullptr);

/// The same with the collapses given instead of chosen: one sequence a mesh, for progressive
/// meshes that come from elsewhere.
Result<ProgressiveStrips> encode_with(const Model& model,
                                      const std::vector<CollapseSequence>& collapses,
                                      const EncodeOptions& options, const Progress& progress = {});

/// Keeps the wedge attributes named in `semantics` and drops the others; wedges that then say the
/// same of the same vertex become one. POSITION always stays.
void keep_attributes(Model& model, const std::vector<std::string>& semantics);

}  // namespace pstrips::inline converters
