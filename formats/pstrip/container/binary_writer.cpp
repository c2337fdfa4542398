#include <algorithm>
#include <cassert>
#include <cstring>

#include "formats/pstrip/container/binary.h"
#include "formats/pstrip/container/chunks.h"
#include "formats/pstrip/payload/check.h"
#include "formats/pstrip/payload/encoder.h"

namespace pstrips::inline formats {
namespace {

/// The whole chunk, in a buffer that is used for one after the other.
void write_chunk(const PayloadEncoder& encoder, const PlannedChunk& chunk, Bytes& buffer) {
  buffer.assign(static_cast<std::size_t>(chunk.bytes()), std::byte{0});
  const std::span<std::byte> whole(buffer);
  const auto length = static_cast<std::uint32_t>(chunk.payload);
  std::memcpy(whole.data(), chunk.type.data(), 4);
  std::memcpy(whole.data() + 4, &length, 4);
  encoder.write(chunk, whole.subspan(kChunkHeaderBytes, length));
  const std::uint32_t crc = chunk_crc(whole.first(whole.size() - 4));
  std::memcpy(whole.data() + whole.size() - 4, &crc, 4);
}

Result<void> write_chunks(const PayloadEncoder& encoder, ByteSink& out) {
  if (std::ranges::any_of(encoder.chunks(), [](const PlannedChunk& chunk) {
        return chunk.payload > kMaxPayloadBytes;
      }))
    return fail(ErrorCode::over_limit, "a chunk would exceed 2^31 - 1 bytes");
  if (Result<void> ok = out.write(kSignature); !ok) return ok;
  Bytes buffer;
  for (const PlannedChunk& chunk : encoder.chunks()) {
    write_chunk(encoder, chunk, buffer);
    if (Result<void> ok = out.write(buffer); !ok) return ok;
  }
  return {};
}

}  // namespace

Result<void> write_binary(const ProgressiveStrips& strips, ByteSink& out) {
  assert(strips.complete && check(strips));
  const Result<PayloadEncoder> encoder = PayloadEncoder::start(strips);
  if (!encoder) return tl::unexpected<Error>(encoder.error());
  return write_chunks(*encoder, out);
}

Result<Bytes> write_binary(const ProgressiveStrips& strips) {
  assert(strips.complete && check(strips));
  return write_binary_unchecked(strips);
}

Result<Bytes> write_binary_unchecked(const ProgressiveStrips& strips) {
  const Result<PayloadEncoder> encoder = PayloadEncoder::start(strips);
  if (!encoder) return tl::unexpected<Error>(encoder.error());
  BytesSink out;
  out.reserve(encoder->header().file_bytes);
  if (const Result<void> ok = write_chunks(*encoder, out); !ok)
    return tl::unexpected<Error>(ok.error());
  return std::move(out).take();
}

}  // namespace pstrips::inline formats
