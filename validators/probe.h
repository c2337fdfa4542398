#pragma once

#include "core/fault_list.h"
#include "core/text.h"
#include "formats/pstrip/payload/layout.h"

namespace pstrips::inline validators {

/// The Io of the layout functions that reads a payload for judging: where a reader would give up,
/// it notes the fault and goes on as long as the fields after keep their meaning.
class ProbeIo {
 public:
  static constexpr bool kReads = true;

  ProbeIo(const Chunk& chunk, const Limits& limits, Faults& faults)
      : io_(chunk.payload, chunk.payload_offset(), limits.string_bytes),
        payload_(chunk.payload),
        offset_(chunk.payload_offset()),
        faults_(faults) {}

  template <class T>
  void number(T& v) {
    io_.number(v);
  }
  template <class E>
  void choice(E& v, std::uint8_t values) {
    const std::uint64_t at = in().offset();
    const std::uint8_t n = in().u8();
    if (n < values) {
      v = static_cast<E>(n);
      return;
    }
    if (in().error()) return;
    // The only choice of eight is the type of a component.
    constexpr std::uint8_t kComponentTypes = 8;
    note(values == kComponentTypes ? Fault::type_undefined : Fault::value_undefined, at,
         std::to_string(n));
    undefined_ = true;
  }
  void zeros(std::size_t n) { check_zeros(n, Fault::reserved_not_zero); }
  void string(std::string& s) {
    const std::uint64_t at = in().offset();
    io_.string(s);
    if (const std::size_t bad = first_not_utf8(s); bad < s.size())
      note(Fault::string_not_utf8, at + 4 + bad);
  }
  template <class T>
  std::vector<T>& list(std::vector<T>& v, std::size_t min_bytes_each) {
    return io_.list(v, min_bytes_each);
  }
  template <class T>
  void run(std::vector<T>& v, std::size_t first, std::uint64_t n) {
    io_.run(v, first, n);
  }
  void run(Attribute& a, std::size_t first, std::uint64_t n) { io_.run(a, first, n); }
  void run(Bytes& data, std::size_t element, std::size_t first, std::uint64_t n) {
    io_.run(data, element, first, n);
  }
  template <class S, class T>
  void column(std::vector<S>& v, T S::*field, std::size_t first, std::uint64_t n) {
    io_.column(v, field, first, n);
  }
  /// Precondition: as for ReadIo; here expect() has seen to it.
  template <class T>
  void packed(std::vector<T>& v, unsigned bits, std::uint64_t n) {
    const ByteView bytes = in().take(layout::packed_bytes(bits, n));
    if (in().error()) return;
    if (!layout::ends_in_zeros(bytes, bits, n)) note(Fault::packed_padding, in().offset() - 1);
    v = layout::unpack<T>(bytes, bits, n);
  }
  void rest(Bytes& bytes) { io_.rest(bytes); }
  void align() {
    const std::size_t rest = in().position() % layout::kArrayAlignment;
    if (rest != 0) check_zeros(layout::kArrayAlignment - rest, Fault::array_padding);
  }
  void part(Part) {}
  ByteReader& in() { return io_.in(); }

  std::uint64_t payload_bytes() const { return payload_.size(); }
  void skip_rest() { in().take(in().remaining()); }

  /// What was read has no meaning beyond here.
  bool failed() { return undefined_ || in().error().has_value(); }

  /// Whether the payload is as long as `fields` says; asked before arrays are read, so that all of
  /// them are there.
  template <class F>
  bool expect(F&& fields) {
    if (layout::size_of_fields(fields) == payload_.size()) return true;
    note(Fault::payload_length, offset_ - kChunkHeaderBytes);
    undefined_ = true;
    return false;
  }

  /// Notes what stopped the reading, or that bytes are left; false when either is so.
  bool finish() {
    if (undefined_) return false;
    in().expect_end();
    if (!in().error()) return true;
    const bool limit = in().error()->code == ErrorCode::over_limit;
    note(limit ? Fault::over_limit : Fault::payload_length, in().error()->offset,
         in().error()->message);
    undefined_ = true;
    return false;
  }

 private:
  void check_zeros(std::size_t n, Fault fault) {
    const std::uint64_t at = in().offset();
    for (const std::byte b : in().take(n))
      if (b != std::byte{0}) return note(fault, at);
  }
  void note(Fault fault, std::uint64_t offset, std::string found = {}) {
    faults_.add(fault, {.field = Field::file, .element = offset}, std::move(found));
  }

  layout::ReadIo io_;
  ByteView payload_;
  std::uint64_t offset_;
  Faults& faults_;
  bool undefined_ = false;
};

}  // namespace pstrips::inline validators
