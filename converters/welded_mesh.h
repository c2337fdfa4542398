#pragma once

#include <optional>

#include "codecs/triangulate/triangulate.h"
#include "codecs/vsplit/record.h"
#include "codecs/weld/weld.h"

namespace pstrips::inline converters {

/// A mesh as levels and strips see it: with vertices at one place welded.
class WeldedMesh {
 public:
  /// source    must outlive it
  /// unmoved   the same mesh with the positions that decide which vertices stand at one place
  /// distance  see find_welds(); not given: nothing is welded
  WeldedMesh(const Mesh& source, const Mesh& unmoved, std::optional<double> distance);

  const Mesh& mesh() const { return welds_ ? welded_ : source_; }

  /// Adds to a recording of mesh() what gives the source back: faces, welding, digest, and the
  /// order if it is to be kept. Preconditions as for record_faces().
  void complete(const Triangulation& triangles, const StripMap& map, bool keep_order,
                Recording& recording) const;

 private:
  const Mesh& source_;
  std::optional<Welds> welds_;
  Mesh welded_;
};

}  // namespace pstrips::inline converters
