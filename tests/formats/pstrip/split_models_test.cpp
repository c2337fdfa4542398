#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "formats/pstrip/payload/compact/chord_choice.h"
#include "formats/pstrip/payload/compact/step_guess.h"

namespace pstrips {
namespace {

TEST(ScaledNumberModel, ReadsBackNumbersOfAnySizeUnderAnyGuess) {
  constexpr std::int32_t kMost = (1 << 30) - 1;
  std::vector<std::pair<std::int32_t, unsigned>> numbers;
  for (const std::int32_t n : {0, 1, 2, 3, 4, 7, 8, (1 << 14) - 1, 1 << 14, 1 << 15, kMost})
    for (const unsigned size : {0u, 1u, 40u, 96u, 1000u})
      for (const std::int32_t sign : {1, -1}) numbers.emplace_back(sign * n, size);
  std::mt19937 random(3);
  for (int i = 0; i < 3000; ++i) {
    const auto bits = static_cast<unsigned>(random() % 31);
    const auto number = static_cast<std::int32_t>(random() & ((1u << bits) - 1));
    numbers.emplace_back(random() % 2 == 0 ? number : -number, random() % 128);
  }
  RansWriter writer;
  ScaledNumberModel writing, reading;
  for (const auto& [number, size] : numbers) writing.code(writer, number, size);
  const Bytes bytes = writer.finish();
  RansReader reader(bytes);
  for (const auto& [number, size] : numbers) ASSERT_EQ(reading.code(reader, 0, size), number);
  EXPECT_TRUE(reader.complete());
}

// A vertex in a ring of `size` neighbours at random; the last one is absent when it is open.
struct RandomRing {
  SplitState state{Placement::subset};
  VertexRing ring;

  RandomRing(std::mt19937& random, unsigned size, bool open) {
    const auto coordinate = [&] {
      return static_cast<std::int32_t>(random() % (2u * kMaxGrid + 1)) - kMaxGrid;
    };
    ring.size = size;
    ring.open = open;
    state.add_vertex({coordinate(), coordinate(), coordinate()});
    for (unsigned i = 0; i < size; ++i) {
      const bool absent = open && i + 1 == size;
      ring.vertex[i] =
          absent ? kNone : state.add_vertex({coordinate(), coordinate(), coordinate()});
      ring.corner[i] = open && i + 2 >= size ? kNone : 3 * i;
    }
  }
};

TEST(RingGeometry, RunsAndWhatTheyLeaveAreSumsOfArms) {
  std::mt19937 random(1);
  for (const unsigned size : {3u, 4u, 7u, 20u, VertexRing::kMaxSize})
    for (const bool open : {false, true}) {
      const RandomRing r(random, size, open);
      const RingGeometry geometry(r.state, 0, r.ring);
      const auto sum = [&](unsigned from, unsigned places) {
        RingGeometry::Run out{{}, 0, 0};
        for (unsigned k = 0, i = from; k < places; ++k, i = r.ring.next(i)) {
          if (r.ring.vertex[i] == kNone) continue;
          out.sum = out.sum + r.state.position[r.ring.vertex[i]] - r.state.position[0];
          out.lengths += geometry.length(i);
          ++out.count;
        }
        return out;
      };
      for (unsigned from = 0; from < size; ++from)
        for (unsigned side = 1; side < size; ++side) {
          const unsigned to = (from + side) % size;
          const RingGeometry::Run near = geometry.run(from, side + 1), want = sum(from, side + 1);
          ASSERT_EQ(near.sum, want.sum);
          ASSERT_EQ(near.lengths, want.lengths);
          ASSERT_EQ(near.count, want.count);
          const RingGeometry::Run far = geometry.rest_of(near, from, to),
                                  rest = sum(to, size - side + 1);
          ASSERT_EQ(far.sum, rest.sum);
          ASSERT_EQ(far.count, rest.count);
          RingGeometry::Run moved = near;
          geometry.move_on(moved, from, r.ring.next(to));
          const RingGeometry::Run after = sum(r.ring.next(from), side + 1);
          ASSERT_EQ(moved.sum, after.sum);
          ASSERT_EQ(moved.lengths, after.lengths);
          ASSERT_EQ(moved.count, after.count);
        }
    }
}

TEST(ChordChoice, LearnsWhatHappensAndStaysInRange) {
  for (const Placement placement : {Placement::subset, Placement::optimal}) {
    std::mt19937 random(2);
    RandomRing r(random, 6, false);
    ChordWeights weights(placement);
    const RingGeometry geometry(r.state, 0, r.ring);
    const auto share_of = [&](unsigned chord) {
      r.state.models.chord = weights;
      return ChordChoice(r.state, r.ring, geometry, 2, 6).shares().of(chord);
    };
    for (int i = 0; i < 20000; ++i) {
      r.state.models.chord = weights;
      ChordChoice(r.state, r.ring, geometry, 2, 6).learn(weights, 3);
    }
    EXPECT_GT(share_of(3), kShares * 97 / 100);
    for (int i = 0; i < 20000; ++i) {
      r.state.models.chord = weights;
      ChordChoice(r.state, r.ring, geometry, 2, 6).learn(weights, 1);
    }
    EXPECT_GT(share_of(1), kShares * 97 / 100);
  }
}

TEST(ChordChoice, HalvesWithEachBit) {
  for (const std::int32_t bits : {0, 100, 1024, 2048, 5000, 20000, 40000}) {
    const double want = std::exp2(15 - bits / double{ChordWeights::kOneBit});
    EXPECT_NEAR(power_of_half(bits), want, 0.0025 * want + 1) << bits;
  }
}

// On a plane the third component is exact wherever the vertex lies in it.
TEST(StepGuess, KnowsTheHeightOverAPlane) {
  std::mt19937 random(9);
  SplitState state(Placement::subset);
  VertexRing ring;
  ring.size = 6;
  const std::array<std::array<int, 2>, 6> places = {
      {{40, 0}, {24, 32}, {-16, 40}, {-48, 8}, {-24, -40}, {16, -32}}};
  state.add_vertex({});
  for (unsigned i = 0; i < 6; ++i) {
    const std::int32_t x = 64 * places[i][0], y = 64 * places[i][1];
    ring.vertex[i] = state.add_vertex({x, y, x / 4 - y / 2});
    ring.corner[i] = 3 * i;
  }
  const RingGeometry geometry(state, 0, ring);
  for (const Placement placement : {Placement::subset, Placement::optimal})
    for (unsigned from = 0; from < 6; ++from) {
      GridSplit split;
      split.from = from;
      split.to = (from + 3) % 6;
      const StepGuess guess(placement, ring, geometry, split);
      ASSERT_EQ(guess.up(), 2u);
      for (const std::int32_t x : {-400, 0, 800})
        for (const std::int32_t y : {-1200, 0, 400})
          EXPECT_NEAR(static_cast<double>(guess.height(x, y)), x / 4 - y / 2, 1);
    }
}

}  // namespace
}  // namespace pstrips
