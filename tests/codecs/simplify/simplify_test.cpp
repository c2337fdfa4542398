#include "codecs/simplify/simplify.h"

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include "codecs/measure/measure.h"
#include "codecs/triangulate/triangulate.h"
#include "tests/support/meshes.h"
#include "tests/support/models.h"

namespace pstrips {
namespace {

// A simplifier's input that owns its arrays.
struct Source {
  std::vector<double> positions = {};
  std::vector<Index> wedge_vertex = {};
  std::vector<Index> triangles = {};
  std::vector<Index> group = {};
  std::vector<float> attributes = {};
  std::uint32_t attribute_count = 0;

  SimplifyInput input() const {
    return {positions, wedge_vertex, triangles, group, attributes, attribute_count};
  }
  Index vertex_of(Index wedge) const { return wedge_vertex.empty() ? wedge : wedge_vertex[wedge]; }
  Index vertex_count() const { return static_cast<Index>(positions.size() / 3); }
  std::uint64_t triangle_count() const { return triangles.size() / 3; }
  std::array<double, 3> position(Index v) const {
    return {positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]};
  }
};

Source source_of(const Mesh& mesh) {
  Triangulation t = triangulate(mesh);
  Source source{positions_as_double(mesh), mesh.wedge_vertex, std::move(t.corners), {}, {}, 0};
  for (const Index face : t.face) source.group.push_back(mesh.group_of(face));
  for (const Attribute& a : mesh.wedge_attributes) source.attribute_count += a.count;
  for (Index w = 0; w < mesh.wedge_count(); ++w)
    for (const Attribute& a : mesh.wedge_attributes)
      for (std::size_t c = 0; c < a.count; ++c)
        source.attributes.push_back(static_cast<float>(component(a, w, c)));
  return source;
}

CollapseSequence run(const Source& source, const SimplifyOptions& options = {}) {
  return simplify(source.input(), options);
}

// Every way to place and to measure.
struct Manner {
  const char* name;
  Placement placement;
  Metric metric;
  bool in_batches = false;
  CollapseOrder order = CollapseOrder::error;

  SimplifyOptions to(std::uint64_t target_triangles) const {
    return {.target_triangles = target_triangles,
            .placement = placement,
            .metric = metric,
            .in_batches = in_batches,
            .order = order};
  }
};
constexpr Manner kManners[] = {
    {"subset, qem", Placement::subset, Metric::qem},
    {"subset, memoryless", Placement::subset, Metric::memoryless},
    {"optimal, qem", Placement::optimal, Metric::qem},
    {"optimal, memoryless", Placement::optimal, Metric::memoryless},
    {"batches", Placement::subset, Metric::memoryless, true},
    {"batches, bits", Placement::subset, Metric::memoryless, true, CollapseOrder::bits},
};

// Performs a sequence on a plain list of triangles, checking each step by the letter of the header.
// Afterwards `triangles` are those left, as wedges.
class Replay {
 public:
  explicit Replay(const Source& source) : source_(source), triangles_(source.triangles) {
    for (Index w = 0; w < wedge_count(); ++w) {
      stands_at_.push_back(source.vertex_of(w));
      standing_[source.vertex_of(w)].insert(w);
    }
    removed_.resize(source.vertex_count());
  }

  void perform(const CollapseSequence& sequence) {
    const WedgeMove* move = sequence.moves.data();
    float error = 0;
    for (const Collapse& c : sequence.collapses) {
      ASSERT_LT(c.removed, source_.vertex_count());
      ASSERT_LT(c.kept, source_.vertex_count());
      ASSERT_NE(c.removed, c.kept);
      ASSERT_FALSE(removed_[c.removed]);
      ASSERT_FALSE(removed_[c.kept]);
      ASSERT_GE(c.error, error);
      error = c.error;
      ASSERT_LE(c.moves, sequence.moves.data() + sequence.moves.size() - move);
      collapse(c, {move, c.moves});
      if (testing::Test::HasFatalFailure()) return;
      move += c.moves;
    }
    EXPECT_EQ(move, sequence.moves.data() + sequence.moves.size());
    EXPECT_EQ(triangles_.size() / 3, sequence.triangles_left);
  }

