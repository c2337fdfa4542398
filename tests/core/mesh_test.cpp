#include "core/mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pstrips {
namespace {

Attribute attribute_of(ComponentType type, bool normalized) {
  Attribute a{.semantic = "A", .type = type, .count = 2, .normalized = normalized, .data = {}};
  a.data.resize(2 * a.element_bytes());
  return a;
}

TEST(SetComponent, RoundsToTheNearestThatTheTypeHas) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const struct {
    ComponentType type;
    bool normalized;
    double given, stored;
  } kCases[] = {
      {ComponentType::i8, false, 2.6, 3},
      {ComponentType::i8, false, 2.5, 2},
      {ComponentType::i8, false, -1000, -128},
      {ComponentType::u8, false, -3, 0},
      {ComponentType::u8, true, 0.5, 128 / 255.0},
      {ComponentType::i16, true, -2, -1},
      {ComponentType::u16, false, kInfinity, 65535},
      {ComponentType::i32, false, 1e300, 2147483647},
      {ComponentType::u32, false, 4294967294.6, 4294967295.0},
      {ComponentType::u32, false, std::nan(""), 0},
      {ComponentType::f32, false, 1.0 / 3, 1.f / 3},
      {ComponentType::f32, false, -1e300, -std::numeric_limits<float>::max()},
      {ComponentType::f32, false, -kInfinity, -kInfinity},
      {ComponentType::f64, true, 1.0 / 3, 1.0 / 3},
  };
  for (const auto& c : kCases) {
    SCOPED_TRACE(c.given);
    Attribute a = attribute_of(c.type, c.normalized);
    set_component(a, 1, 0, c.given);
    EXPECT_EQ(component(a, 1, 0), c.stored);
    for (const auto& [i, k] : {std::pair{0, 0}, std::pair{0, 1}, std::pair{1, 1}})
      EXPECT_EQ(component(a, std::size_t(i), std::size_t(k)), 0);
  }
}

TEST(SetComponent, StoresWhatWasReadAsItWas) {
  for (const ComponentType type :
       {ComponentType::i8, ComponentType::u8, ComponentType::i16, ComponentType::u16}) {
    Attribute a = attribute_of(type, true), b = a;
    for (int k = -127; k <= 127; ++k) {
      Attribute plain = attribute_of(type, false);
      set_component(plain, 0, 1, k);
      a.data = plain.data;
      set_component(b, 0, 1, component(a, 0, 1));
      EXPECT_EQ(a.data, b.data) << k;
    }
  }
}

}  // namespace
}  // namespace pstrips
