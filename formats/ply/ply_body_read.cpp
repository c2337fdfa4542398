#include <algorithm>
#include <atomic>
#include <cassert>
#include <limits>
#include <optional>

#include "core/limits.h"
#include "core/parallel.h"
#include "formats/ply/ply_body.h"
#include "formats/ply/ply_numbers.h"
#include "formats/ply/ply_rows.h"

namespace pstrips::inline formats::ply {
namespace {

/// Takes values out of an ascii body. Rows are lines.
class AsciiValues {
 public:
  static constexpr bool kAscii = true;

  AsciiValues(ByteView file, std::uint64_t position)
      : begin_(as_text(file).data()),
        at_(begin_ + position),
        end_(begin_ + file.size()),
        file_(file) {}

  bool begin_row() {
    while (at_ != end_ && is_space(*at_)) ++at_;
    return true;
  }
  bool end_row() {
    while (at_ != end_ && is_blank(*at_)) ++at_;
    if (at_ == end_ || is_line_end(*at_)) return true;
    return refuse(ErrorCode::corrupt, "line has more values than its element");
  }
  template <class T>
  bool number(T& value) {
    while (at_ != end_ && is_blank(*at_)) ++at_;
    if (at_ != end_ && parse_number(at_, end_, value)) return true;
    return refuse_number();
  }
  bool has(std::uint64_t values, std::size_t) {
    if (values <= (static_cast<std::size_t>(end_ - at_) + 1) / 2) return true;
    return refuse(ErrorCode::truncated, "ends before what it announces");
  }
  std::size_t most_values(std::size_t) const {
    return static_cast<std::size_t>(end_ - at_) / 2 + 1;
  }

  /// Refuses the value just read.
  bool refuse_value(ErrorCode code, std::string_view message, std::size_t) {
    while (at_ != begin_ && !is_space(at_[-1])) --at_;
    return refuse(code, message);
  }
  bool refuse(ErrorCode code, std::string_view message) {
    error_ = {code, std::string(message), offset(), line_of(file_, offset())};
    return false;
  }
  std::uint64_t offset() const { return static_cast<std::uint64_t>(at_ - begin_); }
  const Error& error() const { return error_; }

 private:
  bool refuse_number() {
    if (at_ == end_) return refuse(ErrorCode::truncated, "ends before what it announces");
    if (is_line_end(*at_)) return refuse(ErrorCode::corrupt, "line ends before its last value");
    const char* stop = std::find_if(at_, end_, is_space);
    if (stop == end_ && may_start_number(std::string_view(at_, stop)))
      return refuse(ErrorCode::truncated, "ends inside a number");
    return refuse(ErrorCode::corrupt, "not a number of the property's type");
  }

  const char* begin_;
  const char* at_;
  const char* end_;
  ByteView file_;
  Error error_;
};

/// Takes values out of a binary body.
template <bool kSwap>
class BinaryValues {
 public:
  static constexpr bool kAscii = false;

  BinaryValues(ByteView file, std::uint64_t position, const Element& element)
      : file_(file), at_(position), element_(element) {}

  bool begin_row() { return true; }
  bool end_row() {
    ++row_;
    return true;
  }
  template <class T>
  bool number(T& value) {
    if (file_.size() - at_ < sizeof(T)) return refuse_end();
    value = load<T>(file_.data() + at_);
    if constexpr (kSwap) value = swap_bytes(value);
    at_ += sizeof(T);
    return true;
  }
  bool has(std::uint64_t values, std::size_t bytes_each) {
    return values <= most_values(bytes_each) || refuse_end();
  }
  std::size_t most_values(std::size_t bytes_each) const {
    return (file_.size() - at_) / bytes_each;
  }

  bool refuse_value(ErrorCode code, std::string_view message, std::size_t bytes) {
    at_ -= bytes;
    return refuse(code, message);
  }
  bool refuse(ErrorCode code, std::string_view message) {
    error_ = {code, std::string(message), at_, element_.name + ' ' + std::to_string(row_)};
    return false;
  }
  std::uint64_t offset() const { return at_; }
  const Error& error() const { return error_; }

