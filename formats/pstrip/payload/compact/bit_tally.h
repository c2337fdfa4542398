#pragma once

#include <array>
#include <cmath>

#include "formats/pstrip/container/part.h"
#include "formats/pstrip/payload/compact/rans.h"

// For formats/pstrip/payload/compact: what the codes of a run are spent on.

namespace pstrips::inline formats {

/// Adds up the bits of codes by part. A copy goes on with the same sums.
class BitTally {
 public:
  /// bits  outlives the tally
  explicit BitTally(PartBits& bits) : bits_(&bits) {}

  void part(Part p) { part_ = p; }
  void add(std::uint32_t shares) {
    (*bits_)[static_cast<std::size_t>(part_)] += kShareBits - std::log2(shares);
  }

 private:
  PartBits* bits_;
  Part part_ = Part::container;
};

}  // namespace pstrips::inline formats