  std::vector<Index> triangles() const { return triangles_; }
  std::vector<Index> vertex_triangles() const {
    std::vector<Index> out;
    for (const Index w : triangles_) out.push_back(stands_at_[w]);
    return out;
  }
  bool is_removed(Index vertex) const { return removed_[vertex]; }

 private:
  Index wedge_count() const {
    return source_.wedge_vertex.empty() ? source_.vertex_count()
                                        : static_cast<Index>(source_.wedge_vertex.size());
  }

  void collapse(const Collapse& c, std::span<const WedgeMove> moves) {
    std::map<Index, Index> to;
    for (const WedgeMove& m : moves) {
      ASSERT_EQ(stands_at_[m.from], c.removed);
      if (m.to != kNone) {
        ASSERT_EQ(stands_at_[m.to], c.kept);
      }
      ASSERT_TRUE(to.emplace(m.from, m.to).second) << "moved twice";
    }
    ASSERT_EQ(to.size(), standing_[c.removed].size()) << "not every wedge is moved";

    // The first removed triangle that uses a wedge decides.
    std::map<Index, Index> expected;
    std::set<Index> used;
    std::vector<Index> left;
    for (std::size_t t = 0; t < triangles_.size(); t += 3) {
      Index at_removed = kNone, at_kept = kNone;
      for (std::size_t k = t; k < t + 3; ++k) {
        if (stands_at_[triangles_[k]] == c.removed) at_removed = triangles_[k];
        if (stands_at_[triangles_[k]] == c.kept) at_kept = triangles_[k];
      }
      if (at_removed != kNone) used.insert(at_removed);
      if (at_removed != kNone && at_kept != kNone)
        expected.emplace(at_removed, at_kept);
      else
        left.insert(left.end(), triangles_.begin() + static_cast<std::ptrdiff_t>(t),
                    triangles_.begin() + static_cast<std::ptrdiff_t>(t) + 3);
    }
    ASSERT_FALSE(expected.empty()) << "collapses an edge of no triangle";
    for (const auto& [from, target] : to) {
      if (expected.contains(from)) {
        ASSERT_EQ(target, expected[from]);
      } else if (used.contains(from)) {
        ASSERT_EQ(target, kNone) << "a wedge in use that no removed triangle maps is reassigned";
      } else {
        ASSERT_NE(target, kNone) << "a wedge out of use ends";
      }
    }

    triangles_ = std::move(left);
    for (Index& w : triangles_)
      if (const auto found = to.find(w); found != to.end() && found->second != kNone)
        w = found->second;
    for (const auto& [from, target] : to)
      if (target == kNone) stands_at_[from] = c.kept, standing_[c.kept].insert(from);
    standing_.erase(c.removed);
    removed_[c.removed] = true;
  }

