#include "formats/pstrip/container/crc.h"

#ifndef PSTRIPS_WITHOUT_ZLIB
#include <zlib.h>
#endif

namespace pstrips::inline formats {

std::uint32_t crc32_of(ByteView bytes) {
#ifdef PSTRIPS_WITHOUT_ZLIB
  return crc32_by_tables(bytes);
#else
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
#endif
}

}  // namespace pstrips::inline formats
