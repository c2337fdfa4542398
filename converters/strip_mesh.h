#pragma once

#include "codecs/stripify/stripify.h"
#include "codecs/triangulate/triangulate.h"
#include "codecs/vsplit/record.h"

namespace pstrips::inline converters {

/// Runs a stripifier on the triangles of each group of a mesh and joins the strips into one index
/// map. Every strip but the last of the map is followed by a restart, which counts as its group's.
/// `step_cost` is StripInput's, of the triangles as they are given here.
StripMap strip_mesh(const Mesh& mesh, const Triangulation& triangles,
                    const NamedStripifier& stripifier, const StripOptions& options = {},
                    std::span<const std::uint8_t> step_cost = {});

/// The faces that strips over polygons cover: those of a mesh, degenerate ones and those that meet
/// a vertex twice as their triangles.
struct StrippableFaces {
  std::vector<Index> corners;  ///< wedges
  std::vector<Index> face_first{0};
  std::vector<Index> group;
};
StrippableFaces strippable_faces(const Mesh& mesh);

/// strip_mesh() of the strippable faces, whose diagonals the stripifier chooses where it can
/// (NamedStripifier::run_polygons) and triangulate() where not.
StripMap strip_faces(const Mesh& mesh, const NamedStripifier& stripifier,
                     const StripOptions& options = {});

}  // namespace pstrips::inline converters