  const Source& source_;
  std::vector<Index> triangles_;
  std::vector<Index> stands_at_;
  std::map<Index, std::set<Index>> standing_;
  std::vector<bool> removed_;
};

// Where the vertices stand after the sequence.
std::vector<double> positions_after(const Source& source, const CollapseSequence& sequence) {
  std::vector<double> positions = source.positions;
  for (std::size_t i = 0; i < sequence.placements.size(); ++i)
    positions[std::size_t{3} * sequence.collapses[i / 3].kept + i % 3] = sequence.placements[i];
  return positions;
}

// Of what a sequence leaves to the source.
double rms_after(const Source& source, const CollapseSequence& sequence) {
  Replay replay(source);
  replay.perform(sequence);
  std::vector<Index> whole;
  for (const Index w : source.triangles) whole.push_back(source.vertex_of(w));
  return measure_distance({source.positions, whole},
                          {positions_after(source, sequence), replay.vertex_triangles()}, 20000)
      .rms;
}

double rms_over_diagonal(const Source& source, const CollapseSequence& sequence) {
  return rms_after(source, sequence) / bounding_box_diagonal(source.positions);
}

double volume(const std::vector<double>& positions, const std::vector<Index>& triangles) {
  double sum = 0;
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    const double *a = &positions[std::size_t{3} * triangles[t]],
                 *b = &positions[std::size_t{3} * triangles[t + 1]],
                 *c = &positions[std::size_t{3} * triangles[t + 2]];
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum / 6;
}

// Vertices minus edges plus triangles of what the triangles use.
int euler_characteristic(const std::vector<Index>& vertex_triangles) {
  std::set<Index> vertices(vertex_triangles.begin(), vertex_triangles.end());
  std::set<std::pair<Index, Index>> edges;
  for (std::size_t t = 0; t < vertex_triangles.size(); t += 3)
    for (std::size_t k = 0; k < 3; ++k)
      edges.insert(std::minmax({vertex_triangles[t + k], vertex_triangles[t + (k + 1) % 3]}));
  return static_cast<int>(vertices.size()) - static_cast<int>(edges.size()) +
         static_cast<int>(vertex_triangles.size() / 3);
}

// side × side vertices in the plane z = 0 with one attribute pair, u v; left and right of the
// middle column the charts differ, when there are two.
Source flat_grid(Index side, int charts) {
  Source source = source_of(test::grid(side));
  for (std::size_t i = 2; i < source.positions.size(); i += 3) source.positions[i] = 0;
  const Index middle = side / 2;
  source.attribute_count = 2;
  const auto set_uv = [&](Index x, Index y, float shift) {
    const float scale = 1.f / static_cast<float>(4 * side);
    source.attributes.push_back(static_cast<float>(x) * scale + shift);
    source.attributes.push_back(static_cast<float>(y) * scale);
  };
  for (Index v = 0; v < side * side; ++v) set_uv(v % side, v / side, 0);
  if (charts == 1) return source;
  for (Index v = 0; v < side * side; ++v) source.wedge_vertex.push_back(v);
  for (Index y = 0; y < side; ++y) {
    source.wedge_vertex.push_back(y * side + middle);
    set_uv(middle, y, 0.5f);
  }
  for (Index v = 0; v < side * side; ++v)
    if (v % side > middle) source.attributes[2 * v] += 0.5f;
  for (std::size_t t = 0; t < source.triangles.size(); t += 3) {
    const auto corners = std::span(source.triangles).subspan(t, 3);
    if (std::ranges::none_of(corners, [&](Index w) { return w % side > middle; })) continue;
    for (Index& w : corners)
      if (w % side == middle) w = side * side + w / side;
  }
  return source;
}

struct NamedSource {
  const char* name;
  Source source;
};

std::vector<NamedSource> generated_sources() {
  return {{"grid", source_of(test::grid(20))},
          {"torus", source_of(test::torus(24, 12))},
          {"cube", source_of(test::cube(false))},
          {"cube with seams", source_of(test::cube(true))},
          {"two charts", flat_grid(15, 2)},
          {"soup", source_of(test::random_soup(1, 60, 300))},
          {"dense soup", source_of(test::random_soup(2, 12, 300))}};
}

TEST(Simplify, FollowsItsRulesOnGeneratedMeshes) {
  for (const auto& [name, source] : generated_sources())
    for (const Manner& manner : kManners)
      for (const std::uint64_t target : {source.triangle_count() / 3, std::uint64_t{0}}) {
        SCOPED_TRACE(name);
        SCOPED_TRACE(manner.name);
        const CollapseSequence sequence = run(source, manner.to(target));
        Replay replay(source);
        replay.perform(sequence);
        if (HasFatalFailure()) return;
        EXPECT_LE(sequence.triangles_left, target);
        EXPECT_EQ(sequence.stop, SimplifyStop::target);
        const bool moves = manner.placement == Placement::optimal;
        ASSERT_EQ(sequence.placements.size(), moves ? 3 * sequence.collapses.size() : 0);
        EXPECT_TRUE(
            std::ranges::all_of(sequence.placements, [](double x) { return std::isfinite(x); }));
      }
}

RC_GTEST_PROP(Simplify, ReducesAnySoupToNothingByItsRules, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const auto vertices = *rc::gen::inRange<Index>(3, 40);
  const auto faces = *rc::gen::inRange<Index>(0, 200);
  Source source = source_of(test::random_soup(seed, vertices, faces));
  if (*rc::gen::arbitrary<bool>()) source.attributes.clear(), source.attribute_count = 0;
  const Manner& manner = kManners[*rc::gen::inRange<std::size_t>(0, std::size(kManners))];
  const CollapseSequence sequence = run(source, manner.to(0));
  testing::TestPartResultArray failures;
  {
    testing::ScopedFakeTestPartResultReporter reporter(
        testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &failures);
    Replay(source).perform(sequence);
  }
  if (failures.size() > 0) RC_FAIL(failures.GetTestPartResult(0).message());
  RC_ASSERT(sequence.triangles_left == 0u);
}

TEST(Simplify, GivesTheSameSequenceAgain) {
  for (const auto& [name, source] : generated_sources())
    for (const Manner& manner : kManners) {
      SCOPED_TRACE(name);
      const CollapseSequence a = run(source, manner.to(0)), b = run(source, manner.to(0));
      EXPECT_EQ(a.collapses, b.collapses);
      EXPECT_EQ(a.moves, b.moves);
      EXPECT_EQ(a.placements, b.placements);
      EXPECT_EQ(a.refused, b.refused);
    }
}

TEST(Simplify, DoesNotDependOnTheNumberOfThreads) {
  // Larger than what one thread takes at a time; with borders and folds, which are looked at apart.
  Source source = source_of(test::grid(110));
  for (std::size_t i = 2; i < source.positions.size(); i += 9) source.positions[i] += 40;
  for (const Manner& manner : kManners) {
    SCOPED_TRACE(manner.name);
    SimplifyOptions options = manner.to(1000);
    options.threads = 1;
    const CollapseSequence one = run(source, options);
    for (const unsigned threads : {2u, 5u}) {
      options.threads = threads;
      const CollapseSequence several = run(source, options);
      EXPECT_EQ(one.collapses, several.collapses);
      EXPECT_EQ(one.moves, several.moves);
      EXPECT_EQ(one.placements, several.placements);
      EXPECT_EQ(one.refused, several.refused);
    }
  }
}

TEST(Simplify, OfATargetIsAPrefixOfTheWhole) {
  const Source source = source_of(test::torus(24, 12));
  for (const Manner& manner : kManners) {
    const CollapseSequence whole = run(source, manner.to(0)), part = run(source, manner.to(100));
    ASSERT_LT(part.collapses.size(), whole.collapses.size());
    EXPECT_TRUE(std::equal(part.collapses.begin(), part.collapses.end(), whole.collapses.begin()));
    EXPECT_TRUE(
        std::equal(part.placements.begin(), part.placements.end(), whole.placements.begin()));
  }
}

// Powers of two scale a model without rounding, so nothing but the errors may change.
TEST(Simplify, DoesNotDependOnTheUnit) {
  for (const int exponent : {-1060, -300, -3, 20, 100, 1010}) {
    for (const Manner& manner : kManners) {
      SCOPED_TRACE(exponent);
      SCOPED_TRACE(manner.name);
      Source source = source_of(test::random_soup(3, 60, 300));
      const CollapseSequence unit = run(source, manner.to(0));
      for (double& x : source.positions) x = std::ldexp(x, exponent);
      const CollapseSequence scaled = run(source, manner.to(0));
      for (std::size_t i = 0; i < scaled.placements.size(); ++i) {
        const double place = std::ldexp(unit.placements[i], exponent);
        ASSERT_NEAR(scaled.placements[i], place,
                    std::ldexp(1e-15, exponent) + std::numeric_limits<double>::denorm_min());
      }
      ASSERT_EQ(unit.collapses.size(), scaled.collapses.size());
      EXPECT_EQ(unit.moves, scaled.moves);
      for (std::size_t i = 0; i < unit.collapses.size(); ++i) {
        EXPECT_EQ(unit.collapses[i].removed, scaled.collapses[i].removed);
        EXPECT_EQ(unit.collapses[i].kept, scaled.collapses[i].kept);
        const float error = scaled.collapses[i].error;
        ASSERT_TRUE(std::isfinite(error));
        if (std::abs(exponent) <= 100) {
          EXPECT_FLOAT_EQ(error, std::ldexp(unit.collapses[i].error, exponent));
        }
      }
    }
  }
}

TEST(Simplify, FlattensAPlaneAtNoError) {
  const Source source = flat_grid(40, 1);
  for (const Manner& manner : kManners) {
    SCOPED_TRACE(manner.name);
    const CollapseSequence sequence = run(source, manner.to(2));
    Replay replay(source);
    replay.perform(sequence);
    EXPECT_EQ(sequence.triangles_left, 2u);
    EXPECT_LT(sequence.collapses.back().error, 1e-4 * bounding_box_diagonal(source.positions));
    EXPECT_EQ(sequence.forced, ConstraintCounts{});
    EXPECT_LT(rms_over_diagonal(source, sequence), 1e-4);
    const std::vector<double> positions = positions_after(source, sequence);
    for (const Index w : replay.triangles())  // the four corners are left
      for (std::size_t k = 0; k < 2; ++k) {
        const double x = positions[3 * std::size_t{w} + k];
        const auto [low, high] = std::pair{source.positions[k], source.positions[3 * 1599 + k]};
        EXPECT_LT(std::min(std::abs(x - low), std::abs(x - high)), 1e-3 * (high - low));
      }
  }
}

TEST(Simplify, DoesNotCrossASeam) {
  const Source source = flat_grid(31, 2);
  for (const Manner& manner : kManners) {
    SCOPED_TRACE(manner.name);
    const CollapseSequence sequence = run(source, manner.to(4));
    Replay replay(source);
    replay.perform(sequence);
    EXPECT_EQ(sequence.triangles_left, 4u);
    for (const WedgeMove& move : sequence.moves) EXPECT_NE(move.to, kNone) << move.from;
    // The shift tells the chart: u within a triangle spans less than the shift.
    const std::vector<Index> left = replay.triangles();
    for (std::size_t t = 0; t < left.size(); t += 3) {
      std::set<bool> charts;
      for (std::size_t k = t; k < t + 3; ++k) charts.insert(source.attributes[2 * left[k]] >= 0.5f);
      EXPECT_EQ(charts.size(), 1u);
    }
  }
}

TEST(Simplify, KeepsWhatAttributesShow) {
  // A spot of another colour on a plane: with 60 triangles its outline can be kept exactly.
  constexpr Index kSide = 33, kFirst = 12, kLast = 20;
  Source source = flat_grid(kSide, 1);
  source.attribute_count = 1;
  source.attributes.clear();
  const auto in_spot = [](Index x) { return x >= kFirst && x <= kLast; };
  for (Index v = 0; v < kSide * kSide; ++v)
    source.attributes.push_back(in_spot(v % kSide) && in_spot(v / kSide) ? 1.f : 0.f);
  const double diagonal = bounding_box_diagonal(source.positions);

  const CollapseSequence outlined = run(source, {.target_triangles = 60});
  EXPECT_LT(outlined.collapses.back().error, 1e-3 * diagonal);
  Replay replay(source);
  replay.perform(outlined);
  for (const Index x : {kFirst, kLast})
    for (const Index y : {kFirst, kLast}) EXPECT_FALSE(replay.is_removed(y * kSide + x));

  const CollapseSequence blurred = run(source, {.target_triangles = 10});
  EXPECT_GT(blurred.collapses.back().error, 1e-2 * diagonal);
}

// Triangles that run clockwise in the texture.
std::size_t mirrored(const Source& source, const std::vector<Index>& triangles) {
  std::size_t count = 0;
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    const float* const a = &source.attributes[2 * triangles[t]];
    const float* const b = &source.attributes[2 * triangles[t + 1]];
    const float* const c = &source.attributes[2 * triangles[t + 2]];
    count += (b[0] - a[0]) * (c[1] - a[1]) < (c[0] - a[0]) * (b[1] - a[1]);
  }
  return count;
}

