#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "core/bytes.h"

namespace pstrips::fuzz {

/// Damages a file in one to four places: bits, bytes, numbers, words, cuts, repeats, pieces of the
/// other files. Same arguments, same result.
Bytes mutate(ByteView file, std::uint32_t seed, std::span<const std::string_view> words,
             std::span<const Bytes> others);

}  // namespace pstrips::fuzz
