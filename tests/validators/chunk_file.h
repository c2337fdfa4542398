#pragma once

#include <string_view>
#include <vector>

#include "core/bytes.h"
#include "core/progressive_strips.h"
#include "formats/pstrip/container/chunks.h"
#include "formats/pstrip/container/header.h"

namespace pstrips::test {

/// A binary file as chunks that can be changed, moved and left out; padding and CRC come right by
/// themselves.
class ChunkFile {
 public:
  struct Item {
    ChunkType type{};
    Bytes payload;
    friend bool operator==(const Item&, const Item&) = default;
  };

  /// Precondition: `file` is whole.
  explicit ChunkFile(ByteView file);

  std::vector<Item>& items() { return items_; }
  /// Where the n-th chunk of the type stands in the list. Precondition: it is there.
  std::size_t find(std::string_view type, std::size_t n = 0) const;
  Bytes& payload(std::string_view type, std::size_t n = 0) { return items_[find(type, n)].payload; }

  /// Writes a value over the bytes of a payload.
  template <class T>
  void put(std::string_view type, std::size_t position, T value, std::size_t n = 0) {
    Bytes& bytes = payload(type, n);
    const auto view = std::as_bytes(std::span(&value, 1));
    std::copy(view.begin(), view.end(), bytes.begin() + static_cast<std::ptrdiff_t>(position));
  }
  template <class T>
  T get(std::string_view type, std::size_t position, std::size_t n = 0) {
    T value;
    std::memcpy(&value, payload(type, n).data() + position, sizeof value);
    return value;
  }

  /// What PIDX says; a row that was edited is in the file after write_rows().
  std::vector<IndexRow>& rows() { return rows_; }
  ChunkFile& write_rows();

  /// Brings offsets and sizes in PSHD and PIDX in line with where the chunks now stand.
  ChunkFile& settle();
  Bytes bytes() const;

 private:
  std::uint64_t end_of_index() const;
  void settle_rows();

  std::vector<Item> items_;
  std::vector<ProgressiveMesh> meshes_;  // as MESH describes them
  std::vector<IndexRow> rows_;
  std::uint64_t largest_ = 0;  // bytes of the largest BASE or PCKT, as decoder_memory counts it
};

}  // namespace pstrips::test
