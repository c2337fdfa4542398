#pragma once

#include <vector>

#include "codecs/vsplit/record.h"
#include "converters/file_formats.h"
#include "core/scene.h"

namespace pstrips::cli {

struct StripModelOptions {
  bool of_points = false;     ///< strips over points: one group, whatever the mesh has
  bool a_group_each = false;  ///< each strip becomes a group of its own
  bool colored = false;       ///< neighbouring strips are told apart by colour, see below
};

/// Puts the triangles of strips in the place of a model's faces, in strip order; a writer that
/// looks for strips finds them again.
///
/// With colours each strip gets one of a dozen materials, in turn, in the place of the model's; in
/// a format that holds no materials, a face attribute COLOR_0.
///
/// maps  of each mesh, as measure_strips() gives them
void put_strips(Model& model, const std::vector<StripMap>& maps, FileFormat target,
                const StripModelOptions& options);

}  // namespace pstrips::cli
