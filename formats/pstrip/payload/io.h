#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <type_traits>

#include "core/bytes.h"
#include "core/fault_list.h"
#include "core/mesh.h"
#include "core/text.h"
#include "formats/pstrip/container/chunks.h"
#include "formats/pstrip/container/part.h"

// What happens to the fields of a payload that a function of layout.h names: ReadIo fills them,
// WriteIo writes them, SizeIo adds up their bytes, PartIo notes which bytes belong to what,
// LocateIo finds the bytes of one.

namespace pstrips::inline formats::layout {

inline constexpr std::size_t kArrayAlignment = 8;

// Packed arrays: numbers of `bits` bits each, at most 32, lowest bit first, without gaps.
// [spec/container.md §8.2]

constexpr std::uint64_t packed_bytes(unsigned bits, std::uint64_t n) { return (n * bits + 7) / 8; }

/// What a permutation of n elements needs for each.
constexpr unsigned permutation_bits(Index n) {
  return n == 0 ? 0 : static_cast<unsigned>(std::bit_width(n - 1));
}

/// Precondition: out has packed_bytes() for the numbers, all zero, and each fits.
template <class T>
void pack(const std::vector<T>& numbers, unsigned bits, std::span<std::byte> out) {
  std::uint64_t window = 0;
  unsigned filled = 0;
  std::size_t at = 0;
  for (const T number : numbers) {
    assert(static_cast<unsigned>(std::bit_width(number)) <= bits);
    window |= std::uint64_t{number} << filled;
    for (filled += bits; filled >= 8; filled -= 8, window >>= 8)
      out[at++] = static_cast<std::byte>(window & 0xff);
  }
  if (filled > 0) out[at] = static_cast<std::byte>(window);
}

/// Precondition: bytes.size() == packed_bytes(bits, n).
template <class T>
std::vector<T> unpack(ByteView bytes, unsigned bits, std::uint64_t n) {
  std::vector<T> out(n);
  std::uint64_t window = 0;
  unsigned filled = 0;
  std::size_t at = 0;
  for (T& number : out) {
    for (; filled < bits; filled += 8)
      window |= std::to_integer<std::uint64_t>(bytes[at++]) << filled;
    number = static_cast<T>(window & ((std::uint64_t{1} << bits) - 1));
    window >>= bits;
    filled -= bits;
  }
  return out;
}

/// Whether the bits after the last number are zero.
inline bool ends_in_zeros(ByteView bytes, unsigned bits, std::uint64_t n) {
  const auto used = static_cast<unsigned>(n * bits % 8);
  return used == 0 || std::to_integer<unsigned>(bytes.back()) >> used == 0;
}

// Varints: seven bits a byte, low ones first; the top bit says that more follow.
// [spec/container.md]

/// Bytes of a number.
constexpr std::uint64_t varint_bytes(std::uint64_t number) {
  return number == 0 ? 1 : (static_cast<unsigned>(std::bit_width(number)) + 6) / 7;
}

/// Calls put(byte) for each.
template <class Put>
void put_varint(std::uint64_t number, Put&& put) {
  for (; number >= 0x80; number >>= 7) put(static_cast<std::byte>((number & 0x7f) | 0x80));
  put(static_cast<std::byte>(number));
}

/// Adds up bytes. Counts from a file are safe here: no product of 32-bit counts and 8-bit sizes
/// leaves 64 bits.
class SizeIo {
 public:
  static constexpr bool kReads = false;

  template <class T>
  void number(const T&) {
    skip(sizeof(T));
  }
  void varint(std::uint64_t v, unsigned) { skip(varint_bytes(v)); }
  template <class E>
  void choice(const E&, std::uint8_t, Fault = {}) {
    skip(1);
  }
  void zeros(std::size_t n) { skip(n); }
  void string(const std::string& s) { skip(4 + s.size()); }
  template <class T>
  const std::vector<T>& list(const std::vector<T>& v, std::size_t) {
    skip(4);
    return v;
  }
  template <class T>
  void run(const std::vector<T>&, std::size_t, std::uint64_t n) {
    skip(n * sizeof(T));
  }
  void run(const Attribute& a, std::size_t, std::uint64_t n) { skip(n * a.element_bytes()); }
  void run(const Bytes&, std::size_t element, std::size_t, std::uint64_t n) { skip(n * element); }
  template <class S, class T>
  void column(const std::vector<S>&, T S::*, std::size_t, std::uint64_t n) {
    skip(n * sizeof(T));
  }
  template <class T>
  void packed(const std::vector<T>&, unsigned bits, std::uint64_t n) {
    skip(packed_bytes(bits, n));
  }
  void rest(const Bytes& bytes) { skip(bytes.size()); }
  void align() { size_ = (size_ + kArrayAlignment - 1) / kArrayAlignment * kArrayAlignment; }
  void part(Part) {}

