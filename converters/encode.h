#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "codecs/simplify/simplify.h"
#include "codecs/stripify/stripify.h"
#include "core/limits.h"
#include "core/progress.h"
#include "core/progressive_strips.h"
#include "core/result.h"

namespace pstrip {

struct EncodeOptions {
  MapEncoding encoding = MapEncoding::offset_difference;
  std::string stripifier = "best";  ///< a name of stripifiers()
  StripOptions strip_options{};
  double base_share = 0.05;                       ///< of each mesh's triangles that the base keeps
  std::optional<std::uint64_t> base_triangles{};  ///< instead: of all meshes together
  std::optional<double> base_error{};  ///< instead: largest distance estimate, model units
  bool keep_order = false;             ///< vertex, wedge and face order of the source
  double packet_growth = 1.0 / 16;     ///< vertices a packet adds, as a share of those before it
  Index packet_min = 256;              ///< and at least so many
};

/// Turns a model into progressive strips: triangulate, stripify, simplify, record, pack.
///
/// Takes any mesh that find_inconsistency() accepts. Packets of several meshes are interleaved by
/// error, largest first. Same model and options, same result.
///
/// errors  bad_argument for an unknown stripifier or an inconsistent mesh, over_limit for more than
///         kMaxCount map entries, interrupted
Result<ProgressiveStrips> encode(const Model& model, const EncodeOptions& options,
                                 const Progress& progress = {});

/// The same with the collapses given instead of chosen: one sequence a mesh, for progressive
/// meshes that come from elsewhere.
Result<ProgressiveStrips> encode_with(const Model& model,
                                      const std::vector<CollapseSequence>& collapses,
                                      const EncodeOptions& options, const Progress& progress = {});

/// Keeps the wedge attributes named in `semantics` and drops the others; wedges that then say the
/// same of the same vertex become one. POSITION always stays.
void keep_attributes(Model& model, const std::vector<std::string>& semantics);

}  // namespace pstrip
