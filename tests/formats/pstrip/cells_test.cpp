// Cells: every bit pattern comes back from its cell and its low bits, and nothing but the cell is
// needed to know how many low bits there are.

#include "formats/pstrip/payload/compact/cells.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace pstrips {
namespace {

Attribute attribute_of(const std::vector<float>& values, std::uint8_t count = 1) {
  Attribute out{.semantic = "x", .type = ComponentType::f32, .count = count, .data = {}};
  const ByteView bytes = std::as_bytes(std::span(values));
  out.data.assign(bytes.begin(), bytes.end());
  return out;
}

void expect_back(const Cells& cells, std::uint64_t bits) {
  const std::int32_t cell = cells.cell_of(bits);
  ASSERT_LE(std::abs(cell), kMaxCell);
  const std::uint64_t low = cells.low_of(bits);
  const unsigned width = cells.low_bits(cell);
  ASSERT_TRUE(width == 64 || low >> width == 0) << bits;
  EXPECT_EQ(cells.component(cell, low), bits) << cell << " + " << low;
  EXPECT_EQ(cells.cell_of(cells.middle(cell)), cell);
}

TEST(Cells, GiveEveryFloatBack) {
  std::mt19937_64 random(1);
  for (const int exponent : {-149, -140, -126, -30, -13, 0, 5, 104, 105}) {
    const Cells cells(ComponentType::f32, exponent, false);
    for (int i = 0; i < 20000; ++i) expect_back(cells, random() & 0xffff'ffff);
    for (const std::uint64_t bits : {0x0ull, 0x8000'0000ull, 0x1ull, 0x8000'0001ull, 0x7f'ffffull,
                                     0x80'0000ull, 0x7f80'0000ull, 0xff80'0000ull, 0x7fc0'0001ull})
      expect_back(cells, bits);
    // Near the cells themselves, where a number loses a bit of its mantissa at a power of two.
    for (int size = 1; size <= kMaxCell; size += size / 3 + 1)
      for (const int sign : {1, -1}) {
        const auto x = static_cast<float>(std::ldexp(double{1.0} * sign * size, exponent));
        const std::uint64_t bits = std::bit_cast<std::uint32_t>(x);
        for (const std::uint64_t near : {bits - 1, bits, bits + 1}) expect_back(cells, near);
      }
  }
}

TEST(Cells, GiveEveryDoubleBack) {
  std::mt19937_64 random(2);
  for (const int exponent : {-1074, -1030, -50, 0, 200, 1001}) {
    const Cells cells(ComponentType::f64, exponent, false);
    for (int i = 0; i < 20000; ++i) expect_back(cells, random());
    std::uniform_real_distribution<double> near(-1e6, 1e6);
    for (int i = 0; i < 2000; ++i)
      expect_back(cells, std::bit_cast<std::uint64_t>(std::ldexp(near(random), exponent)));
  }
}

TEST(Cells, GiveIntegersBack) {
  std::mt19937_64 random(3);
  struct Case {
    ComponentType type;
    int exponent;
    std::uint64_t mask;
  };
  for (const auto& [type, exponent, mask] :
       {Case{ComponentType::u8, 0, 0xff}, Case{ComponentType::i8, 0, 0xff},
        Case{ComponentType::u16, 0, 0xffff}, Case{ComponentType::i16, 0, 0xffff},
        Case{ComponentType::u32, 9, 0xffff'ffff}, Case{ComponentType::i32, 8, 0xffff'ffff}})
    for (int i = 0; i < 3000; ++i)
      expect_back(Cells(type, exponent, exponent == 0), random() & mask);
}

TEST(Cells, ChooseExactOnesWhereTheyCan) {
  const Cells cells = Cells::choose(attribute_of({0.25f, -3.5f, 0.f, 100.f}), 12);
  EXPECT_TRUE(cells.exact());
  EXPECT_EQ(cells.exponent(), -2);
  for (const float x : {0.25f, -3.5f, 0.f, 100.f}) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(x);
    EXPECT_EQ(cells.low_bits(cells.cell_of(bits)), 0u);
    EXPECT_EQ(cells.component(cells.cell_of(bits), 0), bits);
  }
}

TEST(Cells, DoNotCallMinusZeroOrInfinityExact) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const float odd : {-0.f, kInfinity, std::nanf("")}) {
    const Cells cells = Cells::choose(attribute_of({0.25f, 1.f, odd}), 12);
    EXPECT_FALSE(cells.exact());
    expect_back(cells, std::bit_cast<std::uint32_t>(odd));
  }
}

