#include "converters/welded_mesh.h"

#include <utility>

#include "codecs/vsplit/faces.h"
#include "codecs/weld/record_welding.h"
#include "codecs/weld/unweld.h"
#include "formats/pstrip/payload/digest.h"

namespace pstrips::inline converters {

WeldedMesh::WeldedMesh(const Mesh& source, const Mesh& unmoved, std::optional<double> distance)
    : source_(source) {
  if (distance) welds_ = find_welds(unmoved, *distance);
  if (welds_) welded_ = weld(source, *welds_);
}

void WeldedMesh::complete(const Triangulation& triangles, const StripMap& map, bool keep_order,
                          Recording& recording) const {
  FaceRecord faces = record_faces(mesh(), triangles, map, recording, keep_order || welds_);
  recording.mesh.faces = std::move(faces.faces);
  Mesh decoded = mesh_to_decode(mesh(), map, recording);
  if (welds_) {
    WeldingRecord record =
        record_welding(source_, *welds_, decoded, recording.wedge_from, faces.order);
    faces.order.vertex = std::move(record.vertex_from);
    faces.order.wedge = std::move(record.wedge_from);
    recording.mesh.welding = std::move(record.welding);
    decoded = unweld(decoded, recording.mesh.welding).value();
  }
  if (keep_order) recording.mesh.order = std::move(faces.order);
  const Digest sum = digest(decoded);
  recording.mesh.digest.assign(sum.begin(), sum.end());
}

}  // namespace pstrips::inline converters