  std::uint64_t size() const { return size_; }

 private:
  void skip(std::uint64_t n) { size_ += n; }
  std::uint64_t size_ = 0;
};

/// Writes into a buffer of exactly the right size that holds zeros.
class WriteIo {
 public:
  static constexpr bool kReads = false;

  explicit WriteIo(std::span<std::byte> out) : out_(out) {}

  template <class T>
  void number(const T& v) {
    static_assert(std::is_arithmetic_v<T>);
    put(&v, sizeof v);
  }
  void varint(std::uint64_t v, unsigned) {
    put_varint(v, [&](std::byte b) { put(&b, 1); });
  }
  template <class E>
  void choice(const E& v, std::uint8_t, Fault = {}) {
    number(static_cast<std::uint8_t>(v));
  }
  void zeros(std::size_t n) { at_ += n; }
  void string(const std::string& s) {
    number(static_cast<std::uint32_t>(s.size()));
    put(s.data(), s.size());
  }
  template <class T>
  const std::vector<T>& list(const std::vector<T>& v, std::size_t) {
    number(static_cast<std::uint32_t>(v.size()));
    return v;
  }
  template <class T>
  void run(const std::vector<T>& v, std::size_t first, std::uint64_t n) {
    assert(first + n <= v.size());
    put(v.data() + first, n * sizeof(T));
  }
  void run(const Attribute& a, std::size_t first, std::uint64_t n) {
    run(a.data, a.element_bytes(), first, n);
  }
  void run(const Bytes& data, std::size_t element, std::size_t first, std::uint64_t n) {
    run(data, first * element, n * element);
  }
  template <class S, class T>
  void column(const std::vector<S>& v, T S::*field, std::size_t first, std::uint64_t n) {
    assert(first + n <= v.size());
    for (std::size_t i = first; i < first + n; ++i) number(v[i].*field);
  }
  template <class T>
  void packed(const std::vector<T>& v, unsigned bits, std::uint64_t n) {
    assert(v.size() == n);
    const std::uint64_t size = packed_bytes(bits, n);
    assert(at_ + size <= out_.size());
    pack(v, bits, out_.subspan(at_, size));
    at_ += size;
  }
  void rest(const Bytes& bytes) { put(bytes.data(), bytes.size()); }
  void align() { at_ = (at_ + kArrayAlignment - 1) / kArrayAlignment * kArrayAlignment; }
  void part(Part) {}

 private:
  void put(const void* from, std::size_t n) {
    assert(at_ + n <= out_.size());
    if (n != 0) std::memcpy(out_.data() + at_, from, n);
    at_ += n;
  }
  std::span<std::byte> out_;
  std::size_t at_ = 0;
};

/// Notes the parts of a payload from its counts alone.
class PartIo : public SizeIo {
 public:
  struct Mark {
    Part part;
    std::uint64_t position;  ///< in the payload
  };
  void part(Part p) { marks_.push_back({p, size()}); }
  const std::vector<Mark>& marks() const { return marks_; }

 private:
  std::vector<Mark> marks_;
};

template <class F>
std::uint64_t size_of_fields(F&& fields) {
  SizeIo io;
  fields(io);
  return io.size();
}

/// Fills structures from a payload. Arrays are appended to what is there: `first` must be the
/// array's size. What breaks a demand goes to the sink; reading goes on where the sink does and the
/// fields after keep their meaning.
class ReadIo {
 public:
  static constexpr bool kReads = true;