  // For the loops that check a row at a time.
  const std::byte* data() const { return file_.data() + at_; }
  void skip(std::size_t bytes) { at_ += bytes; }
  bool refuse_end() {
    at_ = file_.size();
    return refuse(ErrorCode::truncated, "ends before what it announces");
  }

 private:
  ByteView file_;
  std::size_t at_;
  const Element& element_;
  std::uint64_t row_ = 0;
  Error error_;
};

/// Grows the corner list of one element ahead of need.
class FaceAppender {
 public:
  FaceAppender(FaceLists& lists, std::uint64_t faces, std::size_t most_corners, std::uint64_t limit)
      : lists_(lists), faces_(faces), limit_(limit) {
    lists_.corners.resize(std::min<std::uint64_t>({3 * faces, most_corners, limit}));
  }

  bool fits(std::uint64_t corners) const { return corners <= limit_ - used_; }
  std::string refusal(std::uint64_t corners) const {
    return over_limit_message(used_ + corners, "face corners", limit_);
  }
  /// Room for that many corners; precondition: fits().
  Index* room(std::size_t corners) {
    if (lists_.corners.size() - used_ < corners)
      lists_.corners.resize(std::max(used_ + corners, used_ + used_ / 2));
    return lists_.corners.data() + used_;
  }
  void close_face(std::size_t corners) {
    if (corners != 3 && lists_.first.empty()) start_bounds();
    used_ += corners;
    ++count_;
    if (!lists_.first.empty()) lists_.first.push_back(static_cast<Index>(used_));
  }
  void finish() { lists_.corners.resize(used_); }

 private:
  void start_bounds() {
    lists_.first.reserve(faces_ + 1);
    for (std::size_t i = 0; i <= count_; ++i) lists_.first.push_back(static_cast<Index>(3 * i));
  }

  FaceLists& lists_;
  std::uint64_t faces_, limit_;
  std::size_t used_ = 0, count_ = 0;
};

template <class Values>
class RowReader {
 public:
  RowReader(Values& in, const Element& element, std::uint64_t rows, std::span<const Sink> sinks,
            const BodyLimits& limits)
      : in_(in), element_(element), rows_(rows), sinks_(sinks), limits_(limits) {
    for (std::size_t p = 0; p < sinks.size(); ++p)
      if (sinks[p].kind == Sink::Kind::faces)
        faces_.emplace(*sinks[p].faces, rows, in.most_values(size_of(element.properties[p].type)),
                       limits.corners);
  }

  bool run() {
    const std::size_t properties = sinks_.size();
    for (std::uint64_t row = 0; row < rows_; ++row) {
      if (!in_.begin_row()) return false;
      for (std::size_t p = 0; p < properties; ++p)
        if (!read_property(element_.properties[p], sinks_[p], row)) return false;
      if (!in_.end_row()) return false;
    }
    if (faces_) faces_->finish();
    return true;
  }

 private:
  bool read_property(const Property& property, const Sink& sink, std::uint64_t row) {
    if (sink.kind == Sink::Kind::scalars) {
      std::byte* const to = sink.data + row * sink.stride;
      return visit_type(property.type, [&](auto value) {
        if (!in_.number(value)) return false;
        if (sink.stored == property.type)
          store(to, value);
        else
          store(to, static_cast<double>(value));
        return true;
      });
    }
    std::uint64_t count = 0;
    if (!read_count(property.count_type, count)) return false;
    if (!in_.has(count, size_of(property.type))) return false;
    return sink.kind == Sink::Kind::faces ? read_face(property.type, count)
                                          : read_list(property.type, count, *sink.list);
  }

  bool read_count(ComponentType type, std::uint64_t& count) {
    return visit_type(type, [&](auto value) {
      if (!in_.number(value)) return false;
      if (value < 0)
        return in_.refuse_value(ErrorCode::corrupt, "list count is negative", sizeof value);
      count = static_cast<std::uint64_t>(value);
      return true;
    });
  }

