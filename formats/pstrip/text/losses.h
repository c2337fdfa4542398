#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/progressive_strips.h"

namespace pstrips::inline formats {

/// What a text file cannot carry, a phrase each, in the order in which they were found.
class Losses {
 public:
  void add(bool lost, std::string phrase) {
    if (lost && std::ranges::find(list_, phrase) == list_.end()) list_.push_back(std::move(phrase));
  }
  void count(std::uint64_t n, const char* phrase) { add(n > 0, std::to_string(n) + phrase); }
  std::vector<std::string> take() && { return std::move(list_); }

 private:
  std::vector<std::string> list_;
};

/// The attribute that becomes the texture coordinates of a text file; null: the mesh has none.
const Attribute* texture_of(const ProgressiveMesh& mesh);

/// What of these strips has no place in a text file, whatever its records are.
///
/// textured  their texture coordinates are written
Losses losses_of(const ProgressiveStrips& strips, bool textured);

}  // namespace pstrips::inline formats
