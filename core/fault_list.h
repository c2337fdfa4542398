#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/fault.h"
#include "core/mesh.h"

namespace pstrips::inline core {

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
  reassigned,  ///< `element` is the index in the packet's list, as below
  map_offset,
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
    if (list_.size() < kMax) list_.push_back({fault, where, std::move(found)});
  }
  const std::vector<FaultAt>& list() const { return list_; }

 private:
  static constexpr std::size_t kMax = 10'000;
  std::vector<FaultAt> list_;
};

}  // namespace pstrips::inline core
