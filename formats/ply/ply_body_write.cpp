#include <algorithm>
#include <cassert>
#include <cstring>

#include "core/parallel.h"
#include "formats/ply/ply_body.h"
#include "formats/ply/ply_numbers.h"
#include "formats/ply/ply_rows.h"

namespace pstrips::inline formats::ply {
namespace {

/// The text of a run of rows, in memory that grows and is used again for the next run.
class AsciiRows {
 public:
  template <class T>
  void number(T value) {
    if (text_.size() - used_ < kMaxNumberChars) text_.resize(2 * text_.size() + kFirstBytes);
    char* const at = text_.data() + used_;
    char* const end = format_number(at, value);
    *end = ' ';
    used_ += static_cast<std::size_t>(end + 1 - at);
  }
  void end_row() {
    assert(used_ != 0);
    text_[used_ - 1] = '\n';
  }
  void clear() { used_ = 0; }
  ByteView text() const { return std::as_bytes(std::span(text_.data(), used_)); }

 private:
  static constexpr std::size_t kFirstBytes = 32 << 10;

  std::vector<char> text_;
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

/// Rows that stand together, and for each list how many values the rows before them have.
struct RowRange {
  std::size_t begin = 0, end = 0;
  std::vector<std::size_t> used;
};

template <class Rows>
void write_all(Rows& rows, const Element& element, std::span<const Source> sources,
               RowRange range) {
  for (std::size_t row = range.begin; row < range.end; ++row) {
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
      write_values(rows, property.type, source, range.used[p], count);
      range.used[p] += count;
    }
    rows.end_row();
  }
}

/// Moves to the next `rows` rows, as far as there are some.
void advance(RowRange& range, std::size_t rows, std::span<const Source> sources,
             std::size_t count) {
  for (std::size_t p = 0; p < sources.size(); ++p)
    if (sources[p].kind != Source::Kind::scalars)
      for (std::size_t row = range.begin; row < range.end; ++row)
        range.used[p] += sources[p].size(row);
  range.begin = range.end;
  range.end = std::min(count, range.begin + rows);
}

/// Run by run, some on each thread, then the texts one behind the other.
void write_ascii(const Element& element, std::span<const Source> sources, unsigned threads,
                 Bytes& out) {
  constexpr std::size_t kRows = 4096, kRunsAtOnce = 32;
  std::vector<AsciiRows> texts(kRunsAtOnce);
  std::vector<RowRange> ranges;
  RowRange range{0, 0, std::vector<std::size_t>(sources.size())};
  while (range.end < element.count) {
    ranges.clear();
    while (range.end < element.count && ranges.size() < kRunsAtOnce) {
      advance(range, kRows, sources, element.count);
      ranges.push_back(range);
    }
    parallel_for(threads, ranges.size(), 1, [&](std::size_t i, std::size_t) {
      texts[i].clear();
      write_all(texts[i], element, sources, ranges[i]);
    });
    for (std::size_t i = 0; i < ranges.size(); ++i)
      out.insert(out.end(), texts[i].text().begin(), texts[i].text().end());
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
  write_all(rows, element, sources, {0, element.count, std::vector<std::size_t>(sources.size())});
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
                unsigned threads, Bytes& out) {
  if (element.properties.empty()) return;
  if (encoding == Encoding::little_endian) return write_binary<false>(element, sources, out);
  if (encoding == Encoding::big_endian) return write_binary<true>(element, sources, out);
  write_ascii(element, sources, threads, out);
}

}  // namespace pstrips::inline formats::ply
