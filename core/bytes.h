#pragma once

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace pstrips::inline core {

// Arrays are copied between files and memory as they are.
static_assert(std::endian::native == std::endian::little, "pstrips needs a little-endian host");

using Bytes = std::vector<std::byte>;
using ByteView = std::span<const std::byte>;

inline ByteView as_bytes(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}
inline std::string_view as_text(ByteView bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Reads little-endian fields from untrusted bytes. The first failure stays: later reads return
/// zero or nothing. So a parser reads in a straight line and looks at `error()` once, at its end.
class ByteReader {
 public:
  /// bytes        must outlive the reader and every span it hands out
  /// base_offset  added to each position in errors, for a reader over a part of a file
  explicit ByteReader(ByteView bytes, std::uint64_t base_offset = 0)
      : bytes_(bytes), base_offset_(base_offset) {}

  std::uint8_t u8() { return number<std::uint8_t>(); }
  std::uint16_t u16() { return number<std::uint16_t>(); }
  std::uint32_t u32() { return number<std::uint32_t>(); }
  std::uint64_t u64() { return number<std::uint64_t>(); }
  float f32() { return std::bit_cast<float>(u32()); }
  double f64() { return std::bit_cast<double>(u64()); }

  /// An element count, checked against the bytes left so that the caller may allocate that many
  /// elements. Precondition: min_bytes_each > 0.
  std::uint32_t count(std::size_t min_bytes_each);

  /// The next `size` bytes, or nothing with error truncated.
  ByteView take(std::uint64_t size);

  /// Copies `count` elements of T. Fails before it allocates when the bytes are not there.
  template <class T>
  std::vector<T> array(std::uint64_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (count > remaining() / sizeof(T)) {
      fail(ErrorCode::truncated, "ends inside an array");
      return {};
    }
    const ByteView bytes = take(count * sizeof(T));
    std::vector<T> out(error_ ? 0 : count);
    if (!out.empty()) std::memcpy(out.data(), bytes.data(), bytes.size());
    return out;
  }

  /// A string of a u32 byte count and that many bytes of UTF-8 (not checked here).
  std::string string(std::uint64_t max_bytes);

  /// Skips to the next multiple of `alignment` (counted from the start of `bytes`); the skipped
  /// bytes must be zero.
  void align(std::size_t alignment);

  void expect_end() {
    if (remaining() != 0) fail(ErrorCode::corrupt, "has bytes after its end");
  }
  void fail(ErrorCode code, std::string_view message) {
    if (!error_) error_ = Error{code, std::string(message), offset()};
  }

  std::size_t position() const { return position_; }
  std::uint64_t offset() const { return base_offset_ + position_; }
  std::size_t remaining() const { return error_ ? 0 : bytes_.size() - position_; }
  const std::optional<Error>& error() const { return error_; }

 private:
  template <class T>
  T number() {
    const ByteView bytes = take(sizeof(T));
    T value{};
    if (!error_) std::memcpy(&value, bytes.data(), sizeof(T));
    return value;
  }

  ByteView bytes_;
  std::uint64_t base_offset_;
  std::size_t position_ = 0;
  std::optional<Error> error_;
};

/// Appends little-endian fields to a growing buffer.
class ByteWriter {
 public:
  /// Memory for that many bytes in all, so that they are not moved while they grow.
  void reserve(std::size_t size) { bytes_.reserve(size); }
  void u8(std::uint8_t v) { bytes_.push_back(std::byte{v}); }
  void u16(std::uint16_t v) { number(v); }
  void u32(std::uint32_t v) { number(v); }
  void u64(std::uint64_t v) { number(v); }
  void f32(float v) { u32(std::bit_cast<std::uint32_t>(v)); }
  void f64(double v) { u64(std::bit_cast<std::uint64_t>(v)); }
  void bytes(ByteView v) { bytes_.insert(bytes_.end(), v.begin(), v.end()); }
  template <class T>
  void array(std::span<const T> v) {
    bytes(std::as_bytes(v));
  }
  void string(std::string_view v) {
    u32(static_cast<std::uint32_t>(v.size()));
    bytes(as_bytes(v));
  }
  /// Pads with zeros to a multiple of `alignment`.
  void align(std::size_t alignment) {
    bytes_.resize((bytes_.size() + alignment - 1) / alignment * alignment);
  }
  void patch_u32(std::size_t position, std::uint32_t v) {
    assert(position + sizeof v <= bytes_.size());
    std::memcpy(bytes_.data() + position, &v, sizeof v);
  }

  std::size_t size() const { return bytes_.size(); }
  ByteView view() const { return bytes_; }
  Bytes take() && { return std::move(bytes_); }

 private:
  template <class T>
  void number(T v) {
    const auto* p = reinterpret_cast<const std::byte*>(&v);
    bytes_.insert(bytes_.end(), p, p + sizeof v);
  }
  Bytes bytes_;
};

}  // namespace pstrips::inline core
