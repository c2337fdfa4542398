#include "formats/pstrip/payload/digest.h"

#include <openssl/evp.h>

#include <algorithm>
#include <cassert>
#include <memory>
#include <new>
#include <vector>

namespace pstrips::inline formats {
namespace {

class Sha256 {
 public:
  // Fails only when OpenSSL cannot allocate or has no SHA-256 at all.
  Sha256() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
    if (!context_ || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1)
      throw std::bad_alloc();
  }

  void bytes(ByteView v) { EVP_DigestUpdate(context_.get(), v.data(), v.size()); }
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

  Digest finish() {
    Digest out;
    EVP_DigestFinal_ex(context_.get(), reinterpret_cast<unsigned char*>(out.data()), nullptr);
    return out;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

void add(Sha256& sha, const Attribute& a) {
  sha.u32(static_cast<std::uint32_t>(a.semantic.size()));
  sha.bytes(as_bytes(a.semantic));
  sha.u8(static_cast<std::uint8_t>(a.type));
  sha.u8(a.count);
  sha.u8(a.normalized ? 1 : 0);
  sha.u8(0);
  sha.bytes(a.data);
}

}  // namespace

Digest digest(const Mesh& decoded) {
  assert(find_inconsistency(decoded).empty());
  const Mesh& m = decoded;
  Sha256 sha;
  sha.bytes(as_bytes("PSTMESH1"));
  sha.u32(m.vertex_count());
  sha.u32(m.wedge_count());
  sha.u32(m.face_count());
  sha.u32(static_cast<std::uint32_t>(m.corners.size()));
  sha.u32(static_cast<std::uint32_t>(m.wedge_attributes.size()));
  sha.u32(static_cast<std::uint32_t>(m.face_attributes.size()));
  add(sha, m.position);
  sha.u32s(m.wedge_count(), [&](Index w) { return m.vertex_of(w); });
  for (const Attribute& a : m.wedge_attributes) add(sha, a);
  sha.u32s(m.face_count(), [&](Index f) { return static_cast<Index>(m.face(f).size()); });
  sha.bytes(std::as_bytes(std::span(m.corners)));
  sha.u32s(m.face_count(), [&](Index f) { return m.group_of(f); });
  for (const Attribute& a : m.face_attributes) add(sha, a);
  return sha.finish();
}

}  // namespace pstrips::inline formats
