#include <algorithm>
#include <cstring>

#include "formats/ply/ply_body.h"
#include "formats/ply/ply_numbers.h"
#include "formats/ply/ply_rows.h"

namespace pstrip::ply {
namespace {

class AsciiRows {
 public:
  explicit AsciiRows(Bytes& out) : out_(out), used_(out.size()) {}
  ~AsciiRows() { out_.resize(used_); }
  AsciiRows(const AsciiRows&) = delete;
  AsciiRows& operator=(const AsciiRows&) = delete;

  void reserve(std::size_t values) {
    const std::size_t need = used_ + (values + 1) * kMaxNumberChars;
    if (out_.size() < need) out_.resize(std::max(need, out_.size() + out_.size() / 2));
  }
  template <class T>
  void number(T value) {
    auto* const at = reinterpret_cast<char*>(out_.data() + used_);
    char* const end = format_number(at, value);
    *end = ' ';
    used_ += static_cast<std::size_t>(end + 1 - at);
  }
  void end_row() {
    if (used_ != 0) out_[used_ - 1] = std::byte{'\n'};
  }

 private:
  Bytes& out_;
  std::size_t used_;
};

/// Writes to memory that is known to suffice.
template <bool kSwap>
class BinaryRows {
 public:
  explicit BinaryRows(std::byte* to) : to_(to) {}

  void reserve(std::size_t) {}
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
    rows.reserve(sources.size());
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
      rows.reserve(count + sources.size());
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

std::size_t binary_bytes(const Element& element, std::span<const Source> sources) {
  std::size_t bytes = 0;
  for (std::size_t p = 0; p < sources.size(); ++p) {
    const Property& property = element.properties[p];
    bytes += element.count * size_of(property.is_list() ? property.count_type : property.type);
    for (std::size_t row = 0; property.is_list() && row < element.count; ++row)
      bytes += sources[p].size(row) * size_of(property.type);
  }
  return bytes;
}

template <bool kSwap>
void write_binary(const Element& element, std::span<const Source> sources, Bytes& out) {
  const bool fixed = std::ranges::none_of(element.properties, &Property::is_list);
  if (fixed) return write_fixed_rows(element, sources, kSwap ? Swap::to : Swap::none, out);
  const std::size_t start = out.size();
  out.resize(start + binary_bytes(element, sources));
  BinaryRows<kSwap> rows(out.data() + start);
  write_all(rows, element, sources);
}

}  // namespace

void write_rows(const Element& element, std::span<const Source> sources, Encoding encoding,
                Bytes& out) {
  if (element.properties.empty()) return;
  if (encoding == Encoding::little_endian) return write_binary<false>(element, sources, out);
  if (encoding == Encoding::big_endian) return write_binary<true>(element, sources, out);
  AsciiRows rows(out);
  write_all(rows, element, sources);
}

}  // namespace pstrip::ply
