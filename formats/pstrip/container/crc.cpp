#include "formats/pstrip/container/crc.h"

#include <array>
#include <cstring>

#ifndef PSTRIPS_WITHOUT_ZLIB
#include <zlib.h>
#endif

namespace pstrips::inline formats {
namespace {

constexpr std::uint32_t kPolynomial = 0xedb8'8320;  // reflected
constexpr std::size_t kStep = 8;
using Tables = std::array<std::array<std::uint32_t, 256>, kStep>;

Tables make_tables() {
  Tables out;
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1) != 0 ? kPolynomial : 0);
    out[0][byte] = crc;
  }
  // Table k has the CRC of a byte that k zero bytes follow.
  for (std::size_t k = 1; k < kStep; ++k)
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t before = out[k - 1][byte];
      out[k][byte] = before >> 8 ^ out[0][before & 0xff];
    }
  return out;
}

}  // namespace

std::uint32_t crc32_of(ByteView bytes) {
#ifdef PSTRIPS_WITHOUT_ZLIB
  return crc32_by_tables(bytes);
#else
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
#endif
}

std::uint32_t crc32_by_tables(ByteView bytes) {
  // Made when first needed: a browser would download them otherwise.
  static const Tables tables = make_tables();
  std::uint32_t crc = ~std::uint32_t{0};
  for (; bytes.size() >= kStep; bytes = bytes.subspan(kStep)) {
    std::uint64_t block = 0;
    std::memcpy(&block, bytes.data(), kStep);
    block ^= crc;
    crc = 0;
    for (std::size_t i = 0; i < kStep; ++i) crc ^= tables[kStep - 1 - i][block >> 8 * i & 0xff];
  }
  for (const std::byte b : bytes)
    crc = crc >> 8 ^ tables[0][(crc ^ std::to_integer<std::uint32_t>(b)) & 0xff];
  return ~crc;
}

}  // namespace pstrips::inline formats
