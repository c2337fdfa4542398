#pragma once

#include "validators/rules.h"

namespace pstrips::inline validators::checks {

// The checks of the rules in the table. What a rule demands is the sentence of its row.

/// The faults of one kind that were noticed while the file was taken apart or replayed.
template <Fault kFault>
void noticed(const Document& doc, Findings& out) {
  for (const FaultAt& fault : doc.faults.list())
    if (fault.fault == kFault) out.add(fault.where, fault.found);
}

using Check = void(const Document&, Findings&);

// checks_header.cpp: what PSHD, MESH and PIDX declare.
Check totals_summed, base_end, file_bytes, decoder_memory_computed, conformance_computed;
Check counts_representable, single_wedges_hold, semantics_differ, few_attributes, has_group,
    group_materials_exist, group_entries_summed, counts_of_base, vsplits_fill, strips_fit_map,
    mesh_wedges_come, packets_hold_vsplits, packets_not_empty, triangle_entries_hold,
    profile_encodings, position_grids;
Check rows_counted, rows_point_to_chunks, rows_describe_chunks, row_vertices, row_triangles,
    row_strips, errors_finite, errors_fall, one_side_within_both;

// checks_base.cpp: base and index map.
Check wedge_vertices_exist, vertices_have_wedges, map_wedges_exist, symbols_allowed,
    symbols_resolve, groups_end_strips, only_polygons_have_strips, triangles_whole;

// checks_result.cpp: the mesh at full resolution.
Check full_counts_reached, triangle_groups_exist, triangles_of_groups_counted;
Check face_bounds, face_corners_exist, face_groups_exist, replaced_bounds, replaced_exist,
    replaced_once, replaced_in_group, faces_counted, faces_needed;
Check welding_counts, welding_fits, order_vertices, order_wedges, order_faces, rotations,
    digest_matches;

// checks_scene.cpp
Check node_parents, node_meshes, material_images, material_maps, images_there, foreign_keys_differ;

}  // namespace pstrips::inline validators::checks
