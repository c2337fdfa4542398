#pragma once

#include <bit>
#include <span>
#include <vector>

#include "core/mesh.h"

namespace pstrips::inline formats::ply {

template <class T>
T swap_bytes(T value) {
  if constexpr (sizeof(T) == 1) {
    return value;
  } else if constexpr (sizeof(T) == 2) {
    return std::bit_cast<T>(__builtin_bswap16(std::bit_cast<std::uint16_t>(value)));
  } else if constexpr (sizeof(T) == 4) {
    return std::bit_cast<T>(__builtin_bswap32(std::bit_cast<std::uint32_t>(value)));
  } else {
    return std::bit_cast<T>(__builtin_bswap64(std::bit_cast<std::uint64_t>(value)));
  }
}

/// A value of each row, or several side by side, on the way between a file and an array.
struct Lane {
  const std::byte* from = nullptr;
  std::size_t from_stride = 0;
  ComponentType from_type = ComponentType::f32;
  std::byte* to = nullptr;
  std::size_t to_stride = 0;
  ComponentType to_type = ComponentType::f32;  ///< as from_type, or one of both is f64
  std::size_t values = 1;
};

enum class Swap : std::uint8_t { none, from, to };

/// Adds a lane, joined with the last one when their values lie side by side at both ends.
void add_lane(std::vector<Lane>& lanes, const Lane& lane);

/// Moves all rows of all lanes. `swap` names the end that is big-endian.
void move_rows(std::span<const Lane> lanes, std::size_t rows, Swap swap);

}  // namespace pstrips::inline formats::ply