TEST(Cells, HaveTheBitsAskedForWhereValuesAreNotExact) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> inside(-1, 1);
  std::vector<float> values(3000);
  for (float& x : values) x = inside(random);
  const Cells cells = Cells::choose(attribute_of(values, 3), 12);
  EXPECT_FALSE(cells.exact());
  EXPECT_EQ(cells.exponent(), 1 - 12);
}

TEST(Cells, AreValidOrNot) {
  EXPECT_TRUE(Cells::is_valid(ComponentType::f32, -149));
  EXPECT_FALSE(Cells::is_valid(ComponentType::f32, -150));
  EXPECT_TRUE(Cells::is_valid(ComponentType::f32, 105));
  EXPECT_FALSE(Cells::is_valid(ComponentType::f32, 106));
  EXPECT_TRUE(Cells::is_valid(ComponentType::u32, 9));
  EXPECT_FALSE(Cells::is_valid(ComponentType::u32, 10));
  EXPECT_FALSE(Cells::is_valid(ComponentType::u16, 1));
}

TEST(PositionCells, GivePointsOfAGridBack) {
  const PositionGrid grid{.step = 0.00731f, .origin = {-1000, 5, 123456}};
  ASSERT_TRUE(PositionCells::is_valid(grid, ComponentType::f32));
  const PositionCells cells(grid, ComponentType::f32);
  for (unsigned axis = 0; axis < 3; ++axis)
    for (std::int32_t cell = -5000; cell < 5000; ++cell)
      ASSERT_EQ(cells.cell_of(cells.component(cell, axis), axis), cell);
}

TEST(PositionCells, RefuseGridsThatAreNone) {
  const auto is_valid = [](PositionGrid grid, ComponentType type = ComponentType::f32) {
    return PositionCells::is_valid(grid, type);
  };
  EXPECT_FALSE(is_valid({.step = 0}));
  EXPECT_TRUE(is_valid({.step = 0}, ComponentType::i16));
  EXPECT_FALSE(is_valid({.step = 0}, ComponentType::i32));
  EXPECT_FALSE(is_valid({.step = 1}, ComponentType::i16));
  EXPECT_TRUE(is_valid({.step = 1}, ComponentType::i32));
  EXPECT_FALSE(is_valid({.step = 2}, ComponentType::i32));
  EXPECT_FALSE(is_valid({.step = 1, .exact = false}, ComponentType::u32));
  EXPECT_TRUE(is_valid({.step = 512, .exact = false}, ComponentType::u32));
  EXPECT_FALSE(is_valid({.step = 1024, .exact = false}, ComponentType::u32));
  EXPECT_FALSE(is_valid({.step = 3, .exact = false}, ComponentType::u32));
  EXPECT_FALSE(is_valid({.step = 4, .origin = {0, 0, 1}, .exact = false}, ComponentType::i32));
  EXPECT_FALSE(is_valid({.step = -1}));
  EXPECT_FALSE(is_valid({.step = std::nanf("")}));
  EXPECT_FALSE(is_valid({.step = 0.3f, .exact = false}));
  EXPECT_TRUE(is_valid({.step = 0.25f, .exact = false}));
  EXPECT_FALSE(is_valid({.step = 0.25f, .origin = {1, 0, 0}, .exact = false}));
  EXPECT_FALSE(is_valid({.step = 1, .origin = {std::int64_t{1} << 40, 0, 0}}));
}

}  // namespace
}  // namespace pstrips
