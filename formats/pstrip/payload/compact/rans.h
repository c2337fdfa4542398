#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "core/bytes.h"
#include "formats/pstrip/container/part.h"

// Adaptive entropy coding: a model gives each symbol a share of 2^15, a range coder (rANS) spends
// about -log2(share) bits on it, and the model learns. All arithmetic is on integers of stated
// width, so that the bytes are the same on every machine. [Duda13]
//
// A coder in a template is a RansWriter or a RansReader: both have bit, symbol, choice and raw,
// which take the value to write (a reader ignores it) and return the value that stands there. So
// one function says what a record looks like, and the two sides cannot drift apart. part() says
// what the codes from there on are spent on, for whoever counts them.

namespace pstrips::inline formats {

inline constexpr unsigned kShareBits = 15;
inline constexpr std::uint32_t kShares = 1u << kShareBits;

/// How probable a zero is, learned.
class BitModel {
 public:
  std::uint32_t zeros() const { return zeros_; }  ///< of kShares; 32 to kShares - 32
  void learn(bool one) {
    const unsigned rate = seen_ < 8 ? 3 : seen_ < 24 ? 4 : seen_ < 60 ? 5 : 6;
    if (seen_ < 60) ++seen_;
    if (one)
      zeros_ = static_cast<std::uint16_t>(zeros_ - ((zeros_ - kLeast) >> rate));
    else
      zeros_ = static_cast<std::uint16_t>(zeros_ + ((kShares - kLeast - zeros_) >> rate));
  }

 private:
  static constexpr std::uint32_t kLeast = 32;
  std::uint16_t zeros_ = kShares / 2;
  std::uint8_t seen_ = 0;
};

/// Eight numbers side by side, as the compiler's own vector.
using Short8 = std::int16_t __attribute__((vector_size(16)));

/// The shares of sixteen symbols, learned; each keeps at least one.
class SymbolModel {
 public:
  static constexpr unsigned kSymbols = 16;

  SymbolModel() {
    for (unsigned i = 0; i < kSymbols; ++i)
      starts_[i] = static_cast<std::int16_t>(i * (kShares / kSymbols));
  }
  std::uint32_t start(unsigned symbol) const { return static_cast<std::uint32_t>(starts_[symbol]); }
  std::uint32_t end(unsigned symbol) const {
    return symbol + 1 == kSymbols ? kShares : start(symbol + 1);
  }
  /// The symbol whose shares hold `share`.
  unsigned at(std::uint32_t share) const {
    const auto limit = static_cast<std::int16_t>(share);
    const Short8 not_after = (half(0) <= limit) + (half(8) <= limit);  // of two, less than 0
    std::array<std::uint64_t, 2> lanes;
    const Short8 counts = -not_after;
    std::memcpy(&lanes, &counts, sizeof lanes);
    constexpr std::uint64_t kSumOfLanes = 0x0001'0001'0001'0001;
    return static_cast<unsigned>((lanes[0] + lanes[1]) * kSumOfLanes >> 48) - 1;
  }
  void learn(unsigned symbol) {
    const int rate = seen_ < 4     ? 2
                     : seen_ < 10  ? 3
                     : seen_ < 20  ? 4
                     : seen_ < 50  ? 5
                     : seen_ < 120 ? 6
                                   : 7;
    if (seen_ < 120) ++seen_;
    constexpr Short8 kIndex = {0, 1, 2, 3, 4, 5, 6, 7};
    constexpr std::int16_t kRest = kShares - kSymbols;
    for (const unsigned first : {0u, 8u}) {
      const Short8 index = kIndex + static_cast<std::int16_t>(first), starts = half(first);
      const Short8 after = (index > static_cast<std::int16_t>(symbol)) & kRest;
      const Short8 learned = starts + ((index + after - starts) >> static_cast<std::int16_t>(rate));
      std::memcpy(&starts_[first], &learned, sizeof learned);
    }
  }

 private:
  Short8 half(unsigned first) const {
    Short8 out;
    std::memcpy(&out, &starts_[first], sizeof out);
    return out;
  }
  std::array<std::int16_t, kSymbols> starts_;  // all below kShares
  std::uint8_t seen_ = 0;
};

/// Choices among a few, by weights that somebody else computed: each keeps at least one share.
class Shares {
 public:
  static constexpr unsigned kMost = 64;
  static constexpr std::uint32_t kLargestWeight = kShares;

  Shares() = default;
  /// weights  1 to kMost of them; their sum is at least kLargestWeight and below 2^31
  explicit Shares(std::span<const std::uint32_t> weights);

  unsigned count() const { return count_; }
  std::uint32_t start(unsigned i) const { return starts_[i]; }
  std::uint32_t of(unsigned i) const { return starts_[i + 1] - starts_[i]; }
  /// The choice whose shares hold `share`.
  unsigned at(std::uint32_t share) const {
    unsigned i = 0;
    while (share >= starts_[i + 1]) ++i;
    return i;
  }

