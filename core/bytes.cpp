#include "core/bytes.h"

#include <algorithm>

namespace pstrips::inline core {

std::uint32_t ByteReader::count(std::size_t min_bytes_each) {
  assert(min_bytes_each > 0);
  const std::uint32_t n = u32();
  if (n <= remaining() / min_bytes_each) return n;
  fail(ErrorCode::truncated, "count exceeds the bytes left");
  return 0;
}

ByteView ByteReader::take(std::uint64_t size) {
  if (size > remaining()) fail(ErrorCode::truncated, "ends early");
  if (error_) return {};
  const ByteView out = bytes_.subspan(position_, static_cast<std::size_t>(size));
  position_ += static_cast<std::size_t>(size);
  return out;
}

std::string ByteReader::string(std::uint64_t max_bytes) {
  const std::uint32_t size = count(1);
  if (size > max_bytes) fail(ErrorCode::over_limit, "string longer than the limit");
  return std::string(as_text(take(size)));
}

void ByteReader::align(std::size_t alignment) {
  const std::size_t rest = position_ % alignment;
  if (rest == 0) return;
  const ByteView padding = take(alignment - rest);
  if (std::ranges::any_of(padding, [](std::byte b) { return b != std::byte{0}; }))
    fail(ErrorCode::corrupt, "padding is not zero");
}

}  // namespace pstrips::inline core
