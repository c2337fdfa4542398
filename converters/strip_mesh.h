#pragma once

#include "codecs/stripify/stripify.h"
#include "codecs/triangulate/triangulate.h"
#include "codecs/vsplit/record.h"

namespace pstrip {

/// Runs a stripifier on the triangles of each group of a mesh and joins the strips into one index
/// map. Every strip but the last of the map is followed by a restart, which counts as its group's.
/// `step_cost` is StripInput's, of the triangles as they are given here.
StripMap strip_mesh(const Mesh& mesh, const Triangulation& triangles,
                    const NamedStripifier& stripifier, const StripOptions& options = {},
                    std::span<const std::uint8_t> step_cost = {});

/// The same of the faces, whose diagonals the stripifier chooses where it can
/// (NamedStripifier::run_polygons) and triangulate() where not. Degenerate faces, and those that
/// meet a vertex twice, are triangulated in any case.
StripMap strip_faces(const Mesh& mesh, const NamedStripifier& stripifier,
                     const StripOptions& options = {});

}  // namespace pstrip
