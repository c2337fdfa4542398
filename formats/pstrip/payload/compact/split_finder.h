#pragma once

#include <vector>

#include "core/result.h"
#include "core/strip_state.h"
#include "formats/pstrip/payload/compact/mesh_state.h"
#include "formats/pstrip/payload/compact/split_state.h"
#include "formats/pstrip/payload/compact/wedge_code.h"

namespace pstrips::inline formats {

/// Finds out which split of a vertex a record is.
///
/// A record says which entries of the map to rewrite; a split, which neighbours of a vertex bound
/// the faces that the new vertex gets. One for which there are no such neighbours takes the long
/// form.
class SplitFinder {
 public:
  explicit SplitFinder(const MeshState& state) : state_(state) {}

  /// Steps aside, which positions tell.
  ///
  /// record  of the packet that is being coded, the next one after those that `state` has
  /// returns false: no split does what the record does, or what both sides know does not tell it
  bool find(const VsplitRecord& record, Index new_wedges, GridSplit& split, SplitRecord& rest);

 private:
  struct NewTriangle {
    Index third;
    bool added_first;
  };

  bool find_moved(const VsplitRecord& record);
  bool find_triangles(const VsplitRecord& record);
  bool find_chord(Index parent, GridSplit& split);
  void name_corners(GridSplit& split) const;
  Index vertex_after(Index wedge, const VsplitRecord& record) const;
  struct Moved {
    Index corner, wedge;
  };
  const Moved* moved(Index corner) const;
  void list_shown(const GridSplit& split, std::vector<Index>& shown) const;

  const MeshState& state_;
  VertexRing ring_;
  std::vector<Index> corners_;  // of the parent
  std::vector<Moved> moved_;    // by corner, with the wedges that they show then
  std::vector<NewTriangle> triangles_;
};

}  // namespace pstrips::inline formats
