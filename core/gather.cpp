#include "core/gather.h"

#include <cstring>

namespace pstrips::inline core {
namespace {

template <std::size_t kBytes>
void copy_rows(const std::byte* from, std::span<const Index> rows, std::byte* to) {
  for (const Index i : rows) {
    std::memcpy(to, from + std::size_t{i} * kBytes, kBytes);
    to += kBytes;
  }
}

}  // namespace

Bytes gather(ByteView table, std::size_t element_bytes, std::span<const Index> rows) {
  Bytes out(rows.size() * element_bytes);
  const std::byte* const from = table.data();
  std::byte* const to = out.data();
  switch (element_bytes) {
    case 4:
      copy_rows<4>(from, rows, to);
      break;
    case 8:
      copy_rows<8>(from, rows, to);
      break;
    case 12:
      copy_rows<12>(from, rows, to);
      break;
    default:
      for (std::size_t i = 0; i < rows.size(); ++i)
        std::memcpy(to + i * element_bytes, from + rows[i] * element_bytes, element_bytes);
  }
  return out;
}

Attribute gather(const Attribute& attribute, std::span<const Index> rows) {
  Attribute out = attribute.format();
  out.data = gather(attribute.data, attribute.element_bytes(), rows);
  return out;
}

}  // namespace pstrips::inline core
