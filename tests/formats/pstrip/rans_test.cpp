#include "formats/pstrip/payload/compact/rans.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace pstrips {
namespace {

struct Drawn {
  enum Kind : std::uint8_t { bit, symbol, raw } kind;
  unsigned model;
  std::uint32_t value;
  unsigned bits = 0;
};

struct Models {
  std::array<BitModel, 4> bits;
  std::array<SymbolModel, 4> symbols;
};

template <class Coder>
std::uint32_t code(Coder& coder, Models& models, const Drawn& d) {
  switch (d.kind) {
    case Drawn::bit:
      return coder.bit(models.bits[d.model], d.value != 0) ? 1 : 0;
    case Drawn::symbol:
      return coder.symbol(models.symbols[d.model], d.value);
    default:
      return coder.raw(d.value, d.bits);
  }
}

std::vector<Drawn> draw(std::uint32_t seed, std::size_t count) {
  std::mt19937 random(seed);
  std::vector<Drawn> out;
  for (std::size_t i = 0; i < count; ++i) {
    const auto kind = static_cast<Drawn::Kind>(random() % 3);
    Drawn d{kind, static_cast<unsigned>(random() % 4), 0, 0};
    if (kind == Drawn::bit) d.value = random() % 100 < 7 * d.model ? 1 : 0;
    if (kind == Drawn::symbol) d.value = std::min<std::uint32_t>(random() % 16, random() % 16);
    if (kind == Drawn::raw) {
      d.bits = static_cast<unsigned>(random() % 33);
      const auto any = static_cast<std::uint32_t>(random());
      d.value = d.bits == 32 ? any : any & ((1u << d.bits) - 1);
    }
    out.push_back(d);
  }
  return out;
}

Bytes write(const std::vector<Drawn>& drawn, Models& models) {
  RansWriter writer;
  for (const Drawn& d : drawn) code(writer, models, d);
  return writer.finish();
}

TEST(Rans, ReadsBackWhatWasWritten) {
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    Models write_models, read_models;
    // Three runs: the models go on from one to the next.
    for (std::uint32_t run = 0; run < 3; ++run) {
      const std::vector<Drawn> drawn = draw(3 * seed + run, seed * 10);
      const Bytes bytes = write(drawn, write_models);
      RansReader reader(bytes);
      for (const Drawn& d : drawn) ASSERT_EQ(code(reader, read_models, d), d.value);
      EXPECT_TRUE(reader.complete());
    }
  }
}

TEST(Rans, KnowsThatBytesAreMissingOrTooMany) {
  const std::vector<Drawn> drawn = draw(1, 300);
  Models models;
  const Bytes bytes = write(drawn, models);
  const auto complete = [&](ByteView some) {
    Models read_models;
    RansReader reader(some);
    for (const Drawn& d : drawn) code(reader, read_models, d);
    return reader.complete();
  };
  EXPECT_TRUE(complete(bytes));
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(complete(ByteView(bytes).first(size))) << size;
  Bytes longer = bytes;
  longer.push_back(std::byte{0});
  EXPECT_FALSE(complete(longer));
}

TEST(Rans, ChoicesReadBackAndCostWhatTheirWeightsSay) {
  std::mt19937 random(5);
  std::vector<Shares> shares;
  std::vector<unsigned> chosen;
  RansWriter writer;
  double bits = 0;
  for (int i = 0; i < 2000; ++i) {
    std::array<std::uint32_t, Shares::kMost> weights;
    const unsigned count = 1 + static_cast<unsigned>(random() % Shares::kMost);
    for (std::uint32_t& w : weights)
      w = random() % 3 == 0 ? 0 : static_cast<std::uint32_t>(random() % (kShares + 1));
    weights[random() % count] = Shares::kLargestWeight;
    shares.emplace_back(std::span(weights).first(count));
    chosen.push_back(static_cast<unsigned>(random() % count));
    writer.choice(shares.back(), chosen.back());
    ASSERT_EQ(shares.back().start(0), 0u);
    std::uint32_t sum = 0;
    for (unsigned k = 0; k < count; ++k) {
      ASSERT_GE(shares.back().of(k), 1u);
      sum += shares.back().of(k);
    }
    ASSERT_EQ(sum, kShares);
    bits -= std::log2(static_cast<double>(shares.back().of(chosen.back())) / kShares);
  }
  const Bytes bytes = writer.finish();
  EXPECT_NEAR(8.0 * static_cast<double>(bytes.size()), bits, 0.002 * bits + 32);
  RansReader reader(bytes);
  for (std::size_t i = 0; i < shares.size(); ++i)
    ASSERT_EQ(reader.choice(shares[i]), chosen[i]) << i;
  EXPECT_TRUE(reader.complete());
}

// A model that never learns is invisible to a round trip: the bytes must come near the entropy.
TEST(Rans, ComesNearTheEntropy) {
  constexpr std::size_t kCount = 100'000;
  std::mt19937 random(7);
  RansWriter writer;
  BitModel bit;
  SymbolModel symbol;
  const double ones = 0.05;
  std::array<std::size_t, 16> counts{};
  std::bernoulli_distribution is_one(ones);
  std::geometric_distribution<unsigned> draw_symbol(0.4);
  for (std::size_t i = 0; i < kCount; ++i) {
    writer.bit(bit, is_one(random));
    const unsigned s = std::min(draw_symbol(random), 15u);
    ++counts[s];
    writer.symbol(symbol, s);
  }
  double entropy = -ones * std::log2(ones) - (1 - ones) * std::log2(1 - ones);
  for (const std::size_t n : counts)
    if (n > 0)
      entropy -= static_cast<double>(n) / kCount * std::log2(static_cast<double>(n) / kCount);
  const double written = 8.0 * static_cast<double>(writer.finish().size()) / kCount;
  EXPECT_LT(written, 1.03 * entropy);
  EXPECT_GT(written, 0.99 * entropy);
}

// The same bytes from any compiler: a hash (FNV-1a) of a stream that uses all there is.
TEST(Rans, BytesAreFixed) {
  Models models;
  RansWriter writer;
  std::uint32_t state = 1;
  for (int i = 0; i < 5000; ++i) {
    state = state * 1664525u + 1013904223u;
    const std::uint32_t top = state >> 16;
    writer.bit(models.bits[top % 4], top % 11 == 0);
    writer.symbol(models.symbols[top % 4], std::min(top % 16, top / 16 % 16));
    writer.raw(top & 0x1fff, 13);
  }
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const std::byte b : writer.finish())
    hash = (hash ^ std::to_integer<std::uint64_t>(b)) * 0x100000001b3u;
  EXPECT_EQ(hash, 0x1212f98cdb104083u) << std::hex << hash;
}

}  // namespace
}  // namespace pstrips