  ReadIo(const Chunk& chunk, std::uint64_t max_string_bytes, FaultSink& faults)
      : in_(chunk.payload, chunk.payload_offset()),
        chunk_offset_(chunk.offset),
        max_string_bytes_(max_string_bytes),
        faults_(faults) {}

  template <class T>
  void number(T& v) {
    static_assert(std::is_arithmetic_v<T>);
    const ByteView bytes = in_.take(sizeof v);
    if (bytes.size() == sizeof v) std::memcpy(&v, bytes.data(), sizeof v);
  }
  /// A number of at most `bits` bits, in its shortest form.
  template <class T>
  void varint(T& v, unsigned bits, Fault otherwise = Fault::payload_length) {
    const std::uint64_t start = in_.offset();
    std::uint64_t number = 0;
    for (unsigned at = 0; at < bits; at += 7) {
      const std::uint8_t byte = in_.u8();
      number |= std::uint64_t{byte & 0x7fu} << at;
      if (byte >= 0x80) continue;
      if ((byte == 0 && at > 0) || number >> bits != 0) break;
      v = static_cast<T>(number);
      return;
    }
    if (in_.error()) return;
    report(otherwise, start);
    failed_ = true;
  }
  /// An enumeration or flag: one byte below `values`.
  template <class E>
  void choice(E& v, std::uint8_t values, Fault otherwise = Fault::value_undefined) {
    const std::uint64_t at = in_.offset();
    const std::uint8_t n = in_.u8();
    if (n < values) {
      v = static_cast<E>(n);
      return;
    }
    if (in_.error()) return;
    report(otherwise, at, std::to_string(n));
    failed_ = true;
  }
  void zeros(std::size_t n) { check_zeros(n, Fault::reserved_not_zero); }
  void string(std::string& s) {
    const std::uint64_t at = in_.offset();
    s = in_.string(max_string_bytes_);
    if (const std::size_t bad = first_not_utf8(s); bad < s.size())
      report(Fault::string_not_utf8, at + sizeof(std::uint32_t) + bad);
  }
  template <class T>
  std::vector<T>& list(std::vector<T>& v, std::size_t min_bytes_each) {
    v.resize(in_.count(min_bytes_each));
    return v;
  }
  template <class T>
  void run(std::vector<T>& v, std::size_t first, std::uint64_t n) {
    if (first == 0 && n == 0) return;
    assert(first == v.size());
    const ByteView bytes = take(n, sizeof(T));
    if (bytes.empty()) return;
    v.resize(first + n);
    std::memcpy(v.data() + first, bytes.data(), bytes.size());
  }
  void run(Attribute& a, std::size_t first, std::uint64_t n) {
    run(a.data, a.element_bytes(), first, n);
  }
  void run(Bytes& data, std::size_t element, [[maybe_unused]] std::size_t first, std::uint64_t n) {
    assert(data.size() == first * element);
    const ByteView bytes = take(n, element);
    data.insert(data.end(), bytes.begin(), bytes.end());
  }
  template <class S, class T>
  void column(std::vector<S>& v, T S::*field, std::size_t first, std::uint64_t n) {
    const ByteView bytes = take(n, sizeof(T));
    if (bytes.empty()) return;
    if (v.size() < first + n) v.resize(first + n);
    for (std::size_t i = 0; i < n; ++i)
      std::memcpy(&(v[first + i].*field), bytes.data() + i * sizeof(T), sizeof(T));
  }
  /// Precondition: the payload has been found to be as long as its counts say.
  template <class T>
  void packed(std::vector<T>& v, unsigned bits, std::uint64_t n) {
    const ByteView bytes = in_.take(packed_bytes(bits, n));
    if (in_.error()) return;
    if (!ends_in_zeros(bytes, bits, n)) report(Fault::packed_padding, in_.offset() - 1);
    v = unpack<T>(bytes, bits, n);
  }
  void rest(Bytes& bytes) {
    const ByteView all = in_.take(in_.remaining());
    bytes.assign(all.begin(), all.end());
  }
  void align() {
    const std::size_t rest = in_.position() % kArrayAlignment;
    if (rest != 0) check_zeros(kArrayAlignment - rest, Fault::array_padding);
  }
  void part(Part) {}

