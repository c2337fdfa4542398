#include <algorithm>
#include <iterator>

#include "core/fault_list.h"

namespace pstrips::inline core {
namespace {

/// What an error says of a fault, in the order of the enumeration.
struct Text {
  Fault fault;
  std::string_view phrase;
  ErrorCode code = ErrorCode::corrupt;
};
constexpr Text kTexts[] = {
    {Fault::none, "nothing is wrong"},
    {Fault::truncated, "file ends early", ErrorCode::truncated},
    {Fault::over_limit, "asks for more than the limits grant", ErrorCode::over_limit},
    {Fault::too_much_work, "records cost more work than their size justifies",
     ErrorCode::over_limit},
    {Fault::version_unknown, "version of the format is not known", ErrorCode::unsupported},
    {Fault::profile_unknown, "profile is not known", ErrorCode::unsupported},
    {Fault::flags_unknown, "flags are not known", ErrorCode::unsupported},
    {Fault::critical_chunk_unknown, "critical chunk is not known", ErrorCode::unsupported},
    {Fault::digest_unknown, "digest algorithm is not known", ErrorCode::unsupported},
    {Fault::signature, "signature is not that of a progressive-strips file"},
    {Fault::type_not_letters, "chunk type is not four letters"},
    {Fault::type_third_letter, "third letter of the chunk type is not upper case"},
    {Fault::chunk_length, "chunk length exceeds 2^31 - 1"},
    {Fault::chunk_padding, "padding is not zero"},
    {Fault::chunk_crc, "CRC does not match the chunk"},
    {Fault::first_chunk, "first chunk is not PSHD"},
    {Fault::chunk_order, "chunk is out of order"},
    {Fault::chunk_twice, "chunk stands twice"},
    {Fault::mesh_chunks, "not as many MESH chunks as PSHD declares meshes"},
    {Fault::base_chunks, "not one BASE chunk for each mesh"},
    {Fault::packet_chunks, "not as many PCKT chunks as PSHD declares packets"},
    {Fault::index_missing, "chunk stands before PIDX"},
    {Fault::tail_order, "chunk does not follow those of meshes or images before its own"},
    {Fault::bytes_after_end, "has bytes after PEND"},
    {Fault::end_payload, "PEND has a payload"},
    {Fault::past_file_bytes, "chunk runs past the file size that PSHD declares"},
    {Fault::string_not_utf8, "string is not UTF-8"},
    {Fault::payload_length, "payload is not as long as its fields say"},
    {Fault::reserved_not_zero, "reserved byte is not zero"},
    {Fault::array_padding, "padding of an array is not zero"},
    {Fault::value_undefined, "value is none of those defined"},
    {Fault::type_undefined, "type of an attribute is none of those defined"},
    {Fault::no_components, "attribute without components"},
    {Fault::base_mesh, "BASE names the wrong mesh"},
    {Fault::base_counts, "BASE contradicts MESH"},
    {Fault::packet_mesh, "packet names a mesh past the end"},
    {Fault::packet_wedges, "records do not add up to the wedges of their packet"},
    {Fault::packet_offsets, "records do not add up to the map offsets of their packet"},
    {Fault::packet_single_wedges, "single wedges, yet not one new wedge a vsplit"},
    {Fault::packet_triangles, "records do not add up to the triangles of their packet"},
    {Fault::fine_mesh, "FINE names a mesh past the end"},
    {Fault::fine_needed, "FINE is missing, or of a mesh that has no bits for it"},
    {Fault::fine_length, "FINE does not hold the bits below the cells of its mesh"},
    {Fault::faces_mesh, "fACE names a mesh past the end"},
    {Fault::faces_empty, "fACE says nothing"},
    {Fault::faces_missing, "faces that MESH announces are missing"},
    {Fault::face_elements, "face attribute has not one element for each face"},
    {Fault::welding_mesh, "wELD names a mesh past the end"},
    {Fault::welding_bits, "a width of wELD is not the least that its numbers need"},
    {Fault::order_mesh, "oRDP names a mesh past the end"},
    {Fault::order_rotation_bits, "rotation_bits is not the least that the rotations need"},
    {Fault::packed_padding, "bits after a packed array are not zero"},
    {Fault::digest_mesh, "dGST names a mesh past the end"},
    {Fault::image_data, "image that is not announced, or without data"},
    {Fault::packet_not_next, "packet does not continue where the one before ends"},
    {Fault::image_missing, "image that is announced is missing"},
    {Fault::totals, "totals in PSHD are not the sums over the meshes"},
    {Fault::base_end, "last BASE does not end where PSHD says"},
    {Fault::file_bytes, "file is not as long as PSHD declares"},
    {Fault::row_count, "not one index row for each base and packet"},
    {Fault::row_chunk, "chunk is not where its index row says"},
    {Fault::row_contents, "index row contradicts its chunk"},
    {Fault::row_vertices, "vertices of a level are not those that its packets bring"},
    {Fault::list_length, "list is not as long as its counts say"},
    {Fault::count_too_large, "count exceeds what an index can name"},
    {Fault::single_wedge_counts, "single wedges, yet more or fewer wedges than vertices"},
    {Fault::attribute_count, "more than 1024 attributes of a kind"},
    {Fault::group_missing, "mesh without a group"},
    {Fault::group_material, "group names a material past the end"},
    {Fault::group_entries, "groups do not add up to the index map"},
    {Fault::base_too_large, "base is larger than the mesh"},
    {Fault::vsplit_count, "vsplits do not bring the vertices that the base lacks"},
    {Fault::entry_count, "more triangles or strips than index-map entries"},
    {Fault::wedge_vertex, "wedge names a vertex past the end"},
    {Fault::wedge_count, "vsplits do not bring the wedges that the base lacks"},
    {Fault::vsplits_missing, "packets do not bring all vsplits"},
    {Fault::triangle_entries, "map of triangles has not three entries for each triangle"},
    {Fault::triangle_growth, "vsplits do not bring the triangles that the base lacks"},
    {Fault::triangle_group, "triangle names a group past the end"},
    {Fault::profile_encoding, "index map is not one of triangles, as the profile calls for"},
    {Fault::position_grid, "positions are not three numbers of a type that their grid can have"},
    {Fault::face_bounds, "face bounds do not partition the corners"},
    {Fault::face_corner, "face names a wedge past the end"},
    {Fault::face_group, "face names a group past the end"},
    {Fault::replaced_bounds, "face bounds do not partition the replaced triangles"},
    {Fault::replaced_triangle, "face replaces a triangle past the end"},
    {Fault::replaced_twice, "triangle is replaced twice"},
    {Fault::face_count, "number of faces contradicts the triangles and the face table"},
    {Fault::welding_counts, "more welded than the mesh has"},
    {Fault::order_vertex, "order of the vertices is not a permutation"},
    {Fault::order_wedge, "order of the wedges is not a permutation"},
    {Fault::order_face, "order of the faces is not a permutation"},
    {Fault::rotation, "rotation is past the last corner"},
    {Fault::digest_length, "digest is not of 32 bytes"},
    {Fault::node_parent, "node does not come after its parent"},
    {Fault::node_mesh, "node names a mesh past the end"},
    {Fault::material_image, "map of a material names an image past the end"},
    {Fault::material_map_twice, "maps of a material do not ascend by role"},
    {Fault::map_entry, "index map names a wedge past the end"},
    {Fault::map_symbol, "symbol in an index map without symbols"},
    {Fault::symbol_chain, "symbols of the index map do not lead to a wedge of their strip"},
    {Fault::map_triangles, "map of triangles has a restart or part of a triangle"},
    {Fault::degenerate_triangle, "triangle of the map has two corners of one vertex"},
    {Fault::xml_malformed, "malformed XML"},
    {Fault::xml_declaration,
     "document type declarations and processing instructions are not allowed"},
    {Fault::xml_schema, "not the elements and attributes of the format"},
    {Fault::xml_unsupported, "needs a later version", ErrorCode::unsupported},
    {Fault::xml_bases, "not one base for each mesh in mesh order"},
    {Fault::xml_packet_vsplits, "not as many vsplits as announced"},
    {Fault::xml_list_length, "list is not as long as the model fixes"},
    {Fault::xml_vsplit_form, "vsplit has not the parts that its mesh calls for"},
    {Fault::xml_twice, "stands twice, or is empty"},
    {Fault::xml_chunk_type, "not the type of an unknown ancillary chunk"},
    {Fault::xml_number, "number is missing, malformed or out of range"},
    {Fault::xml_backslash, "backslash that escapes nothing"},
    {Fault::xml_base64, "malformed base64"},
    {Fault::parent_not_there, "vsplit names a parent that is not there"},
    {Fault::isolated_vertex_reassigns, "vertex of its own takes over wedges"},
    {Fault::isolated_vertex_writes, "vertex of its own changes the map"},
    {Fault::new_vertex_without_wedge, "new vertex has no wedge"},
    {Fault::parent_without_wedge, "parent is left without a wedge"},
    {Fault::reassigned_not_there, "reassigned wedge is not there"},
    {Fault::reassigned_not_of_parent, "reassigned wedge is not one of the parent"},
    {Fault::offset_past_end, "map offset is past the end of the map"},
    {Fault::offset_is_restart, "map offset is that of a restart"},
    {Fault::offsets_not_ascending, "map offsets of a wedge do not ascend"},
    {Fault::offset_twice, "map offset stands twice in a record"},
    {Fault::offset_not_of_parent, "map offset is not that of a wedge of the parent"},
    {Fault::isolated_vertex_moves, "vertex of its own has two positions"},
    {Fault::corner_not_there, "corner of a new triangle is not there"},
    {Fault::compact_mesh, "mesh is none of the compact profile"},
    {Fault::compact_cells, "cells do not fit the type of their attribute"},
    {Fault::compact_number, "number of a head is not in its shortest form, or too large"},
    {Fault::compact_run, "run of codes does not end with its last one"},
    {Fault::compact_base, "base names what is not there, a vertex twice, or a wedge of two"},
    {Fault::compact_counts, "packet brings more than the mesh has, or not what it says"},
    {Fault::compact_step, "vertex leaves the cells"},
    {Fault::compact_wedge, "wedge is not one of its vertex"},
    {Fault::compact_face, "third vertex of a new face is not there"},
};

constexpr bool are_in_order() {
  for (std::size_t i = 0; i < std::size(kTexts); ++i)
    if (kTexts[i].fault != static_cast<Fault>(i)) return false;
  return kTexts[std::size(kTexts) - 1].fault == kLastFault;
}
static_assert(are_in_order());

}  // namespace

std::string_view phrase_of(Fault fault) { return kTexts[static_cast<std::size_t>(fault)].phrase; }
ErrorCode code_of(Fault fault) { return kTexts[static_cast<std::size_t>(fault)].code; }

std::string path_of(const Where& where) {
  const auto numbered = [](const char* list, std::uint64_t i) { return list + std::to_string(i); };
  const std::string mesh = numbered("/meshes/", where.mesh);
  const auto in_mesh = [&](const char* list) { return mesh + numbered(list, where.element); };
  switch (where.field) {
    case Field::mesh:
    case Field::counts:
      return mesh;
    case Field::position_format:
      return mesh + "/position";
    case Field::wedge_format:
      return in_mesh("/wedge_attributes/");
    case Field::face_format:
      return in_mesh("/face_attributes/");
    case Field::group:
      return in_mesh("/groups/");
    case Field::base:
      return where.mesh == kNone ? "/bases" : numbered("/bases/", where.mesh);
    case Field::base_wedge_vertex:
      return in_mesh("/base_wedge_vertex/");
    case Field::base_map:
      return in_mesh("/base_map/");
    case Field::triangle_group:
      return in_mesh("/triangle_group/");
    case Field::packet:
      return numbered("/packets/", where.packet);
    case Field::record:
    case Field::parent:
    case Field::reassigned:
    case Field::map_offset:
    case Field::new_corner:
      return mesh + numbered("/vsplits/", where.record);
    case Field::faces:
    case Field::face_corner:
    case Field::replaced:
      return mesh + "/faces";
    case Field::face_first:
    case Field::face_group:
    case Field::replaced_first:
      return in_mesh("/faces/");
    case Field::welding:
      return mesh + "/welding";
    case Field::order:
      return mesh + "/order";
    case Field::order_vertex:
      return in_mesh("/order/vertex/");
    case Field::order_wedge:
      return in_mesh("/order/wedge/");
    case Field::order_face:
      return in_mesh("/order/face/");
    case Field::rotation:
      return in_mesh("/order/rotation/");
    case Field::digest:
      return mesh + "/digest";
    case Field::node:
      return numbered("/scene/nodes/", where.element);
    case Field::material:
      return numbered("/scene/materials/", where.element);
    case Field::image:
      return numbered("/scene/images/", where.element);
    case Field::foreign:
      return numbered("/scene/foreign/", where.element);
    default:
      return {};
  }
}

Error error_of(const FaultAt& at, std::uint64_t offset) {
  // What is over a limit is said in figures.
  const bool figures = at.fault == Fault::over_limit && !at.found.empty();
  Error error{code_of(at.fault), figures ? at.found : std::string(phrase_of(at.fault)), offset,
              path_of(at.where), at.fault};
  if (at.where.field == Field::file) error.offset = at.where.element;
  return error;
}

}  // namespace pstrips::inline core
