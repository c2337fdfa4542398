#pragma once

#include "formats/ply/ply_description.h"
#include "formats/ply/ply_kept.h"

namespace pstrips::inline formats::ply {

/// Whether an element says which vertices are joined and nothing else: "edge" with vertex1 and
/// vertex2, integers.
bool is_edge_list(const Element& element);

/// Makes lines of the rows of such an element that was kept; they are no longer kept. Where a row
/// names no vertex, all stay as they are.
///
/// rows_are_wedges  of the vertex element
void read_edges(Kept& kept, bool rows_are_wedges, Mesh& mesh);

/// Whether there are faces of other kinds than polygons, which a face element cannot hold.
bool has_lines_or_points(const Mesh& mesh);
/// The mesh without them.
Mesh polygons_of(const Mesh& mesh);

/// Adds the lines of a mesh as rows of an edge element, one for each two corners that follow each
/// other, to the description of polygons_of() it.
void add_edges(const Mesh& mesh, Description& description);

}  // namespace pstrips::inline formats::ply
