#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/fault.h"
#include "core/mesh.h"
#include "core/result.h"

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
  triangle_group,  ///< `element` is the triangle
  packet,          ///< PCKT `packet` of its mesh
  record,          ///< vsplit `record` of the packet
  parent,
  reassigned,  ///< `element` is the index in the packet's list, as below
  map_offset,
  new_corner,
  faces,  ///< fACE
  face_first,
  face_corner,
  face_group,
  replaced_first,
  replaced,
  welding,  ///< wELD
  order,    ///< oRDP
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
  Index packet = kNone;  ///< of the mesh; without a mesh, of the file
  Index record = kNone;  ///< of the packet; without a packet, of the mesh
  std::uint64_t element = 0;
  friend bool operator==(const Where&, const Where&) = default;
};

/// The part of the model, such as "/meshes/0/vsplits/17"; empty for places of the file. Packets are
/// counted in the file, records in the mesh.
std::string path_of(const Where& where);

struct FaultAt {
  Fault fault = Fault::none;
  Where where;
  std::string found;  ///< what stands there instead; may be empty
};

/// The fixed phrase that an error of the fault says, and what kind of answer it is.
std::string_view phrase_of(Fault fault);
ErrorCode code_of(Fault fault);

/// The error that a reader answers with.
///
/// offset  of the chunk or element where the fault was met; a byte that `at` names goes before it
Error error_of(const FaultAt& at, std::uint64_t offset = kNoOffset);

/// `return broken(Fault::…);` from a function that does not know where it reads.
inline tl::unexpected<Error> broken(Fault fault) {
  return tl::unexpected(error_of({fault, {}, {}}));
}

/// Takes the faults that a decoder meets.
class FaultSink {
 public:
  /// Returns whether the decoder goes on, as far as what follows still has a meaning.
  virtual bool report(Fault fault, const Where& where, std::string found) = 0;

 protected:
  ~FaultSink() = default;
};

/// Stops a decoder at the first fault. A string that is not UTF-8 is none: readers take it.
class FirstFault final : public FaultSink {
 public:
  bool report(Fault fault, const Where& where, std::string found) override {
    if (fault == Fault::string_not_utf8) return true;
    if (!first_) first_ = FaultAt{fault, where, std::move(found)};
    return false;
  }
  const std::optional<FaultAt>& first() const { return first_; }

 private:
  std::optional<FaultAt> first_;
};

/// The faults of one file. A pass over hostile bytes may meet millions: what is kept is bounded.
class Faults final : public FaultSink {
 public:
  void add(Fault fault, const Where& where, std::string found = {}) {
    if (list_.size() < kMax) list_.push_back({fault, where, std::move(found)});
  }
  bool report(Fault fault, const Where& where, std::string found) override {
    add(fault, where, std::move(found));
    return true;
  }
  const std::vector<FaultAt>& list() const { return list_; }

 private:
  static constexpr std::size_t kMax = 10'000;
  std::vector<FaultAt> list_;
};

}  // namespace pstrips::inline core
