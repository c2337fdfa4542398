#include "codecs/vsplit/in_order.h"

#include <cstring>

namespace pstrips::inline codecs {
namespace {

template <std::size_t kBytes>
void gather(const std::byte* from, std::span<const Index> order, std::byte* to) {
  for (const Index i : order) {
    std::memcpy(to, from + std::size_t{i} * kBytes, kBytes);
    to += kBytes;
  }
}

}  // namespace

Attribute in_order(const Attribute& from, std::span<const Index> order) {
  Attribute out{from.semantic, from.type, from.count, from.normalized, {}};
  const std::size_t bytes = from.element_bytes();
  out.data.resize(order.size() * bytes);
  const std::byte* source = from.data.data();
  std::byte* to = out.data.data();
  switch (bytes) {
    case 4:
      gather<4>(source, order, to);
      break;
    case 8:
      gather<8>(source, order, to);
      break;
    case 12:
      gather<12>(source, order, to);
      break;
    default:
      for (std::size_t i = 0; i < order.size(); ++i)
        std::memcpy(to + i * bytes, source + order[i] * bytes, bytes);
  }
  return out;
}

}  // namespace pstrips::inline codecs
