#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "converters/file_formats.h"
#include "core/scene.h"

namespace pstrips::inline converters {

/// How many there are of a kind of thing in a model.
struct KindCount {
  std::string kind;  ///< "meshes", "faces", "attribute NORMAL", "animations" …
  std::uint64_t count = 0;
};

/// What a model holds, by kind; kinds of which there is none are not listed. Cost O(faces)
std::vector<KindCount> kinds_of(const Model& model);

/// What arrives in a format of what a model holds, and what cannot because the format has no place
/// for it; what a writer finds out while it writes it says itself.
struct Arrivals {
  std::vector<KindCount> kept, dropped;
};
Arrivals arrivals(const Model& model, FileFormat target);

}  // namespace pstrips::inline converters
