#pragma once

#include <cstdint>

#include "core/bytes.h"

namespace pstrips::inline formats {

/// The CRC-32 of PNG and zlib: zlib's, or in a build with PSTRIPS_WITHOUT_ZLIB the one below.
std::uint32_t crc32_of(ByteView bytes);

/// The same from tables alone, eight bytes at a step, for builds that have no zlib.
std::uint32_t crc32_by_tables(ByteView bytes);

}  // namespace pstrips::inline formats
