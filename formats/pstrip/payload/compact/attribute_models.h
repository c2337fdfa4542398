#pragma once

#include <array>
#include <vector>

#include "formats/pstrip/payload/compact/fine.h"
#include "formats/pstrip/payload/compact/split_models.h"

namespace pstrips::inline formats {

/// All that is learned of the attributes of a mesh.
struct AttributeModels {
  /// What is learned of an attribute as a whole.
  struct OfAttribute {
    static constexpr unsigned kSiblings = 4, kAlike = 5, kBefore = 3;

    /// Which wedge nearby has the same: by how many siblings there are that differ, how far the
    /// neighbours agree, and what was the case the last time.
    std::array<std::array<std::array<SymbolModel, kBefore>, kAlike>, kSiblings> same;
    unsigned before = 0;            ///< 0: none had; 1: a sibling; 2: a neighbour
    std::array<int, 3> distance{};  ///< of directions from the guesses, smoothed
  };

  explicit AttributeModels(const MeshCells& cells)
      : attributes(cells.attributes.size()), columns(columns_of(cells)) {}

  std::vector<OfAttribute> attributes;
  std::vector<ScaledNumberModel> columns;
};

}  // namespace pstrips::inline formats
