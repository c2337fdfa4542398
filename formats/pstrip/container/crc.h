#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include "core/bytes.h"

namespace pstrips::inline formats {

/// The CRC-32 of PNG and zlib: zlib's, or in a build with PSTRIPS_WITHOUT_ZLIB the one below.
std::uint32_t crc32_of(ByteView bytes);

/// The same from tables alone, eight bytes at a step, for builds that have no zlib.
class Crc32Tables {
 public:
  constexpr Crc32Tables() {
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
      std::uint32_t crc = byte;
      for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1) != 0 ? kPolynomial : 0);
      tables_[0][byte] = crc;
    }
    // Table k has the CRC of a byte that k zero bytes follow.
    for (std::size_t k = 1; k < kStep; ++k)
      for (std::size_t byte = 0; byte < 256; ++byte) {
        const std::uint32_t before = tables_[k - 1][byte];
        tables_[k][byte] = before >> 8 ^ tables_[0][before & 0xff];
      }
  }

  std::uint32_t operator()(ByteView bytes) const {
    std::uint32_t crc = ~std::uint32_t{0};
    for (; bytes.size() >= kStep; bytes = bytes.subspan(kStep)) {
      std::uint64_t block = 0;
      std::memcpy(&block, bytes.data(), kStep);
      block ^= crc;
      crc = 0;
      for (std::size_t i = 0; i < kStep; ++i) crc ^= tables_[kStep - 1 - i][block >> 8 * i & 0xff];
    }
    for (const std::byte b : bytes)
      crc = crc >> 8 ^ tables_[0][(crc ^ std::to_integer<std::uint32_t>(b)) & 0xff];
    return ~crc;
  }

 private:
  static constexpr std::uint32_t kPolynomial = 0xedb8'8320;  // reflected
  static constexpr std::size_t kStep = 8;
  std::array<std::array<std::uint32_t, 256>, kStep> tables_{};
};
inline constexpr Crc32Tables crc32_by_tables{};

}  // namespace pstrips::inline formats