  ByteReader& in() { return in_; }
  std::uint64_t payload_bytes() const { return in_.position() + in_.remaining(); }

  /// What was read has no meaning beyond here.
  bool failed() const { return failed_ || in_.error(); }

  /// Whether the payload is as long as `fields` says; to be called before arrays are read, so that
  /// all of them are there.
  template <class F>
  bool expect(F&& fields) {
    if (!failed() && size_of_fields(fields) == payload_bytes()) return true;
    if (!failed()) report(Fault::payload_length, chunk_offset_);
    failed_ = true;
    return false;
  }

  /// The payload breaks a demand that its fields do not show; false.
  bool refuse(Fault fault) {
    report(fault, chunk_offset_);
    failed_ = true;
    return false;
  }

  /// Reports what stopped the reading, or that bytes are left; false when either is so.
  bool finish() {
    if (failed_) return false;
    in_.expect_end();
    if (!in_.error()) return true;
    const bool limit = in_.error()->code == ErrorCode::over_limit;
    report(limit ? Fault::over_limit : Fault::payload_length, in_.error()->offset,
           in_.error()->message);
    failed_ = true;
    return false;
  }

 private:
  /// Nothing when the bytes are not there; the product is checked by dividing.
  ByteView take(std::uint64_t n, std::size_t element) {
    if (n > in_.remaining() / element) in_.fail(ErrorCode::corrupt, "count exceeds the payload");
    return in_.take(in_.error() ? 0 : n * element);
  }
  void check_zeros(std::size_t n, Fault fault) {
    const std::uint64_t at = in_.offset();
    if (std::ranges::any_of(in_.take(n), [](std::byte b) { return b != std::byte{0}; }))
      report(fault, at);
  }
  void report(Fault fault, std::uint64_t offset, std::string found = {}) {
    const Where where{.field = Field::file, .element = offset};
    if (!faults_.report(fault, where, std::move(found))) failed_ = true;
  }

  ByteReader in_;
  std::uint64_t chunk_offset_;
  std::uint64_t max_string_bytes_;
  FaultSink& faults_;
  bool failed_ = false;
};

/// Finds where one field or list stands in a payload, by the address of the object that holds it.
class LocateIo : public SizeIo {
 public:
  explicit LocateIo(const void* target) : target_(target) {}

  template <class T>
  void number(const T& v) {
    mark(&v);
    SizeIo::number(v);
  }
  template <class E>
  void choice(const E& v, std::uint8_t values, Fault = {}) {
    mark(&v);
    SizeIo::choice(v, values);
  }
  void string(const std::string& s) {
    mark(&s);
    SizeIo::string(s);
  }
  template <class T>
  void run(const std::vector<T>& v, std::size_t first, std::uint64_t n) {
    mark(&v);
    SizeIo::run(v, first, n);
  }
  void run(const Attribute& a, std::size_t first, std::uint64_t n) {
    mark(&a);
    SizeIo::run(a, first, n);
  }
  void run(const Bytes& data, std::size_t element, std::size_t first, std::uint64_t n) {
    mark(&data);
    SizeIo::run(data, element, first, n);
  }
  template <class T>
  void packed(const std::vector<T>& v, unsigned bits, std::uint64_t n) {
    mark(&v);
    if (&v == target_) bits_ = bits;
    SizeIo::packed(v, bits, n);
  }
  template <class S, class T>
  void column(const std::vector<S>& v, T S::*field, std::size_t first, std::uint64_t n) {
    if (position_ == kNoOffset) mark(&v);  // the first column stands for the records
    SizeIo::column(v, field, first, n);
  }

  /// From the start of the payload; 0 when the target is not in it.
  std::uint64_t position() const { return position_ == kNoOffset ? 0 : position_; }
  /// The same of the byte where an element of a target of numbers begins.
  std::uint64_t position_of_element(std::uint64_t element) const {
    return position() + element * bits_ / 8;
  }

 private:
  void mark(const void* at) {
    if (at == target_) position_ = size();
  }
  const void* target_;
  std::uint64_t position_ = kNoOffset;
  unsigned bits_ = 8 * sizeof(Index);  ///< of a number in the target
};

}  // namespace pstrips::inline formats::layout