TEST(Simplify, TurnsNoTriangleOverInTheTexture) {
  // A flat sheet whose texture is wound up like a scroll and weighs nothing: no error tells where a
  // triangle reaches too far around.
  constexpr Index kSide = 41;
  Source source = flat_grid(kSide, 1);
  source.attributes.clear();
  for (Index v = 0; v < kSide * kSide; ++v) {
    const double turn = 12.0 * (v % kSide) / kSide, radius = 1 + 0.5 * (v / kSide) / kSide;
    for (const double x : {radius * std::cos(turn), -radius * std::sin(turn)})
      source.attributes.push_back(static_cast<float>(1e-6 * x));
  }
  ASSERT_EQ(mirrored(source, source.triangles), 0u);
  SimplifyInput constrained = source.input();
  constrained.texture = 0;
  for (const Manner& manner : kManners) {
    SCOPED_TRACE(manner.name);
    const auto mirrored_after = [&](const CollapseSequence& sequence) {
      Replay replay(source);
      replay.perform(sequence);
      return mirrored(source, replay.triangles());
    };
    EXPECT_GT(mirrored_after(run(source, manner.to(60))), 10u);
    const CollapseSequence sequence = simplify(constrained, manner.to(60));
    EXPECT_EQ(mirrored_after(sequence), 0u);
    EXPECT_GT(sequence.refused.texture, 0u);
    EXPECT_EQ(sequence.forced, ConstraintCounts{});
  }
}

