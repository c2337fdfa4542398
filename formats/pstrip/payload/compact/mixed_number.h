#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "formats/pstrip/payload/compact/mixed_bit.h"

namespace pstrips::inline formats {

/// Signed numbers about whose size several things are known: their bit length step by step, from
/// where it is expected.
class MixedNumberModel {
 public:
  static constexpr unsigned kGuesses = 4;
  static constexpr unsigned kShapes = 36;
  /// A guess of the size, in quarter octaves, under one of several circumstances.
  struct Guess {
    unsigned size, circumstance;
  };
  using Guesses = std::array<Guess, kGuesses>;
  /// What is known of the sign: circumstances below 16 and 64; kUnknown: nothing.
  struct Sign {
    unsigned first, second;
  };
  static constexpr unsigned kUnknown = 64;

  /// circumstances  how many each guess has
  MixedNumberModel(const std::array<unsigned, kGuesses>& circumstances, bool with_signs) {
    for (unsigned i = 0; i < kGuesses; ++i) counters_[i].resize(circumstances[i] * kPlaces);
    if (!with_signs) return;
    signs_[0].resize(16 * kRelative);
    signs_[1].resize(64 * kRelative);
  }

  /// |value| < 2^30. The first guess is the one that is trusted most, and shape < kShapes
  /// what tells best how the guesses are to be weighed.
  template <class Coder>
  std::int32_t code(Coder& coder, std::int32_t value, const Guesses& guesses, unsigned shape,
                    Sign sign) {
    const auto magnitude = static_cast<std::uint32_t>(value < 0 ? -value : value);
    const unsigned bits =
        code_length(coder, static_cast<unsigned>(std::bit_width(magnitude)), guesses, shape);
    if (bits == 0) return 0;
    const unsigned near = relative(guesses[0], bits);
    const std::uint32_t coded = code_bits(coder, magnitude, bits, near);
    const bool negative = code_sign(coder, value < 0, near, sign);
    return negative ? -static_cast<std::int32_t>(coded) : static_cast<std::int32_t>(coded);
  }

 private:
  static constexpr unsigned kRelative = 64, kPlaces = 3 * kRelative, kMostBits = 30;

  /// How a length compares with what was guessed.
  static unsigned relative(Guess guess, unsigned bits) {
    return static_cast<unsigned>(std::clamp(
        static_cast<int>(4 * bits + 40) - static_cast<int>(guess.size), 0, int{kRelative} - 1));
  }

  /// Is it longer? First what is expected, then on in the direction of the answer.
  template <class Coder>
  unsigned code_length(Coder& coder, unsigned wanted, const Guesses& guesses, unsigned shape) {
    const auto longer = [&](unsigned than) {
      std::array<MixedCounter*, kGuesses> counters;
      for (unsigned i = 0; i < kGuesses; ++i)
        counters[i] = &counters_[i][guesses[i].circumstance * kPlaces +
                                    std::min(than, 2u) * kRelative + relative(guesses[i], than)];
      return lengths_.code(coder, counters, relative(guesses[0], than), shape, wanted > than);
    };
    unsigned at = guesses[0].size < 8 ? 0 : std::min(guesses[0].size / 4 - 1, kMostBits - 1);
    if (longer(at)) {
      for (++at; at < kMostBits && longer(at);) ++at;
      return at;
    }
    while (at > 0 && !longer(at - 1)) --at;
    return at;
  }

  /// All but the leading one: two that are learned, the rest as they are.
  template <class Coder>
  std::uint32_t code_bits(Coder& coder, std::uint32_t magnitude, unsigned bits, unsigned near) {
    std::array<BitModel, 3>& leading = leading_[bits == 2 ? 1 : 0][near];
    std::uint32_t coded = 1;
    unsigned left = bits - 1;
    for (unsigned depth = 0; depth < 2 && left > 0; ++depth) {
      --left;
      BitModel& model = leading[depth == 0 ? 0 : coded - 1];
      coded = coded << 1 | (coder.bit(model, magnitude >> left & 1) ? 1u : 0u);
    }
    return coded << left | coder.raw(magnitude & ((1u << left) - 1), left);
  }

  template <class Coder>
  bool code_sign(Coder& coder, bool negative, unsigned near, Sign sign) {
    if (sign.first == kUnknown) return coder.raw(negative ? 1 : 0, 1) != 0;
    return sign_.code(
        coder,
        {&signs_[0][sign.first * kRelative + near], &signs_[1][sign.second * kRelative + near]}, 0,
        near, negative);
  }

  std::array<std::vector<MixedCounter>, kGuesses> counters_;  // of lengths
  std::array<std::vector<MixedCounter>, 2> signs_;
  Mixer<kGuesses> lengths_{kRelative, kShapes};
  Mixer<2> sign_{1, kRelative};
  std::array<std::array<std::array<BitModel, 3>, kRelative>, 2> leading_;
};

}  // namespace pstrips::inline formats
