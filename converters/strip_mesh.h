#pragma once

#include "codecs/stripify/stripify.h"
#include "codecs/triangulate/triangulate.h"
#include "codecs/vsplit/record.h"

namespace pstrip {

/// Runs a stripifier on each group of a mesh and joins the strips into one index map. Every strip
/// but the last of the map is followed by a restart, which counts as its group's.
StripMap strip_mesh(const Mesh& mesh, const Triangulation& triangles, Stripifier stripifier,
                    const StripOptions& options = {});

}  // namespace pstrip
