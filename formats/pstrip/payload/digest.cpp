#include "formats/pstrip/payload/digest.h"

#include <algorithm>
#include <cassert>
#include <span>

namespace pstrips::inline formats {
namespace {

/// The canonical bytes, field by field.
class Canonical {
 public:
  explicit Canonical(Sha256& sha) : sha_(sha) {}

  void bytes(ByteView v) { sha_.add(v); }
  void u8(std::uint8_t v) { bytes(std::as_bytes(std::span(&v, 1))); }
  void u32(std::uint32_t v) { bytes(std::as_bytes(std::span(&v, 1))); }

  /// `value(i)` for each i below n, through a small block.
  template <class Value>
  void u32s(Index n, Value&& value) {
    std::array<Index, 1024> block;
    for (Index i = 0; i < n;) {
      std::size_t used = 0;
      while (used < block.size() && i < n) block[used++] = value(i++);
      bytes(std::as_bytes(std::span(block).first(used)));
    }
  }

 private:
  Sha256& sha_;
};

void add(Canonical& out, const Attribute& a) {
  out.u32(static_cast<std::uint32_t>(a.semantic.size()));
  out.bytes(as_bytes(a.semantic));
  out.u8(static_cast<std::uint8_t>(a.type));
  out.u8(a.count);
  out.u8(a.normalized ? 1 : 0);
  out.u8(0);
  out.bytes(a.data);
}

}  // namespace

Digest digest(const Mesh& decoded, Sha256& sha256) {
  assert(find_inconsistency(decoded).empty());
  const Mesh& m = decoded;
  Canonical out(sha256);
  out.bytes(as_bytes("PSTMESH1"));
  out.u32(m.vertex_count());
  out.u32(m.wedge_count());
  out.u32(m.face_count());
  out.u32(static_cast<std::uint32_t>(m.corners.size()));
  out.u32(static_cast<std::uint32_t>(m.wedge_attributes.size()));
  out.u32(static_cast<std::uint32_t>(m.face_attributes.size()));
  add(out, m.position);
  out.u32s(m.wedge_count(), [&](Index w) { return m.vertex_of(w); });
  for (const Attribute& a : m.wedge_attributes) add(out, a);
  out.u32s(m.face_count(), [&](Index f) { return static_cast<Index>(m.face(f).size()); });
  out.bytes(std::as_bytes(std::span(m.corners)));
  out.u32s(m.face_count(), [&](Index f) { return m.group_of(f); });
  for (const Attribute& a : m.face_attributes) add(out, a);
  return sha256.finish();
}

}  // namespace pstrips::inline formats
