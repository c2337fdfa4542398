#pragma once

#include "core/fault_list.h"
#include "core/progressive_strips.h"
#include "core/result.h"

namespace pstrips::inline formats {

// What every reader of progressive strips checks, so that whoever works on what it returned may
// follow each index without a check of its own. [spec/model.md, spec/vsplit.md]

/// Where a packet starts in the flat lists of its mesh, and, after the last one, where they end.
struct PacketStart {
  std::size_t vsplit = 0, offset_count = 0, reassigned = 0, map_offset = 0, new_corner = 0;
  Index vertices = 0, wedges = 0;  ///< there before the packet
  friend bool operator==(const PacketStart&, const PacketStart&) = default;
};

/// The start of the first packet.
PacketStart first_packet(const ProgressiveMesh& mesh);
/// The start of the packet after one of `vsplits` records that starts at `start`.
PacketStart packet_after(const ProgressiveMesh& mesh, const PacketStart& start, Index vsplits);

// Each of these reports the first demand that is broken and returns whether there is none.

/// Names, formats, groups and counts of mesh `index`, before its base is there.
bool check_mesh_header(const ProgressiveStrips& strips, Index index, Index map_entries,
                       FaultSink& faults);
/// Base lists and index map of mesh `index`.
bool check_base(const ProgressiveStrips& strips, Index index, FaultSink& faults);
/// Records [start, end) of mesh `index`, given that all before them hold.
bool check_packet(const ProgressiveStrips& strips, Index index, const PacketStart& start,
                  const PacketStart& end, FaultSink& faults);
/// Face table and order of mesh `index`, as far as they are there.
bool check_faces(const ProgressiveStrips& strips, Index index, FaultSink& faults);
bool check_order(const ProgressiveStrips& strips, Index index, FaultSink& faults);
/// Parents, meshes, images and materials that nodes and materials name.
bool check_scene(const ProgressiveStrips& strips, FaultSink& faults);

/// All of the above and that the packets partition the vsplits. With `complete` unset, the lists
/// may end early but not inside a packet.
///
/// errors  corrupt, with a path such as "/meshes/0/vsplits/17"
/// cost    O(size)
Result<void> check(const ProgressiveStrips& strips);

/// Faces of the decoded mesh: triangles that nothing replaces and explicit faces.
Index face_count(const ProgressiveMesh& mesh);

}  // namespace pstrips::inline formats
