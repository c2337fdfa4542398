#include <algorithm>

#include "formats/pstrip/payload/check.h"
#include "formats/pstrip/xml/xml_scan.h"
#include "validators/document.h"

namespace pstrips::inline validators {
namespace {

/// The path of the model that xml.h knows lines by.
std::string model_path(const Document& doc, const Where& where) {
  const std::string element = std::to_string(where.element);
  const std::string mesh = "/meshes/" + std::to_string(where.mesh);
  switch (where.field) {
    case Field::mesh:
    case Field::counts:
      return mesh;
    case Field::position_format:
      return mesh + "/position";
    case Field::wedge_format:
      return mesh + "/wedge_attributes/" + element;
    case Field::face_format:
      return mesh + "/face_attributes/" + element;
    case Field::group:
      return mesh + "/groups/" + element;
    case Field::base:
      return "/bases/" + std::to_string(where.mesh);
    case Field::base_wedge_vertex:
      return mesh + "/base_wedge_vertex/" + element;
    case Field::base_map:
      return mesh + "/base_map/" + element;
    case Field::packet:
      return "/packets/" + std::to_string(doc.packets_of[where.mesh][where.packet]);
    case Field::record:
    case Field::parent:
    case Field::reassigned:
    case Field::map_offset: {
      std::size_t vsplit = where.record;
      for (Index k = 0; k < where.packet; ++k)
        vsplit += doc.strips.packets[doc.packets_of[where.mesh][k]].vsplits;
      return mesh + "/vsplits/" + std::to_string(vsplit);
    }
    case Field::faces:
    case Field::face_corner:
    case Field::replaced:
      return mesh + "/faces";
    case Field::face_first:
    case Field::face_group:
    case Field::replaced_first:
      return mesh + "/faces/" + element;
    case Field::order:
      return mesh + "/order";
    case Field::order_vertex:
      return mesh + "/order/vertex/" + element;
    case Field::order_wedge:
      return mesh + "/order/wedge/" + element;
    case Field::order_face:
      return mesh + "/order/face/" + element;
    case Field::rotation:
      return mesh + "/order/rotation/" + element;
    case Field::digest:
      return mesh + "/digest";
    case Field::node:
      return "/scene/nodes/" + element;
    case Field::material:
      return "/scene/materials/" + element;
    case Field::image:
      return "/scene/images/" + element;
    case Field::foreign:
      return "/scene/foreign/" + element;
    default:
      return "";
  }
}

Location locate_xml(const Document& doc, const Where& where) {
  if (where.field == Field::file) return {where.element, doc.stopped_at};
  const std::string path = model_path(doc, where);
  const std::uint32_t line = doc.lines.line_of(path);
  return {offset_of_line(doc.file, line), "line " + std::to_string(line) + ", " + path};
}

layout::MeshCounts counts_of(const ProgressiveMesh& mesh, bool complete) {
  const Index lacking = mesh.vertices - std::min(mesh.vertices, mesh.base_vertices);
  return {mesh.vertices,
          mesh.wedges,
          mesh.triangles,
          mesh.strips,
          static_cast<Index>(mesh.base_map.size()),
          complete ? static_cast<Index>(mesh.vsplits.size()) : lacking,
          face_count(mesh),
          mesh.base_vertices,
          mesh.base_wedges};
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
    doc.declared.push_back(counts_of(mesh, doc.strips.complete));
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
