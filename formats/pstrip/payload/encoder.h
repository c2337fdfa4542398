#pragma once

#include <memory>
#include <span>
#include <vector>

#include "formats/pstrip/container/chunk_table.h"
#include "formats/pstrip/container/header.h"
#include "formats/pstrip/payload/geometry_layout.h"

namespace pstrips::inline formats {

/// A chunk that a file gets.
struct PlannedChunk {
  ChunkType type{};
  std::size_t element = 0;    ///< the mesh, packet, image, entry or unknown chunk that it is of
  std::uint64_t offset = 0;   ///< of the chunk in the file
  std::uint64_t payload = 0;  ///< bytes
  std::uint64_t bytes() const { return chunk_bytes(payload); }
};

/// Writes the payloads of a file: all sizes and offsets are known once it is made.
///
/// strips  outlives the encoder
class PayloadEncoder {
 public:
  /// errors  what the profile cannot hold
  static Result<PayloadEncoder> start(const ProgressiveStrips& strips);

  /// In file order.
  const std::vector<PlannedChunk>& chunks() const { return chunks_; }
  const FileHeader& header() const { return header_; }

  /// payload  of chunk.payload bytes, all zero
  void write(const PlannedChunk& chunk, std::span<std::byte> payload) const;

 private:
  PayloadEncoder(const ProgressiveStrips& strips, std::unique_ptr<GeometryWriter> geometry);
  void size_rows();
  void plan_chunks();
  void plan(const ChunkType& type, std::size_t element);
  const Bytes* coded_faces(const ChunkType& type, std::size_t element) const;
  std::size_t elements(ChunkOf of) const;
  bool is_needed(const ChunkType& type, std::size_t element) const;
  void sum_totals();
  void fill_index();
  template <class Io>
  void fields(Io& io, const PlannedChunk& chunk) const;

  const ProgressiveStrips& strips_;
  std::unique_ptr<GeometryWriter> geometry_;
  std::vector<std::uint8_t> embedded_;  ///< one an image
  FileHeader header_;
  std::vector<IndexRow> rows_;
  std::vector<PlannedChunk> chunks_;
};

}  // namespace pstrips::inline formats
