#include "formats/ply/ply_rows.h"

#include <algorithm>

#include "formats/ply/ply_numbers.h"

namespace pstrips::inline formats::ply {
namespace {

template <std::size_t kBytes>
void copy_strided(const Lane& lane, std::size_t begin, std::size_t end) {
  const std::byte* from = lane.from + begin * lane.from_stride;
  std::byte* to = lane.to + begin * lane.to_stride;
  for (std::size_t i = begin; i < end; ++i, from += lane.from_stride, to += lane.to_stride)
    std::memcpy(to, from, kBytes);
}

void copy_lane(const Lane& lane, std::size_t begin, std::size_t end) {
  const std::size_t bytes = lane.values * size_of(lane.from_type);
  // The sizes that files have get loops with moves in place of calls.
  switch (bytes) {
    case 1:
      return copy_strided<1>(lane, begin, end);
    case 2:
      return copy_strided<2>(lane, begin, end);
    case 3:
      return copy_strided<3>(lane, begin, end);
    case 4:
      return copy_strided<4>(lane, begin, end);
    case 8:
      return copy_strided<8>(lane, begin, end);
    case 12:
      return copy_strided<12>(lane, begin, end);
    case 24:
      return copy_strided<24>(lane, begin, end);
    default:
      for (std::size_t i = begin; i < end; ++i)
        std::memcpy(lane.to + i * lane.to_stride, lane.from + i * lane.from_stride, bytes);
  }
}

template <class From, class To, Swap kSwap>
void convert_values(const Lane& lane, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i)
    for (std::size_t k = 0; k < lane.values; ++k) {
      From from = load<From>(lane.from + i * lane.from_stride + k * sizeof(From));
      if constexpr (kSwap == Swap::from) from = swap_bytes(from);
      To to = static_cast<To>(from);
      if constexpr (kSwap == Swap::to) to = swap_bytes(to);
      store(lane.to + i * lane.to_stride + k * sizeof(To), to);
    }
}

template <Swap kSwap>
void convert_lane(const Lane& lane, std::size_t begin, std::size_t end) {
  const bool widens = lane.from_type != lane.to_type && lane.to_type == ComponentType::f64;
  visit_type(widens ? lane.from_type : lane.to_type, [&](auto zero) {
    using T = decltype(zero);
    if (lane.from_type == lane.to_type)
      convert_values<T, T, kSwap>(lane, begin, end);
    else if (widens)
      convert_values<T, double, kSwap>(lane, begin, end);
    else
      convert_values<double, T, kSwap>(lane, begin, end);
  });
}

void move_lane(const Lane& lane, std::size_t begin, std::size_t end, Swap swap) {
  if (swap == Swap::from)
    convert_lane<Swap::from>(lane, begin, end);
  else if (swap == Swap::to)
    convert_lane<Swap::to>(lane, begin, end);
  else if (lane.from_type != lane.to_type)
    convert_lane<Swap::none>(lane, begin, end);
  else
    copy_lane(lane, begin, end);
}

}  // namespace

void add_lane(std::vector<Lane>& lanes, const Lane& lane) {
  if (!lanes.empty() && lane.from_type == lane.to_type) {
    Lane& last = lanes.back();
    const std::size_t bytes = last.values * size_of(last.from_type);
    if (last.from_type == lane.from_type && last.to_type == lane.to_type &&
        last.from + bytes == lane.from && last.to + bytes == lane.to &&
        last.from_stride == lane.from_stride && last.to_stride == lane.to_stride) {
      last.values += lane.values;
      return;
    }
  }
  lanes.push_back(lane);
}

void move_rows(std::span<const Lane> lanes, std::size_t rows, Swap swap) {
  if (rows == 0 || lanes.empty()) return;
  const Lane& first = lanes.front();
  const std::size_t bytes = first.values * size_of(first.from_type);
  if (lanes.size() == 1 && swap == Swap::none && first.from_type == first.to_type &&
      first.from_stride == bytes && first.to_stride == bytes) {
    std::memcpy(first.to, first.from, rows * bytes);
    return;
  }
  constexpr std::size_t kBlockBytes = 16 << 10;  // half a common first-level cache
  const std::size_t row_bytes = std::max(first.from_stride, first.to_stride);
  const std::size_t block = std::max<std::size_t>(1, kBlockBytes / row_bytes);
  for (std::size_t row = 0; row < rows; row += block)
    for (const Lane& lane : lanes) move_lane(lane, row, std::min(rows, row + block), swap);
}

}  // namespace pstrips::inline formats::ply
