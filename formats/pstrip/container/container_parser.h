#pragma once

#include <cstdint>
#include <optional>

#include "core/bytes.h"
#include "formats/pstrip/container/chunk_order.h"
#include "formats/pstrip/container/chunks.h"

namespace pstrips::inline formats {

/// What a ContainerParser brings. A chunk with a fault that did not stop the sink is brought too.
class ChunkSink : public FaultSink {
 public:
  /// A whole chunk; its payload is gone after the call. False stops the parser.
  virtual bool take(const Chunk& chunk) = 0;

 protected:
  ~ChunkSink() = default;
};

/// Takes the binary variant apart as its bytes arrive: signature, frames, CRC and the order of the
/// chunks. Payloads are the sink's business. At most one chunk is buffered.
class ContainerParser {
 public:
  /// max_payload_bytes  of all chunks together; more is Fault::over_limit
  explicit ContainerParser(std::uint64_t max_payload_bytes = ~std::uint64_t{0})
      : max_payload_bytes_(max_payload_bytes) {}

  /// What PSHD declares; the sink that reads it says so.
  void declare_size(std::uint64_t file_bytes) { file_bytes_ = file_bytes; }
  void declare_chunks(std::uint32_t meshes, std::uint32_t packets) {
    order_.declare(meshes, packets);
  }

  /// Takes the next bytes of the file. False when the sink has stopped or nothing more can be made
  /// of the bytes; then nothing more may be fed.
  bool feed(ByteView bytes, ChunkSink& sink);

  bool complete() const { return complete_; }       ///< PEND is there
  std::uint64_t offset() const { return offset_; }  ///< of the first byte not parsed
  std::uint64_t bytes_taken() const { return taken_; }

 private:
  /// How many bytes `pending_` lacks to the end of its chunk, or of the chunk's head. At least 1.
  std::size_t bytes_to_whole() const;
  /// Parses whole chunks off the front of `bytes`; `used` becomes how many bytes that were.
  bool parse(ByteView bytes, ChunkSink& sink, std::size_t& used);
  bool take_head(const ChunkHead& head, ChunkSink& sink);
  bool take_chunk(const Chunk& chunk, ChunkSink& sink);
  bool report(Fault fault, ChunkSink& sink, std::string found = {}) const {
    return sink.report(fault, {.field = Field::file, .element = offset_}, std::move(found));
  }
  Where here() const { return {.field = Field::chunk, .element = chunks_}; }

  std::uint64_t max_payload_bytes_;
  std::optional<std::uint64_t> file_bytes_;
  ChunkOrder order_;
  bool order_holds_ = true;
  bool head_taken_ = false;  ///< of the chunk at offset_
  bool complete_ = false;
  std::uint64_t chunks_ = 0;         ///< taken so far
  std::uint64_t payload_bytes_ = 0;  ///< of them
  std::uint64_t taken_ = 0;          ///< bytes fed
  std::uint64_t offset_ = 0;
  Bytes pending_;  ///< the start of a chunk that is not whole yet
};

}  // namespace pstrips::inline formats