TEST(Simplify, KeepsTopologyWhileConstraintsHold) {
  const Source source = source_of(test::torus(60, 30));
  for (const Manner& manner : kManners) {
    SCOPED_TRACE(manner.name);
    const CollapseSequence sequence = run(source, manner.to(100));
    Replay replay(source);
    replay.perform(sequence);
    EXPECT_EQ(sequence.forced.link + sequence.forced.border, 0u);
    EXPECT_EQ(euler_characteristic(replay.vertex_triangles()), 0);
    EXPECT_LT(rms_over_diagonal(source, sequence), 0.02);
  }
}

TEST(Simplify, CountsWhatConstraintsRefuse) {
  // A hole in a plane costs nothing to close, so the constraint of borders decides.
  Source source = flat_grid(20, 1);
  source.triangles.erase(source.triangles.begin() + 3 * 300, source.triangles.begin() + 3 * 302);
  source.group.clear();
  for (const Manner& manner : kManners) {
    SCOPED_TRACE(manner.name);
    const CollapseSequence some = run(source, manner.to(40)), all = run(source, manner.to(0));
    EXPECT_GT(some.refused.border + some.refused.flip + some.refused.link, 0u);
    EXPECT_EQ(some.forced, ConstraintCounts{});
    EXPECT_GT(all.forced.border + all.forced.link + all.forced.flip, 0u);
    EXPECT_GE(all.refused.border, all.forced.border);
  }
}

