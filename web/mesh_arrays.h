#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codecs/filter/display_level.h"
#include "web/decoder.h"

namespace pstrips::inline web {

/// A level as arrays that a drawing interface takes, and what has changed in them.
class MeshArrays {
 public:
  /// Makes the arrays anew. O(level).
  void update(const DisplayLevel& shown, bool keeps_strips);
  /// As of the last update().
  const PstripsMesh& mesh() const { return mesh_; }

 private:
  void take_positions(const Level& level);
  void take_triangles(const Level& level);
  void take_strips(const DisplayLevel& shown);

  std::vector<float> positions_, old_positions_;
  std::vector<Index> triangles_, old_triangles_;
  std::vector<Index> group_first_;
  DisplayStrips strips_;
  std::vector<Index> changed_;
  PstripsMesh mesh_{};
};

}  // namespace pstrips::inline web
