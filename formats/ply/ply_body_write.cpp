#include <algorithm>
#include <cassert>
#include <cstring>

#include "formats/ply/ply_body.h"
#include "formats/ply/ply_numbers.h"
#include "formats/ply/ply_rows.h"

namespace pstrip::ply {
namespace {

/// Writes by way of a block that stays in the cache.
class AsciiRows {
 public:
  explicit AsciiRows(Bytes& out) : out_(out), block_(kBlockBytes) {}
  ~AsciiRows() { flush(); }
  AsciiRows(const AsciiRows&) = delete;
  AsciiRows& operator=(const AsciiRows&) = delete;

  template <class T>
  void number(T value) {
    if (block_.size() - used_ < kMaxNumberChars) flush();
    char* const at = block_.data() + used_;
    char* const end = format_number(at, value);
    *end = ' ';
    used_ += static_cast<std::size_t>(end + 1 - at);
  }
  void end_row() {
    assert(used_ != 0);  // flush() comes before a number, never after
    block_[used_ - 1] = '\n';
  }

 private:
  static constexpr std::size_t kBlockBytes = 32 << 10;

  void flush() {
    const auto bytes = std::as_bytes(std::span(block_.data(), used_));
    out_.insert(out_.end(), bytes.begin(), bytes.end());
    used_ = 0;
  }

  Bytes& out_;
  std::vector<char> block_;
  std::size_t used_ = 0;
};

/// Writes to memory that is known to suffice.
template <bool kSwap>
class BinaryRows {
 public:
  explicit BinaryRows(std::byte* to) : to_(to) {}

  template <class T>
  void number(T value) {
    if constexpr (kSwap) value = swap_bytes(value);
    store(to_, value);
    to_ += sizeof value;
  }
  void end_row() {}

 private:
  std::byte* to_;
};

template <class Rows>
void write_values(Rows& rows, ComponentType type, const Source& source, std::size_t from,
                  std::size_t count) {
  visit_type(type, [&](auto zero) {
    using T = decltype(zero);
    if (source.kind == Source::Kind::indices) {
      for (std::size_t i = 0; i < count; ++i) rows.number(static_cast<T>(source.indices[from + i]));
    } else {
      for (std::size_t i = 0; i < count; ++i)
        rows.number(load<T>(source.data + (from + i) * sizeof(T)));
    }
  });
}

template <class Rows>
void write_all(Rows& rows, const Element& element, std::span<const Source> sources) {
  std::vector<std::size_t> used(sources.size());  // values of the rows before
  for (std::size_t row = 0; row < element.count; ++row) {
    for (std::size_t p = 0; p < sources.size(); ++p) {
      const Source& source = sources[p];
      const Property& property = element.properties[p];
      if (source.kind == Source::Kind::scalars) {
        const std::byte* const at = source.data + row * source.stride;
        visit_type(property.type, [&](auto zero) {
          using T = decltype(zero);
          rows.number(source.stored == property.type ? load<T>(at)
                                                     : static_cast<T>(load<double>(at)));
        });
        continue;
      }
      const std::size_t count = source.size(row);
      visit_type(property.count_type,
                 [&](auto zero) { rows.number(static_cast<decltype(zero)>(count)); });
      write_values(rows, property.type, source, used[p], count);
      used[p] += count;
    }
    rows.end_row();
  }
}

void write_fixed_rows(const Element& element, std::span<const Source> sources, Swap swap,
                      Bytes& out) {
  if (element.count == 0) return;  // sources are null
  std::size_t row_bytes = 0;
  for (const Property& property : element.properties) row_bytes += size_of(property.type);
  const std::size_t start = out.size();
  out.resize(start + row_bytes * element.count);
  std::byte* to = out.data() + start;
  std::vector<Lane> lanes;
  for (std::size_t p = 0; p < sources.size(); ++p) {
    const ComponentType type = element.properties[p].type;
    add_lane(lanes, {sources[p].data, sources[p].stride, sources[p].stored, to, row_bytes, type});
    to += size_of(type);
  }
  move_rows(lanes, element.count, swap);
}

/// Values of all rows of a list.
std::size_t values_of(const Element& element, const Source& source) {
  std::size_t values = 0;
  for (std::size_t row = 0; row < element.count; ++row) values += source.size(row);
  return values;
}

/// What a number usually takes in ascii with its separator; guides a reservation only.
std::size_t usual_chars(ComponentType type) {
  constexpr std::size_t kChars[] = {4, 4, 6, 6, 8, 8, 12, 20};
  return kChars[static_cast<std::size_t>(type)];
}

template <bool kSwap>
void write_binary(const Element& element, std::span<const Source> sources, Bytes& out) {
  const bool fixed = std::ranges::none_of(element.properties, &Property::is_list);
  if (fixed) return write_fixed_rows(element, sources, kSwap ? Swap::to : Swap::none, out);
  const std::size_t start = out.size();
  out.resize(start + expected_bytes(element, sources, Encoding::little_endian));
  BinaryRows<kSwap> rows(out.data() + start);
  write_all(rows, element, sources);
}

}  // namespace

std::size_t expected_bytes(const Element& element, std::span<const Source> sources,
                           Encoding encoding) {
  const auto bytes_each = [&](ComponentType type) {
    return encoding == Encoding::ascii ? usual_chars(type) : size_of(type);
  };
  std::size_t bytes = 0;
  for (std::size_t p = 0; p < sources.size(); ++p) {
    const Property& property = element.properties[p];
    bytes += element.count * bytes_each(property.is_list() ? property.count_type : property.type);
    if (property.is_list()) bytes += values_of(element, sources[p]) * bytes_each(property.type);
  }
  return bytes;
}

void write_rows(const Element& element, std::span<const Source> sources, Encoding encoding,
                Bytes& out) {
  if (element.properties.empty()) return;
  if (encoding == Encoding::little_endian) return write_binary<false>(element, sources, out);
  if (encoding == Encoding::big_endian) return write_binary<true>(element, sources, out);
  AsciiRows rows(out);
  write_all(rows, element, sources);
}

}  // namespace pstrip::ply