TEST(Simplify, ErrorIsOfTheOrderOfTheDistance) {
  const Source source = source_of(test::torus(80, 40));
  for (const Manner& manner : kManners)
    for (const std::uint64_t target : {2000u, 500u, 150u}) {
      SCOPED_TRACE(manner.name);
      const CollapseSequence sequence = run(source, manner.to(target));
      const double rms = rms_after(source, sequence);
      EXPECT_GT(sequence.collapses.back().error, rms / 3);
      EXPECT_LT(sequence.collapses.back().error, rms * 10);
    }
}

TEST(Simplify, FreePlacementAndMemorylessMetricAreNearer) {
  const Source source = source_of(test::torus(80, 40));
  double rms[4];
  for (std::size_t i = 0; i < 4; ++i) rms[i] = rms_after(source, run(source, kManners[i].to(400)));
  const auto [subset_qem, subset_memoryless, free_qem, free_memoryless] = rms;
  EXPECT_LT(free_qem, 0.8 * subset_qem);
  EXPECT_LT(free_memoryless, 0.8 * subset_memoryless);
  EXPECT_LT(free_memoryless, 0.8 * free_qem);
}

// Greedily from the front: how many collapses follow each other of which no two share a vertex.
std::vector<std::size_t> independent_runs(const CollapseSequence& sequence) {
  std::vector<std::size_t> out;
  std::set<Index> taken;
  for (const Collapse& c : sequence.collapses) {
    if (out.empty() || taken.contains(c.kept) || taken.contains(c.removed)) {
      out.push_back(0);
      taken.clear();
    }
    taken.insert({c.kept, c.removed});
    ++out.back();
  }
  return out;
}

TEST(Simplify, FallsIntoLargeBatches) {
  const Source source = source_of(test::torus(80, 40));
  for (const CollapseOrder order : {CollapseOrder::error, CollapseOrder::bits}) {
    const SimplifyOptions options = {.target_triangles = 100, .in_batches = true, .order = order};
    const std::size_t runs = independent_runs(run(source, options)).size();
    EXPECT_LT(runs, 40u);
    EXPECT_GT(independent_runs(run(source, {.target_triangles = 100})).size(), 3 * runs);
  }
}

// All keys in one step of the queue: neither the first batch nor the last may be of one collapse.
TEST(Simplify, FallsIntoLargeBatchesOnAPlane) {
  const Source source = source_of(test::grid(40));
  const CollapseSequence sequence = run(source, {.target_triangles = 200, .in_batches = true});
  EXPECT_LT(independent_runs(sequence).size(), 60u);
}

