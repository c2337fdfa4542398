#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "formats/pstrip/payload/compact/rans.h"

// Bits whose probability several counters guess, each of what happened under other circumstances.
// The guesses are added up as logarithms of odds, with weights that learn what each is worth
// (logistic mixing, as in the PAQ programs). [Mahoney05]

namespace pstrips::inline formats {

/// Probability and logarithm of odds, in units of 1 / 256.
class LogisticTable {
 public:
  static constexpr int kMost = 2047;

  constexpr LogisticTable() {
    int odds = -kMost;
    for (int p = 0; p < kGuesses; ++p) {
      while (odds < kMost && probability(odds) < 8 * p + 4) ++odds;
      odds_[static_cast<std::size_t>(p)] = static_cast<std::int16_t>(odds);
    }
  }
  /// Of kShares. Precondition: |odds| <= kMost.
  static constexpr int probability(int odds) {
    const int at = odds + kMost + 1, part = at % kStep;
    const auto i = static_cast<std::size_t>(at / kStep);
    return (kKnots[i] * (kStep - part) + kKnots[i + 1] * part + kStep / 2) / kStep;
  }
  /// The least odds that come to a probability of 16 bits, of which 12 count.
  int odds(unsigned probability) const { return odds_[probability >> 4]; }

 private:
  static constexpr int kGuesses = 4096, kStep = 128;
  /// 2^15 / (1 + exp(-i / 2)) for i from -16 to 16.
  static constexpr std::array<int, 33> kKnots = {
      11,    18,    30,    49,    81,    133,   219,   360,   589,   961,   1554,
      2486,  3906,  5978,  8813,  12371, 16384, 20397, 23955, 26790, 28862, 30282,
      31214, 31807, 32179, 32408, 32549, 32635, 32687, 32719, 32738, 32750, 32757};
  std::array<std::int16_t, kGuesses> odds_{};
};
inline constexpr LogisticTable kLogistic;

/// How often a bit was 1 under certain circumstances.
class MixedCounter {
 public:
  /// What it says of the next bit: less while it has seen little.
  int odds() const { return kLogistic.odds(ones_) * kTrust[seen_] >> 8; }
  /// guess  of kShares; what a counter starts from that has seen nothing
  void learn(bool one, int guess) {
    if (seen_ == 0) ones_ = static_cast<std::uint16_t>(std::clamp(2 * guess, 64, kAll - 64));
    const int rate = kRates[seen_];
    if (seen_ + 1u < kRates.size()) ++seen_;
    const int off = (one ? kAll : 0) - int{ones_};
    ones_ = static_cast<std::uint16_t>(ones_ + (std::int64_t{off} * rate >> 16));
  }

 private:
  static constexpr int kAll = 0xffff;
  /// The step when so many were seen, in units of 2^-16.
  static constexpr auto kRates = [] {
    std::array<int, 121> out{};
    for (unsigned n = 0; n < out.size(); ++n) out[n] = static_cast<int>((1u << 17) / (2 * n + 6));
    return out;
  }();

  /// After so many were seen, in units of 2^-8.
  static constexpr auto kTrust = [] {
    std::array<int, kRates.size()> out{};
    for (unsigned n = 0; n < out.size(); ++n) out[n] = static_cast<int>(256 * n / (n + 2));
    return out;
  }();

  std::uint16_t ones_ = 1u << 15;
  std::uint8_t seen_ = 0;
};

/// What the guesses of N counters are worth, by two circumstances, each with weights of its own.
template <unsigned N>
class Mixer {
 public:
  /// How many cases each of the circumstances has.
  Mixer(unsigned first, unsigned second) : first_(first, kStart), second_(second, kStart) {}

  /// counters  learn as well
  template <class Coder>
  bool code(Coder& coder, const std::array<MixedCounter*, N>& counters, unsigned first,
            unsigned second, bool value) {
    std::array<int, N + 1> odds;
    for (unsigned i = 0; i < N; ++i) odds[i] = counters[i]->odds();
    odds[N] = kConstant;
    const int a = sum(first_[first], odds), b = sum(second_[second], odds);
    const int guess = LogisticTable::probability((a + b) >> 1);
    const bool one = coder.bit(kShares - static_cast<std::uint32_t>(guess), value);
    learn(first_[first], odds, LogisticTable::probability(a), one);
    learn(second_[second], odds, LogisticTable::probability(b), one);
    for (MixedCounter* counter : counters) counter->learn(one, guess);
    return one;
  }

 private:
  static constexpr int kConstant = 256;
  static constexpr std::int32_t kLargest = 1 << 20;
  using Weights = std::array<std::int32_t, N + 1>;  // in units of 2^-16
  static constexpr Weights kStart = [] {
    Weights out{};
    for (std::int32_t& weight : out) weight = 5 << 12;
    return out;
  }();

  static int sum(const Weights& weights, const std::array<int, N + 1>& odds) {
    std::int64_t out = 0;
    for (unsigned i = 0; i <= N; ++i) out += std::int64_t{weights[i]} * odds[i];
    return static_cast<int>(
        std::clamp<std::int64_t>(out >> 16, -LogisticTable::kMost, LogisticTable::kMost));
  }
  /// guess  of these weights alone
  static void learn(Weights& weights, const std::array<int, N + 1>& odds, int guess, bool one) {
    const int off = 3 * ((one ? static_cast<int>(kShares) : 0) - guess);
    for (unsigned i = 0; i <= N; ++i)
      weights[i] =
          std::clamp(weights[i] + ((odds[i] * off + (1 << 13)) >> 14), -kLargest, kLargest);
  }

  std::vector<Weights> first_, second_;
};

}  // namespace pstrips::inline formats