  bool read_face(ComponentType type, std::uint64_t count) {
    if (!faces_->fits(count)) return in_.refuse(ErrorCode::over_limit, faces_->refusal(count));
    Index* const room = faces_->room(count);
    const bool good = visit_type(type, [&](auto value) {
      for (std::uint64_t i = 0; i < count; ++i) {
        if (!in_.number(value)) return false;
        if (value < 0 || static_cast<std::uint64_t>(value) >= limits_.vertices)
          return in_.refuse_value(ErrorCode::corrupt, "index of a vertex that is not there",
                                  sizeof value);
        room[i] = static_cast<Index>(value);
      }
      return true;
    });
    if (good) faces_->close_face(count);
    return good;
  }

  bool read_list(ComponentType type, std::uint64_t count, ListColumn& list) {
    const std::size_t used = list.values.size();
    if (count > (limits_.memory_bytes - std::min<std::uint64_t>(used, limits_.memory_bytes)) /
                    size_of(type))
      return in_.refuse(
          ErrorCode::over_limit,
          over_limit_message(used + count * size_of(type), "bytes of lists", limits_.memory_bytes));
    list.sizes.push_back(static_cast<std::uint32_t>(count));
    list.values.resize(used + count * size_of(type));
    std::byte* to = list.values.data() + used;
    return visit_type(type, [&](auto value) {
      for (std::uint64_t i = 0; i < count; ++i, to += sizeof value) {
        if (!in_.number(value)) return false;
        store(to, value);
      }
      return true;
    });
  }

  Values& in_;
  const Element& element_;
  std::uint64_t rows_;
  std::span<const Sink> sinks_;
  const BodyLimits& limits_;
  std::optional<FaceAppender> faces_;
};

/// All rows have one size.
void read_fixed_rows(const std::byte* from, const Element& element, std::span<const Sink> sinks,
                     std::size_t row_bytes, Swap swap) {
  if (element.count == 0) return;  // sinks are null
  std::vector<Lane> lanes;
  for (std::size_t p = 0; p < sinks.size(); ++p) {
    const ComponentType type = element.properties[p].type;
    add_lane(lanes, {from, row_bytes, type, sinks[p].data, sinks[p].stride, sinks[p].stored});
    from += size_of(type);
  }
  move_rows(lanes, element.count, swap);
}

/// The usual face element: one list with counts of one byte and indices of four.
template <bool kSwap>
bool read_plain_faces(BinaryValues<kSwap>& in, const Element& element, FaceLists& lists,
                      const BodyLimits& limits) {
  const Property& property = element.properties[0];
  FaceAppender faces(lists, element.count, in.most_values(4), limits.corners);
  const std::uint64_t below = is_signed_integer(property.type)
                                  ? std::min<std::uint64_t>(limits.vertices, 1u << 31)
                                  : limits.vertices;
  for (std::uint64_t row = 0; row < element.count; ++row) {
    std::uint8_t count = 0;
    if (!in.number(count)) return false;
    if (count > 127 && is_signed_integer(property.count_type))
      return in.refuse_value(ErrorCode::corrupt, "list count is negative", 1);
    if (!in.has(count, 4)) return false;
    if (!faces.fits(count)) return in.refuse(ErrorCode::over_limit, faces.refusal(count));
    Index* const room = faces.room(count);
    const std::byte* from = in.data();
    for (std::size_t i = 0; i < count; ++i, from += 4) {
      Index index = load<Index>(from);
      if constexpr (kSwap) index = swap_bytes(index);
      if (index >= below) {
        in.skip(4 * i);
        return in.refuse(ErrorCode::corrupt, "index of a vertex that is not there");
      }
      room[i] = index;
    }
    in.skip(std::size_t{4} * count);
    faces.close_face(count);
    in.end_row();
  }
  faces.finish();
  return true;
}

struct RowShape {
  std::size_t fixed_bytes = 0;  ///< binary: of scalars and list counts
  bool has_lists = false;
};

RowShape shape_of(const Element& element) {
  RowShape shape;
  for (const Property& property : element.properties) {
    shape.fixed_bytes += size_of(property.is_list() ? property.count_type : property.type);
    shape.has_lists |= property.is_list();
  }
  return shape;
}

template <class Values>
Result<void> read_with(Values& in, const Element& element, std::span<const Sink> sinks,
                       const BodyLimits& limits, std::uint64_t& position) {
  const bool plain_faces = element.properties.size() == 1 && sinks[0].kind == Sink::Kind::faces &&
                           size_of(element.properties[0].count_type) == 1 &&
                           size_of(element.properties[0].type) == 4;
  bool good = false;
  if constexpr (!Values::kAscii) {
    if (plain_faces) good = read_plain_faces(in, element, *sinks[0].faces, limits);
  }
  if (Values::kAscii || !plain_faces)
    good = RowReader<Values>(in, element, element.count, sinks, limits).run();
  if (!good) return tl::unexpected<Error>(in.error());
  position = in.offset();
  return {};
}

template <bool kSwap>
Result<void> read_binary(ByteView file, const Element& element, std::span<const Sink> sinks,
                         const BodyLimits& limits, std::uint64_t& position) {
  const RowShape shape = shape_of(element);
  if (shape.has_lists) {
    BinaryValues<kSwap> in(file, position, element);
    return read_with(in, element, sinks, limits, position);
  }
  read_fixed_rows(file.data() + position, element, sinks, shape.fixed_bytes,
                  kSwap ? Swap::from : Swap::none);
  position += element.count * shape.fixed_bytes;
  return {};
}

/// The rows of an element in one run of an ascii body, lists of their own.
struct RunRows {
  std::uint64_t position, end;  ///< of the text
  std::uint64_t first, rows;    ///< of the element
  FaceLists faces;
  std::vector<ListColumn> lists;  ///< one a property