TEST(Simplify, BatchesStayNearTheSource) {
  const Source source = source_of(test::torus(80, 40));
  for (const std::uint64_t target : {3200u, 1280u, 320u}) {
    const double plain = rms_after(source, run(source, {.target_triangles = target}));
    const auto batches = [&](CollapseOrder order) {
      return rms_after(
          source, run(source, {.target_triangles = target, .in_batches = true, .order = order}));
    };
    EXPECT_LT(batches(CollapseOrder::error), 1.15 * plain) << target;
    EXPECT_LT(batches(CollapseOrder::bits), 1.4 * plain) << target;
  }
}

TEST(Simplify, MemorylessMetricKeepsTheVolume) {
  const Source source = source_of(test::torus(80, 40));
  const double before = volume(source.positions, source.triangles);
  const auto lost = [&](const Manner& manner) {
    const CollapseSequence sequence = run(source, manner.to(300));
    Replay replay(source);
    replay.perform(sequence);
    return std::abs(1 - volume(positions_after(source, sequence), replay.triangles()) / before);
  };
  EXPECT_LT(lost(kManners[3]), 1e-4);
  EXPECT_GT(lost(kManners[2]), 1e-2);
}

TEST(Simplify, TakesNoCollapseAboveTheErrorLimit) {
  const Source source = source_of(test::grid(30));
  for (const Manner& manner : kManners) {
    SCOPED_TRACE(manner.name);
    SimplifyOptions options = manner.to(0);
    options.max_error = 0.1;
    const CollapseSequence limited = run(source, options);
    EXPECT_EQ(limited.stop, SimplifyStop::max_error);
    EXPECT_GT(limited.triangles_left, 0u);
    ASSERT_FALSE(limited.collapses.empty());
    EXPECT_LE(limited.collapses.back().error, 0.1f);
    EXPECT_LT(rms_after(source, limited), 0.1);
  }
}

TEST(Simplify, StopsWhenToldTo) {
  const Source source = source_of(test::grid(100));
  double last = 0;
  const CollapseSequence sequence =
      simplify(source.input(), {}, [&](std::string_view, double done) {
        last = done;
        return false;
      });
  EXPECT_EQ(sequence.stop, SimplifyStop::interrupted);
  EXPECT_GT(sequence.triangles_left, 0u);
  EXPECT_GT(last, 0);
  EXPECT_LT(last, 1);
}

TEST(Simplify, NeverTouchesVerticesThatAreNotFinite) {
  constexpr double kBad[] = {std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity()};
  Source source = source_of(test::grid(12));
  const Index locked[] = {0, 17, 18, 77};
  for (std::size_t i = 0; i < std::size(locked); ++i)
    source.positions[3 * locked[i] + i % 3] = kBad[i % 3];
  for (const Manner& manner : kManners) {
    SCOPED_TRACE(manner.name);
    const CollapseSequence sequence = run(source, manner.to(0));
    Replay replay(source);
    replay.perform(sequence);
    for (const Collapse& c : sequence.collapses)
      for (const Index v : locked) {
        EXPECT_NE(c.removed, v);
        EXPECT_NE(c.kept, v);
      }
    EXPECT_EQ(sequence.stop, SimplifyStop::exhausted);
    EXPECT_LT(sequence.triangles_left, source.triangle_count() / 4);
  }
}

TEST(Simplify, HasNothingToDoWithoutTriangles) {
  for (const Source& source : {Source{}, Source{.positions = {0, 0, 0, 1, 1, 1}}}) {
    const CollapseSequence sequence = run(source);
    EXPECT_TRUE(sequence.collapses.empty());
    EXPECT_EQ(sequence.triangles_left, 0u);
    EXPECT_EQ(sequence.stop, SimplifyStop::target);
  }
}

TEST(Simplify, HasNothingToDoWhenTheTargetIsMet) {
  const Source source = source_of(test::grid(5));
  const CollapseSequence sequence = run(source, {.target_triangles = 32});
  EXPECT_TRUE(sequence.collapses.empty());
  EXPECT_EQ(sequence.triangles_left, 32u);
}

