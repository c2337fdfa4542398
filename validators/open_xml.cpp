#include <algorithm>

#include "formats/pstrip/payload/check.h"
#include "formats/pstrip/xml/xml_scan.h"
#include "validators/document.h"

namespace pstrips::inline validators {
namespace {

/// The same place with the packet counted in the file and the record in the mesh.
Where in_model(const Document& doc, Where where) {
  if (where.mesh == kNone || where.packet == kNone) return where;
  const std::vector<Index>& packets = doc.packets_of[where.mesh];
  if (where.record != kNone)
    for (Index k = 0; k < where.packet; ++k) where.record += doc.strips.packets[packets[k]].vsplits;
  where.packet = packets[where.packet];
  return where;
}

Location locate_xml(const Document& doc, const Where& where) {
  if (where.field == Field::file) return {where.element, doc.stopped_at};
  const XmlPlace place = doc.lines.find(path_of(in_model(doc, where)));
  return {offset_of_line(doc.file, place.line), place.text()};
}

layout::MeshCounts declared_by(const ProgressiveMesh& mesh, bool complete) {
  layout::MeshCounts counts = layout::counts_of(mesh);
  if (!complete) counts.vsplits = mesh.vertices - std::min(mesh.vertices, mesh.base_vertices);
  return counts;
}

}  // namespace

Document open_xml(ByteView file, const Limits& limits) {
  Document doc;
  doc.file = file;
  doc.xml = true;
  doc.locate = locate_xml;
  Result<ProgressiveStrips> strips = read_xml_unchecked(file, limits, &doc.lines);
  if (!strips) {
    const Error& error = strips.error();
    doc.stopped_at = error.path;
    const std::uint64_t offset = std::min<std::uint64_t>(error.offset, file.size());
    doc.faults.add(error.fault, {.field = Field::file, .element = offset}, error.message);
    return doc;
  }
  doc.strips = std::move(*strips);
  doc.ended_early = !doc.strips.complete;
  for (const ProgressiveMesh& mesh : doc.strips.meshes)
    doc.declared.push_back(declared_by(mesh, doc.strips.complete));
  for (Index m = 0; m < doc.strips.meshes.size(); ++m) {
    const ProgressiveMesh& mesh = doc.strips.meshes[m];
    if (mesh.base_wedge_vertex.size() != (mesh.single_wedges ? 0 : mesh.base_wedges)) {
      doc.faults.add(Fault::xml_list_length, {.field = Field::base_wedge_vertex, .mesh = m},
                     std::to_string(mesh.base_wedge_vertex.size()) + " entries");
      return doc;
    }
  }
  doc.packets_of.resize(doc.strips.meshes.size());
  std::vector<Index> next(doc.strips.meshes.size());
  for (Index k = 0; k < doc.strips.packets.size(); ++k) {
    const Packet& packet = doc.strips.packets[k];
    std::vector<Index>& of_mesh = doc.packets_of[packet.mesh];
    of_mesh.push_back(k);
    if (packet.first_vsplit != next[packet.mesh])
      doc.faults.add(Fault::packet_not_next, {.field = Field::packet,
                                              .mesh = packet.mesh,
                                              .packet = static_cast<Index>(of_mesh.size() - 1)});
    next[packet.mesh] += packet.vsplits;
  }
  doc.depth = Depth::model;
  return doc;
}

}  // namespace pstrips::inline validators
