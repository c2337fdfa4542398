// Quantized attributes: how far they move, what stays as it is, and that files of the compact
// profile bring them back exactly.

#include "converters/attribute_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <utility>

#include "converters/decode.h"
#include "converters/encode.h"
#include "core/gather.h"
#include "formats/pstrip/container/binary.h"
#include "formats/pstrip/payload/compact/attribute_cells.h"
#include "tests/support/meshes.h"

namespace pstrips {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// A grid of squares with all kinds of attributes; each wedge on its own vertex.
Mesh dressed(Index side, std::uint32_t seed) {
  Mesh mesh = test::grid(side);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> any(-1, 1);
  const auto add = [&](const char* semantic, std::uint8_t count, auto&& element) {
    Attribute a{semantic, ComponentType::f32, count, false, {}};
    a.data.resize(a.element_bytes() * mesh.wedge_count());
    for (Index w = 0; w < mesh.wedge_count(); ++w) {
      const std::vector<float> values = element(w);
      for (std::size_t c = 0; c < count; ++c) set_component(a, w, c, values[c]);
    }
    mesh.wedge_attributes.push_back(std::move(a));
  };
  const auto x = [&](Index w) { return static_cast<float>(component(mesh.position, w, 0)); };
  const auto y = [&](Index w) { return static_cast<float>(component(mesh.position, w, 1)); };
  add("NORMAL", 3, [&](Index) { return std::vector{any(random), any(random), 2 * any(random)}; });
  add("TANGENT", 4, [&](Index w) { return std::vector{1.f, x(w), -y(w), w % 2 ? 1.f : -1.f}; });
  add("TEXCOORD_0", 2, [&](Index w) {
    return std::vector{x(w) / 7 - 3, y(w) / 9 + any(random) / 50};
  });
  add("COLOR_0", 4, [&](Index w) {
    return std::vector{std::abs(any(random)), 0.5f, -0.f, w % 3 ? 1.f : 0.f};
  });
  add("WEIGHTS_0", 4, [&](Index) {
    const float a = std::abs(any(random)), b = (1 - a) * std::abs(any(random));
    return std::vector{a, b, 1 - a - b, 0.f};
  });
  mesh.wedge_attributes.push_back(
      {"JOINTS_0", ComponentType::u8, 4, false, Bytes(4 * mesh.wedge_count(), std::byte{3})});
  return mesh;
}

Model model_of(std::vector<Mesh> meshes) {
  Model model;
  model.meshes = std::move(meshes);
  return model;
}

Mesh with_wedge_per_corner(Mesh mesh) {
  std::vector<Index> vertices;
  for (const Index w : mesh.corners) vertices.push_back(mesh.vertex_of(w));
  for (Attribute& a : mesh.wedge_attributes) a = gather(a, mesh.corners);
  std::iota(mesh.corners.begin(), mesh.corners.end(), Index{0});
  mesh.wedge_vertex = std::move(vertices);
  return mesh;
}

const Attribute& attribute(const Mesh& mesh, std::string_view semantic) {
  return *std::ranges::find(mesh.wedge_attributes, semantic, &Attribute::semantic);
}

double range_of(const Attribute& a) {
  double widest = 0;
  for (std::size_t c = 0; c < a.count; ++c) {
    double low = component(a, 0, c), high = low;
    for (std::size_t i = 0; i < a.elements(); ++i) {
      low = std::min(low, component(a, i, c));
      high = std::max(high, component(a, i, c));
    }
    widest = std::max(widest, high - low);
  }
  return widest;
}

double farthest(const Attribute& a, const Attribute& b) {
  double out = 0;
  for (std::size_t i = 0; i < a.elements() * a.count; ++i)
    out = std::max(out, std::abs(component(a, 0, i) - component(b, 0, i)));
  return out;
}

TEST(AttributeGrids, MoveNumbersByHalfAStepAtMost) {
  for (unsigned bits = AttributeBits::kMin; bits <= AttributeBits::kMax; ++bits) {
    const Model model = model_of({dressed(8, bits)});
    Mesh moved = model.meshes[0];
    const auto done = AttributeGrids(model, {.texture = bits, .color = bits}).apply(moved);
    ASSERT_EQ(done.size(), 2u);
    for (const QuantizedAttribute& q : done) {
      const Attribute& before = attribute(model.meshes[0], q.semantic);
      const Attribute& after = attribute(moved, q.semantic);
      EXPECT_EQ(q.kept, "");
      EXPECT_EQ(q.bits, bits);
      EXPECT_EQ(q.error, farthest(before, after));
      EXPECT_LE(q.error, range_of(before) / std::ldexp(1, int(bits)) * 0.51 + 0x1p-22);
      EXPECT_TRUE(AttributeCells::choose(after, 12).exact());
    }
    EXPECT_EQ(attribute(moved, "NORMAL"), attribute(model.meshes[0], "NORMAL"));
  }
}

// A square of N bits has 2^N - 1 points along a side, which is twice as long as from the middle to
// an axis: a quarter of the sphere.
TEST(AttributeGrids, TurnDirectionsByLittle) {
  for (unsigned bits = AttributeBits::kMin; bits <= AttributeBits::kMaxDirection; ++bits) {
    const Model model = model_of({dressed(8, bits)});
    Mesh moved = model.meshes[0];
    const auto done = AttributeGrids(model, {.normal = bits}).apply(moved);
    ASSERT_EQ(done.size(), 2u);
    for (const QuantizedAttribute& q : done) {
      EXPECT_EQ(q.kept, "");
      EXPECT_GT(q.error, 0);
      EXPECT_LE(q.error, 90.0 / (std::ldexp(1, int(bits) - 1) - 1));
    }
    const Attribute& tangent = attribute(moved, "TANGENT");
    for (std::size_t i = 0; i < tangent.elements(); ++i)
      ASSERT_EQ(component(tangent, i, 3), i % 2 ? 1 : -1);
  }
}

TEST(AttributeGrids, MakeFloatsOfDoubles) {
  const Model model = model_of({dressed(8, 5)});
  Model doubles = model;
  for (Attribute& a : doubles.meshes[0].wedge_attributes) {
    if (a.type != ComponentType::f32) continue;
    const Attribute from = std::exchange(a, a.format());
    a.type = ComponentType::f64;
    a.data.resize(2 * from.data.size());
    for (std::size_t i = 0; i < from.elements() * from.count; ++i)
      set_component(a, 0, i, component(from, 0, i));
  }
  Mesh from_floats = model.meshes[0], from_doubles = doubles.meshes[0];
  AttributeGrids(model, {8, 8, 8, 8}).apply(from_floats);
  AttributeGrids(doubles, {8, 8, 8, 8}).apply(from_doubles);
  EXPECT_EQ(from_doubles, from_floats);
}

TEST(AttributeGrids, KeepSumsOfWeights) {
  const Model model = model_of({dressed(8, 1)});
  for (unsigned bits = 4; bits <= 16; ++bits) {
    Mesh moved = model.meshes[0];
    const auto done = AttributeGrids(model, {.other = bits}).apply(moved);
    ASSERT_EQ(done.size(), 2u);
    const Attribute& weights = attribute(moved, "WEIGHTS_0");
    for (std::size_t i = 0; i < weights.elements(); ++i) {
      double sum = 0;
      for (std::size_t c = 0; c < 4; ++c) {
        EXPECT_GE(component(weights, i, c), 0);
        sum += component(weights, i, c);
      }
      ASSERT_EQ(sum, 1);
    }
    EXPECT_EQ(done[1].kept, "is of integers");  // joints
    EXPECT_EQ(attribute(moved, "JOINTS_0"), attribute(model.meshes[0], "JOINTS_0"));
  }
}

TEST(AttributeGrids, LeaveWhatHasNoPlace) {
  struct Row {
    const char* semantic;
    std::vector<float> element;
    const char* kept;
  };
  const Row rows[] = {
      {"NORMAL", {0, 0, 0}, "has an element without a direction"},
      {"NORMAL", {kNaN, 0, 1}, "has an element without a direction"},
      {"NORMAL", {0, INFINITY, 1}, "has an element without a direction"},
      {"TANGENT", {1, 0, 0, 0.5f}, "has a fourth component that is no sign"},
      {"TEXCOORD_0", {kNaN, 0}, "has an element that is no finite 32-bit float"},
      {"COLOR_0", {0, 0, -INFINITY, 1}, "has an element that is no finite 32-bit float"},
  };
  for (const Row& row : rows) {
    Model model = model_of({dressed(5, 2)});
    for (Attribute& a : model.meshes[0].wedge_attributes)
      if (a.semantic == row.semantic)
        for (std::size_t c = 0; c < a.count; ++c)
          set_bits(a, 3, c, std::bit_cast<std::uint32_t>(row.element[c]));
    Mesh moved = model.meshes[0];
    for (const QuantizedAttribute& q : AttributeGrids(model, {8, 8, 8, 8}).apply(moved)) {
      EXPECT_TRUE(q.semantic != row.semantic || q.kept == row.kept) << q.kept;
    }
    EXPECT_EQ(attribute(moved, row.semantic), attribute(model.meshes[0], row.semantic));
  }
}

// The same place before is the same place after, in all meshes: charts and meshes meet.
TEST(AttributeGrids, KeepWhatIsEqualEqual) {
  Model model = model_of({dressed(8, 3), dressed(6, 4)});
  // The second mesh has a smaller range, and elements of the first.
  for (std::size_t a = 0; a < model.meshes[0].wedge_attributes.size(); ++a) {
    Attribute& to = model.meshes[1].wedge_attributes[a];
    std::copy_n(model.meshes[0].wedge_attributes[a].data.begin(), to.data.size() / 2,
                to.data.begin());
  }
  Model moved = model;
  const AttributeGrids grids(model, {9, 9, 9, 9});
  for (Mesh& mesh : moved.meshes) grids.apply(mesh);
  for (std::size_t a = 0; a < model.meshes[0].wedge_attributes.size(); ++a) {
    std::map<Bytes, Bytes> after;
    for (std::size_t m = 0; m < 2; ++m)
      for (Index w = 0; w < model.meshes[m].wedge_count(); ++w) {
        const auto bytes = [&](const Model& of) {
          const ByteView view = of.meshes[m].wedge_attributes[a].element(w);
          return Bytes(view.begin(), view.end());
        };
        ASSERT_EQ(after.try_emplace(bytes(model), bytes(moved)).first->second, bytes(moved));
      }
  }
}

TEST(AttributeGrids, FilesBringThemBackExactly) {
  for (unsigned bits = AttributeBits::kMin; bits <= AttributeBits::kMax; bits += 3)
    for (const bool torn : {false, true}) {
      const unsigned of_normal = std::min(bits, AttributeBits::kMaxDirection);
      Mesh mesh = dressed(12, bits);
      // Every triangle has wedges of its own.
      if (torn) mesh = with_wedge_per_corner(mesh);
      const Model model = model_of({mesh});
      std::vector<SimplifyReport> reports;
      const auto strips = encode(model,
                                 {.profile = Profile::compact,
                                  .attribute_bits = {of_normal, bits, bits, bits},
                                  .keep_order = true},
                                 {}, &reports);
      ASSERT_TRUE(strips) << strips.error().message;
      Mesh moved = mesh;
      AttributeGrids(model, {of_normal, bits, bits, bits}).apply(moved);
      ASSERT_EQ(reports.size(), 1u);
      EXPECT_EQ(reports[0].quantized.size(), 6u);
      const auto file = write_binary(*strips);
      ASSERT_TRUE(file) << file.error().message;
      const auto back = read_binary(*file);
      ASSERT_TRUE(back) << back.error().message;
      EXPECT_EQ(decode(*back)->meshes[0], moved) << bits;
    }
}

TEST(AttributeGrids, FewerBitsTakeFewerBytes) {
  const Model model = model_of({dressed(30, 7)});
  std::size_t before = std::numeric_limits<std::size_t>::max();
  for (const unsigned bits : {16u, 12u, 8u, 5u}) {
    const auto strips =
        encode(model, {.profile = Profile::compact, .attribute_bits = {bits, bits, bits, bits}});
    const auto file = write_binary(*strips);
    EXPECT_LT(file->size(), before);
    before = file->size();
  }
}

TEST(AttributeGrids, AreOfTheCompactProfileAndOfTheirRange) {
  const Model model = model_of({dressed(4, 1)});
  const auto code = [&](Profile profile, const AttributeBits& bits) {
    const auto strips = encode(model, {.profile = profile, .attribute_bits = bits});
    return strips ? std::string() : strips.error().message;
  };
  EXPECT_NE(code(Profile::plain, {.normal = 8}), "");
  for (const AttributeBits& bits : {AttributeBits{.normal = 17}, AttributeBits{.normal = 3},
                                    AttributeBits{.texture = 24}, AttributeBits{.other = 1}})
    EXPECT_NE(code(Profile::compact, bits), "");
  EXPECT_EQ(code(Profile::compact, {4, 4, 4, 4}), "");
}

}  // namespace
}  // namespace pstrips