// n triangles around one vertex (two with `spindle`), on a ring that is not flat.
Source fan(Index n, bool spindle) {
  Source source;
  for (Index i = 0; i < n; ++i) {
    const double a = 6.283185307179586 * i / n;
    source.positions.insert(source.positions.end(),
                            {std::cos(a), std::sin(a), std::sin(5 * a) / 9});
  }
  source.positions.insert(source.positions.end(), {0, 0, 1, 0, 0, -1});
  for (Index i = 0; i < n; ++i) {
    const Index j = (i + 1) % n;
    source.triangles.insert(source.triangles.end(), {n, i, j});
    if (spindle) source.triangles.insert(source.triangles.end(), {n + 1, j, i});
  }
  return source;
}

// Pages that share one edge.
Source book(Index n) {
  Source source{.positions = {0, 0, 0, 0, 0, 1}};
  for (Index i = 0; i < n; ++i) {
    const double a = 6.283185307179586 * i / n;
    source.positions.insert(source.positions.end(), {std::cos(a), std::sin(a), 0.5});
    source.triangles.insert(source.triangles.end(), {0, 1, i + 2});
  }
  return source;
}

// The same mesh with a wedge for each corner.
Source with_corner_wedges(Source source) {
  source.wedge_vertex = source.triangles;
  for (Index c = 0; c < source.triangles.size(); ++c) source.triangles[c] = c;
  for (Index v = 0; v < source.vertex_count(); ++v) source.wedge_vertex.push_back(v);
  return source;
}

double cpu_seconds(const Source& source, const Manner& manner) {
  const std::clock_t start = std::clock();
  const CollapseSequence sequence = run(source, manner.to(0));
  EXPECT_EQ(sequence.triangles_left, 0u);
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

TEST(Simplify, IsNotQuadraticInTheValence) {
  constexpr Index kValence = 100'000;
  for (const auto& [name, source] :
       {NamedSource{"fan", fan(kValence, false)}, NamedSource{"spindle", fan(kValence, true)},
        NamedSource{"book", book(kValence)},
        NamedSource{"wedges", with_corner_wedges(fan(kValence, true))}}) {
    SCOPED_TRACE(name);
    // Half a second when built for speed; the rest is for slow machines and sanitizers. Quadratic
    // time would be minutes.
    for (const Manner& manner : kManners) {
      SCOPED_TRACE(manner.name);
      EXPECT_LT(cpu_seconds(source, manner), 10);
    }
  }
}

TEST(Simplify, ReachesFivePercentOfEveryTopologyModel) {
  const char* const kModels[] = {"shipped/surfaces/double_ring.ply",
                                 "shipped/surfaces/terrain.ply",
                                 "shipped/surfaces/non_manifold.ply",
                                 "shipped/surfaces/soup.obj",
                                 "shipped/polygons/cells.obj",
                                 "nasty/topology/many_small_holes.ply",
                                 "nasty/topology/mesh_with_colors.obj",
                                 "nasty/topology/quad5.ply",
                                 "nasty/topology/elephant-with-holes.ply",
                                 "nasty/topology/three_cubes.obj",
                                 "nasty/topology/truck.obj",
                                 "nasty/topology/abominevole.ply",
                                 "nasty/topology/blobby-shuffled.ply",
                                 "nasty/topology/boeing.ply",
                                 "nasty/topology/prim.obj",
                                 "nasty/topology/fan3.obj",
                                 "nasty/topology/degtri_sliding.obj",
                                 "nasty/topology/bunny2.ply",
                                 "nasty/topology/corner_with_sharp_edge.obj",
                                 "nasty/topology/ALSTOM_TEST4.obj",
                                 "nasty/topology/constraints_100_1.obj",
                                 "nasty/topology/beetle.obj",
                                 "nasty/topology/tetra_intersected_by_triangle.obj",
                                 "nasty/topology/tmp_wing_with_isolated_facet.obj",
                                 "nasty/topology/hourglass_ico.obj",
                                 "nasty/topology/office_chair.obj"};
  for (const std::string name : kModels) {
    const auto mesh = test::model_mesh(name);
    if (!mesh) continue;
    SCOPED_TRACE(name);
    const Source source = source_of(*mesh);
    const std::uint64_t target = source.triangle_count() / 20;
    for (const Manner& manner : kManners) {
      const CollapseSequence sequence = run(source, manner.to(target));
      EXPECT_LE(sequence.triangles_left, target);
      if (source.triangle_count() < 3000) Replay(source).perform(sequence);  // which is quadratic
    }
  }
}

}  // namespace
}  // namespace pstrips
