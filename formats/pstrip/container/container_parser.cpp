#include "formats/pstrip/container/container_parser.h"

#include <algorithm>

#include "core/limits.h"
#include "formats/pstrip/container/chunk_table.h"
#include "formats/pstrip/container/header.h"

namespace pstrips::inline formats {

bool ContainerParser::feed(ByteView bytes, ChunkSink& sink) {
  taken_ += bytes.size();
  std::size_t used = 0;
  while (!pending_.empty() && !bytes.empty()) {
    const std::size_t more = std::min(bytes.size(), bytes_to_whole());
    pending_.insert(pending_.end(), bytes.begin(),
                    bytes.begin() + static_cast<std::ptrdiff_t>(more));
    bytes = bytes.subspan(more);
    if (!parse(pending_, sink, used)) return false;
    if (used != 0) pending_.clear();  // never filled past the end of a chunk
  }
  if (bytes.empty()) return true;
  if (!parse(bytes, sink, used)) return false;
  const ByteView rest = bytes.subspan(used);
  pending_.assign(rest.begin(), rest.end());
  return true;
}

std::size_t ContainerParser::bytes_to_whole() const {
  std::uint64_t whole = kChunkHeaderBytes;  // the signature is as long as a chunk header
  if (pending_.size() >= kChunkHeaderBytes) whole = read_chunk_head(pending_).chunk_bytes();
  return static_cast<std::size_t>(whole - pending_.size());
}

bool ContainerParser::parse(ByteView bytes, ChunkSink& sink, std::size_t& used) {
  used = 0;
  if (offset_ == 0) {
    if (!starts_with_signature(bytes)) {
      report(Fault::signature, sink);
      return false;
    }
    if (bytes.size() < kSignature.size()) return true;
    used = kSignature.size();
    offset_ = kSignature.size();
  }
  while (used < bytes.size()) {
    if (complete_) {
      report(Fault::bytes_after_end, sink);
      return false;
    }
    const ByteView left = bytes.subspan(used);
    if (left.size() < kChunkHeaderBytes) break;
    const ChunkHead head = read_chunk_head(left);
    if (!head_taken_ && !take_head(head, sink)) return false;
    head_taken_ = true;
    if (head.chunk_bytes() > left.size()) break;
    if (!take_chunk(read_chunk(left, chunks_, offset_), sink)) return false;
    used += static_cast<std::size_t>(head.chunk_bytes());
  }
  return true;
}

bool ContainerParser::take_head(const ChunkHead& head, ChunkSink& sink) {
  if (const Fault fault = head.fault(); fault != Fault::none) {
    report(fault, sink);
    return false;
  }
  if (order_holds_) {
    ChunkOrder::Broken broken = order_.add(head.type);
    order_holds_ = broken.fault == Fault::none;
    if (!order_holds_ && !sink.report(broken.fault, here(), std::move(broken.found))) return false;
  }
  if (chunks_ == 0 && head.type == kHeaderChunk && head.payload_bytes != kHeaderBytes) {
    report(Fault::payload_length, sink);
    return false;
  }
  if (file_bytes_ && offset_ + head.chunk_bytes() > *file_bytes_ &&
      !report(Fault::past_file_bytes, sink))
    return false;
  const std::uint64_t payloads = payload_bytes_ + head.payload_bytes;
  if (payloads <= max_payload_bytes_) return true;
  report(Fault::over_limit, sink,
         over_limit_message(payloads, "bytes of chunks", max_payload_bytes_));
  return false;
}

bool ContainerParser::take_chunk(const Chunk& chunk, ChunkSink& sink) {
  if (!chunk.crc_ok() && !sink.report(Fault::chunk_crc, here(), {})) return false;
  if (!chunk.padding_is_zero && !sink.report(Fault::chunk_padding, here(), {})) return false;
  if (!is_known(chunk.type) && is_critical(chunk.type) &&
      !sink.report(Fault::critical_chunk_unknown, here(), {}))
    return false;
  if (!sink.take(chunk)) return false;
  head_taken_ = false;
  ++chunks_;
  payload_bytes_ += chunk.payload.size();
  offset_ += chunk.bytes();
  complete_ = chunk.type == kEndChunk;
  return !complete_ || !file_bytes_ || offset_ == *file_bytes_ || report(Fault::file_bytes, sink);
}

}  // namespace pstrips::inline formats
