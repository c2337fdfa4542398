#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh.h"

namespace pstrip {

/// What is noticed while a file is taken apart and replayed. A rule of the table reports each of
/// them; what needs no such pass has a check of its own there.
enum class Fault : std::uint8_t {
  // The answer is not "corrupt".
  truncated,
  over_limit,
  too_much_work,
  version_unknown,
  profile_unknown,
  flags_unknown,
  critical_chunk_unknown,
  digest_unknown,
  // Frame.
  signature,
  type_not_letters,
  type_third_letter,
  chunk_length,
  chunk_padding,
  chunk_crc,
  first_chunk,
  chunk_order,
  chunk_twice,
  mesh_chunks,
  base_chunks,
  packet_chunks,
  index_missing,
  tail_order,
  bytes_after_end,
  end_payload,
  past_file_bytes,
  // Payloads.
  string_not_utf8,
  payload_length,
  reserved_not_zero,
  array_padding,
  value_undefined,
  type_undefined,
  no_components,
  base_mesh,
  base_counts,
  packet_mesh,
  packet_wedges,
  packet_places,
  packet_single_wedges,
  faces_mesh,
  faces_empty,
  face_elements,
  order_mesh,
  order_rotation_bits,
  packed_padding,
  digest_mesh,
  image_data,
  packet_not_next,
  // XML.
  xml_malformed,
  xml_declaration,
  xml_schema,
  xml_unsupported,
  xml_bases,
  xml_packet_vsplits,
  xml_list_length,
  xml_vsplit_form,
  xml_twice,
  xml_chunk_type,
  xml_number,
  xml_backslash,
  xml_base64,
  // Records.
  parent_not_there,
  lone_vertex_carries,
  lone_vertex_writes,
  new_vertex_without_wedge,
  parent_without_wedge,
  carried_not_there,
  carried_not_of_parent,
  place_past_end,
  place_is_restart,
  places_not_ascending,
  place_twice,
  place_not_of_parent,
  lone_vertex_moves,
};

/// Which value of a file is meant. Each is one of the field names of the specification.
enum class Field : std::uint8_t {
  file,    ///< the whole, or the byte `element`
  chunk,   ///< the chunk `element` of the file
  header,  ///< PSHD; `element` is the byte in its payload
  mesh,    ///< MESH
  position_format,
  wedge_format,  ///< `element` is the attribute
  face_format,
  group,   ///< `element` is the group
  counts,  ///< `element` is the number of the count, vertices first
  index,   ///< PIDX
  row,     ///< row `element` of PIDX
  base,    ///< BASE
  base_wedge_vertex,
  base_map,
  packet,  ///< PCKT `packet` of its mesh
  record,  ///< vsplit `record` of the packet
  parent,
  carried,  ///< `element` is the index in the packet's list, as below
  place,
  faces,  ///< fACE
  face_first,
  face_corner,
  face_group,
  replaced_first,
  replaced,
  order,  ///< oRDP
  order_vertex,
  order_wedge,
  order_face,
  rotation,
  digest,  ///< dGST
  node,    ///< `element` is the node
  material,
  image,
  foreign,
};

/// A place in the model, independent of how the file spells it.
struct Where {
  Field field = Field::file;
  Index mesh = kNone;
  Index packet = kNone;  ///< of the mesh
  Index record = kNone;  ///< of the packet
  std::uint64_t element = 0;
  friend bool operator==(const Where&, const Where&) = default;
};

struct FaultAt {
  Fault fault;
  Where where;
  std::string found;  ///< what stands there instead; may be empty
};

/// The faults of one file. A pass over hostile bytes may meet millions: what is kept is bounded.
class Faults {
 public:
  void add(Fault fault, const Where& where, std::string found = {}) {
    if (list_.size() < kMost) list_.push_back({fault, where, std::move(found)});
  }
  const std::vector<FaultAt>& list() const { return list_; }

 private:
  static constexpr std::size_t kMost = 10'000;
  std::vector<FaultAt> list_;
};

}  // namespace pstrip