 private:
  unsigned count_ = 1;
  std::array<std::uint32_t, kMost + 1> starts_;
};

inline Shares::Shares(std::span<const std::uint32_t> weights)
    : count_(static_cast<unsigned>(weights.size())) {
  assert(count_ > 0 && count_ <= kMost);
  std::uint32_t sum = 0;
  for (const std::uint32_t weight : weights) sum += weight;
  const std::uint32_t scale = ((kShares - count_) << 16) / sum;
  std::uint32_t at = 0;
  for (unsigned i = 0; i < count_; ++i) {
    starts_[i] = at;
    at += 1 + (weights[i] * scale >> 16);
  }
  starts_[count_] = kShares;  // the last one gets what is left
}

/// Collects symbols and writes them as one run of bytes.
class RansWriter {
 public:
  static constexpr bool kReads = false;

  bool bit(BitModel& model, bool value) {
    if (value)
      put(model.zeros(), kShares - model.zeros());
    else
      put(0, model.zeros());
    model.learn(value);
    return value;
  }
  /// zeros  of kShares, neither none nor all
  bool bit(std::uint32_t zeros, bool value) {
    put(value ? zeros : 0, value ? kShares - zeros : zeros);
    return value;
  }
  /// Precondition: value < SymbolModel::kSymbols.
  unsigned symbol(SymbolModel& model, unsigned value) {
    assert(value < SymbolModel::kSymbols);
    put(model.start(value), model.end(value) - model.start(value));
    model.learn(value);
    return value;
  }
  /// Precondition: value < shares.count().
  unsigned choice(const Shares& shares, unsigned value) {
    put(shares.start(value), shares.of(value));
    return value;
  }
  /// `bits` bits that nothing is known of. Precondition: value < 2^bits, bits <= 32.
  std::uint32_t raw(std::uint32_t value, unsigned bits) {
    for (std::uint32_t rest = value; bits > 0;) {
      const unsigned n = bits < kRawBits ? bits : kRawBits;
      put((rest & ((1u << n) - 1)) << (kShareBits - n), 1u << (kShareBits - n));
      rest >>= n;
      bits -= n;
    }
    return value;
  }

  void part(Part) {}

  /// The bytes of all symbols so far; the writer is empty afterwards, the models go on.
  Bytes finish();

  static constexpr unsigned kRawBits = 12;  ///< in one step

 private:
  struct Step {
    std::uint16_t start, shares;
  };
  void put(std::uint32_t start, std::uint32_t shares) {
    steps_.push_back({static_cast<std::uint16_t>(start), static_cast<std::uint16_t>(shares)});
  }
  std::vector<Step> steps_;
};

/// The words of a run, from bytes that nobody vouches for: past their end there are zeros.
class RansState {
 public:
  explicit RansState(ByteView bytes);

  /// All bytes are used up, none too many, and the coder is where the writer began. False for
  /// nearly all bytes that no writer made.
  bool complete() const;
  /// Bytes were missing: what was read since is made up.
  bool overrun() const { return overrun_; }

 protected:
  std::uint32_t share() const { return state_ & (kShares - 1); }
  void take(std::uint32_t start, std::uint32_t shares) {
    state_ = shares * (state_ >> kShareBits) + share() - start;
    if (state_ < (1u << 16)) state_ = state_ << 16 | word();
  }

 private:
  std::uint32_t word();

  ByteView bytes_;
  std::size_t at_ = 0;
  std::uint32_t state_ = 0;
  bool overrun_ = false;
};

/// Counts nothing.
struct NoTally {
  void part(Part) {}
  void add(std::uint32_t) {}
};

/// Reads back what a RansWriter wrote.
///
/// Tally: part(p) begins codes of a part, add(shares) is one that had so many of kShares
template <class Tally>
class TallyingReader : public RansState {
 public:
  static constexpr bool kReads = true;

  explicit TallyingReader(ByteView bytes, Tally tally = {}) : RansState(bytes), tally_(tally) {}

  void part(Part p) { tally_.part(p); }
  bool bit(BitModel& model, bool = false) {
    const bool one = share() >= model.zeros();
    if (one)
      take(model.zeros(), kShares - model.zeros());
    else
      take(0, model.zeros());
    model.learn(one);
    return one;
  }
  bool bit(std::uint32_t zeros, bool = false) {
    const bool one = share() >= zeros;
    take(one ? zeros : 0, one ? kShares - zeros : zeros);
    return one;
  }
  unsigned symbol(SymbolModel& model, unsigned = 0) {
    const unsigned value = model.at(share());
    take(model.start(value), model.end(value) - model.start(value));
    model.learn(value);
    return value;
  }
  unsigned choice(const Shares& shares, unsigned = 0) {
    const unsigned value = shares.at(share());
    take(shares.start(value), shares.of(value));
    return value;
  }
  std::uint32_t raw(std::uint32_t, unsigned bits) {
    if (bits <= RansWriter::kRawBits) return raw_step(bits);
    std::uint32_t value = 0;
    for (unsigned at = 0; at < bits; at += RansWriter::kRawBits)
      value |= raw_step(std::min(bits - at, RansWriter::kRawBits)) << at;
    return value;
  }

 private:
  std::uint32_t raw_step(unsigned bits) {
    const std::uint32_t part = share() >> (kShareBits - bits);
    take(part << (kShareBits - bits), 1u << (kShareBits - bits));
    return part;
  }
  void take(std::uint32_t start, std::uint32_t shares) {
    tally_.add(shares);
    RansState::take(start, shares);
  }

  [[no_unique_address]] Tally tally_;
};

using RansReader = TallyingReader<NoTally>;

}  // namespace pstrips::inline formats
