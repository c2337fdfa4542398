// Which cells an attribute gets, and that its elements come back from them.

#include "formats/pstrip/payload/compact/attribute_cells.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>

namespace pstrips {
namespace {

Attribute attribute_of(const std::vector<float>& values, std::uint8_t count) {
  Attribute out{"NORMAL", ComponentType::f32, count, false, Bytes(4 * values.size())};
  std::memcpy(out.data.data(), values.data(), out.data.size());
  return out;
}

/// Every third point of a square, with a sign behind if there are four components.
Attribute points_of(unsigned bits, std::uint8_t count) {
  const Octahedron octahedron(bits);
  const std::int32_t stride = std::max(3, octahedron.reach() / 40);
  std::vector<float> values;
  for (std::int32_t u = -octahedron.reach(); u <= octahedron.reach(); u += stride)
    for (std::int32_t v = -octahedron.reach(); v <= octahedron.reach(); v += stride) {
      for (const std::int64_t c : octahedron.unit(octahedron.placed(u, v)))
        values.push_back(std::ldexp(static_cast<float>(c), -24));
      if (count == 4) values.push_back(u < v ? -1.f : 1.f);
    }
  return attribute_of(values, count);
}

void expect_back(const AttributeCells& cells, const Attribute& attribute) {
  Attribute back = attribute.format();
  back.data.resize(attribute.data.size());
  std::vector<std::int32_t> row(cells.columns());
  for (std::size_t i = 0; i < attribute.elements(); ++i) {
    cells.cells_of(attribute, i, row.data());
    cells.store(row.data(), back, i);
  }
  EXPECT_EQ(back, attribute);
}

TEST(AttributeCells, AreDirectionsWhereAllElementsAre) {
  for (unsigned bits = Octahedron::kMinBits; bits <= Octahedron::kMaxBits; ++bits)
    for (const auto count : {std::uint8_t{3}, std::uint8_t{4}}) {
      const Attribute attribute = points_of(bits, count);
      const AttributeCells cells = AttributeCells::choose(attribute, 12);
      ASSERT_TRUE(cells.octahedron()) << bits;
      EXPECT_EQ(cells.octahedron()->bits(), bits);
      EXPECT_EQ(cells.columns(), count - 1u);
      EXPECT_TRUE(cells.exact());
      expect_back(cells, attribute);
    }
}

TEST(AttributeCells, AreOfComponentsWhereOneElementIsNoDirection) {
  const float kOthers[] = {0.5f, -0.f, NAN, INFINITY, 1e-30f};
  for (const float other : kOthers) {
    Attribute attribute = points_of(8, 3);
    for (const std::size_t c : {0, 1, 2})
      set_bits(attribute, 7, c, std::bit_cast<std::uint32_t>(other));
    EXPECT_FALSE(AttributeCells::choose(attribute, 12).octahedron()) << other;
  }
  Attribute tangent = points_of(8, 4);
  set_bits(tangent, 3, 3, std::bit_cast<std::uint32_t>(0.5f));
  EXPECT_FALSE(AttributeCells::choose(tangent, 12).octahedron());
  EXPECT_EQ(AttributeCells::choose(tangent, 12).columns(), 4u);
}

// Whatever numbers a file has for cells, there is an element.
TEST(AttributeCells, TakeCellsBeyondTheSquare) {
  const AttributeCells cells(Octahedron(8), 3);
  Attribute attribute = attribute_of({9, 9, 9}, 3);
  const std::int32_t far[] = {kMaxCell, -kMaxCell};
  cells.store(far, attribute, 0);
  EXPECT_EQ(attribute, attribute_of({0, 0, -1}, 3));
}

}  // namespace
}  // namespace pstrips
