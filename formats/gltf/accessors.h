#pragma once

#include <map>
#include <vector>

#include "formats/gltf/document.h"
#include "formats/gltf/gltf.h"

namespace pstrips::inline formats::gltf {

/// What a reader may still allocate.
class Budget {
 public:
  explicit Budget(const Limits& limits)
      : limit_(limits.memory_bytes), left_(limit_), zeros_left_(limit_ / 64) {}

  bool take(std::uint64_t bytes) {
    if (bytes > left_) return false;
    left_ -= bytes;
    return true;
  }
  /// Why take() said no.
  std::string refusal(std::uint64_t bytes) const {
    return over_limit_message(limit_ - left_ + bytes, "bytes of memory", limit_);
  }
  /// For elements that no byte of the file backs; a count costs nothing there, so the share is
  /// small.
  bool take_zeros(std::uint64_t bytes) {
    if (bytes > zeros_left_) return false;
    zeros_left_ -= bytes;
    return take(bytes);
  }

 private:
  std::uint64_t limit_, left_, zeros_left_;
};

/// The bytes behind a document's accessors and views. Buffers are loaded when first used.
class Data {
 public:
  /// All must outlive this. `bin` is buffer 0 when that names no URI.
  Data(Document& document, std::optional<ByteView> bin, const ReadFile& read_file, Budget& budget);

  /// A part of a view. errors: corrupt, truncated, unsupported, over_limit, those of read_file
  Result<ByteView> range(Index view, std::uint64_t offset, std::uint64_t bytes);
  /// Takes over the elements of an accessor that has no bytes of its own. errors: over_limit
  Result<void> give(Index accessor, Bytes elements);
  /// All elements, packed: strides gone, sparse values in place, matrix columns padded.
  Result<Bytes> elements(Index accessor);

 private:
  Result<ByteView> buffer(Index i);
  bool has_bytes(Index buffer) const;
  Result<ByteView> decoded_view(Index i);
  Result<void> copy_elements(const Accessor& accessor, Bytes& out);
  Result<void> put_sparse_values(const Accessor& accessor, Bytes& out);

  Document& document_;
  std::optional<ByteView> bin_;
  const ReadFile& read_file_;
  Budget& budget_;
  std::vector<std::optional<Bytes>> loaded_;
  std::map<Index, Bytes> decoded_views_;
  std::map<Index, Bytes> given_;  ///< by accessor
};

/// Elements of an attribute: as Data::elements, without the padding of matrix columns.
Result<Bytes> read_attribute(Data& data, const Document& document, Index accessor);

/// Vertex indices. errors: corrupt when one is not below `vertices` or the accessor is no list of
/// unsigned integers
Result<std::vector<Index>> read_indices(Data& data, const Document& document, Index accessor,
                                        std::uint64_t vertices);

}  // namespace pstrips::inline formats::gltf
