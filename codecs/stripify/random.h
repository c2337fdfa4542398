#pragma once

#include <cstdint>

namespace pstrips::inline codecs {

/// A small generator whose sequence is the same everywhere: xorshift with 64 bits of state.
/// [Marsaglia03 §3]
class Random {
 public:
  explicit Random(std::uint32_t seed)
      : state_(0x9e37'79b9'7f4a'7c15 ^ (std::uint64_t{seed} << 16)) {}

  std::uint32_t bits() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 7;
    state_ ^= state_ << 17;
    return static_cast<std::uint32_t>(state_ >> 32);
  }
  /// In [0, count), near enough to uniform for counts far below 2^32.
  std::uint32_t below(std::uint32_t count) {
    return static_cast<std::uint32_t>((std::uint64_t{bits()} * count) >> 32);
  }

 private:
  std::uint64_t state_;  // never 0: the seed leaves the low bits of the constant alone
};

}  // namespace pstrips::inline codecs