  bool read(ByteView file, const Element& element, std::span<const Sink> all,
            const BodyLimits& limits) {
    lists.resize(all.size());
    std::vector<Sink> sinks(all.begin(), all.end());
    for (std::size_t p = 0; p < sinks.size(); ++p) {
      if (sinks[p].kind == Sink::Kind::scalars) sinks[p].data += first * sinks[p].stride;
      sinks[p].faces = &faces;
      sinks[p].list = &lists[p];
    }
    AsciiValues in(file.first(end), position);
    const bool good = RowReader<AsciiValues>(in, element, rows, sinks, limits).run();
    position = in.offset();
    return good;
  }
};

/// What all runs have together.
struct Joined {
  std::uint64_t corners = 0, list_bytes = 0;
};

Joined sum_of(std::span<const RunRows> runs) {
  Joined out;
  for (const RunRows& run : runs) {
    out.corners += run.faces.corners.size();
    for (const ListColumn& list : run.lists) out.list_bytes += list.values.size();
  }
  return out;
}

void append(ListColumn& all, ListColumn&& more) {
  all.sizes.insert(all.sizes.end(), more.sizes.begin(), more.sizes.end());
  all.values.insert(all.values.end(), more.values.begin(), more.values.end());
  more = {};
}

void start_bounds(FaceLists& faces) {
  if (!faces.first.empty()) return;
  for (std::size_t i = 0; i <= faces.corners.size(); i += 3)
    faces.first.push_back(static_cast<Index>(i));
}

void append(FaceLists& all, FaceLists&& more) {
  const auto before = static_cast<Index>(all.corners.size());
  if (!all.first.empty() || !more.first.empty()) {
    start_bounds(all);
    start_bounds(more);
    for (std::size_t i = 1; i < more.first.size(); ++i) all.first.push_back(before + more.first[i]);
  }
  all.corners.insert(all.corners.end(), more.corners.begin(), more.corners.end());
  more = {};
}

void join(std::span<RunRows> runs, std::span<const Sink> sinks, const Joined& sum) {
  for (std::size_t p = 0; p < sinks.size(); ++p) {
    if (sinks[p].kind == Sink::Kind::faces) sinks[p].faces->corners.reserve(sum.corners);
    for (RunRows& run : runs) {
      if (sinks[p].kind == Sink::Kind::list) append(*sinks[p].list, std::move(run.lists[p]));
      if (sinks[p].kind == Sink::Kind::faces) append(*sinks[p].faces, std::move(run.faces));
    }
  }
}

}  // namespace

BodyReader::BodyReader(ByteView file, std::uint64_t body, Encoding encoding,
                       const BodyLimits& limits, unsigned threads, std::size_t run_bytes)
    : file_(file),
      position_(body),
      encoding_(encoding),
      limits_(limits),
      threads_(thread_count(threads)) {
  // Runs do not know what the others take. A value of two characters becomes eight bytes at most,
  // once in a run and once joined.
  constexpr std::uint64_t kMaxGrowth = 8;
  const std::uint64_t bytes = file.size() - body;
  if (encoding == Encoding::ascii && threads_ > 1 && bytes > run_bytes &&
      bytes <= limits.memory_bytes / kMaxGrowth)
    runs_ = cut_into_runs(file, body, run_bytes, threads_);
}

Result<void> BodyReader::expect(const Element& element) const {
  if (element.properties.empty()) return {};
  const std::uint64_t left = file_.size() - position_;
  // In ascii each value has a digit and a separator, the last one perhaps without.
  const std::uint64_t most = encoding_ == Encoding::ascii
                                 ? (left + 1) / (2 * element.properties.size())
                                 : left / shape_of(element).fixed_bytes;
  if (element.count <= most) return {};
  return fail(ErrorCode::truncated, "ends before what it announces", file_.size(),
              "element " + element.name);
}

Result<void> BodyReader::read(const Element& element, std::span<const Sink> sinks) {
  assert(sinks.size() == element.properties.size());
  if (element.properties.empty()) return {};
  if (encoding_ == Encoding::ascii) {
    // Where runs meet a fault, all is read again in one go, which finds the first one.
    if (read_in_runs(element, sinks)) return {};
    AsciiValues in(file_, position_);
    return read_with(in, element, sinks, limits_, position_);
  }
  return encoding_ == Encoding::little_endian
             ? read_binary<false>(file_, element, sinks, limits_, position_)
             : read_binary<true>(file_, element, sinks, limits_, position_);
}

bool BodyReader::read_in_runs(const Element& element, std::span<const Sink> sinks) {
  const std::uint64_t first = rows_, end = rows_ + element.count;
  rows_ = end;
  if (runs_.empty() || end > runs_.back().rows) return false;
  std::vector<RunRows> parts;
  for (std::size_t i = 0; i + 1 < runs_.size(); ++i) {
    const std::uint64_t from = std::max(first, runs_[i].rows),
                        to = std::min(end, runs_[i + 1].rows);
    if (from >= to) continue;
    const std::uint64_t position = std::max(position_, runs_[i].begin);
    parts.push_back({position, runs_[i + 1].begin, from - first, to - from, {}, {}});
  }
  std::atomic<bool> good{true};
  parallel_for(threads_, parts.size(), 1, [&](std::size_t i, std::size_t) {
    if (good && !parts[i].read(file_, element, sinks, limits_)) good = false;
  });
  const Joined sum = sum_of(parts);
  if (!good || sum.corners > limits_.corners || sum.list_bytes > limits_.memory_bytes) return false;
  join(parts, sinks, sum);
  if (!parts.empty()) position_ = parts.back().position;
  return true;
}

ByteView BodyReader::rest() const {
  std::size_t at = position_;
  if (encoding_ == Encoding::ascii)
    while (at != file_.size() && is_space(static_cast<char>(file_[at]))) ++at;
  return file_.subspan(at);
}

}  // namespace pstrips::inline formats::ply
