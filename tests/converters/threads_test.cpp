// What encoding on several threads must not change: the result, the order of reports, how progress
// is told.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

#include "converters/capacity.h"
#include "converters/encode.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace pstrips {
namespace {

constexpr Index kMeshes = 30;

// Next to many small meshes one that is encoded alone.
Model mixed_scene() {
  Model model = test::scene_of_tori(kMeshes);
  model.meshes.push_back(test::torus(200, 150));
  model.meshes.push_back(test::cube(true));
  for (std::size_t m = 0; m < model.meshes.size(); ++m)
    model.meshes[m].name = "mesh " + std::to_string(m);
  return model;
}

Model one_mesh(Mesh mesh) {
  Model model;
  model.meshes.push_back(std::move(mesh));
  return model;
}

struct Outcome {
  ProgressiveStrips strips;
  std::vector<std::string> reported;
};

Outcome encoded_on(unsigned threads, const Model& model, EncodeOptions options = {}) {
  options.threads = threads;
  std::vector<SimplifyReport> reports;
  Outcome out{encode(model, options, {}, &reports).value(), {}};
  for (const SimplifyReport& report : reports) out.reported.push_back(report.mesh);
  return out;
}

void expect_same_on_any_number(const Model& model, const EncodeOptions& options = {}) {
  const Outcome one = encoded_on(1, model, options);
  for (const unsigned threads : {2u, 5u}) {
    const Outcome more = encoded_on(threads, model, options);
    EXPECT_TRUE(more.strips == one.strips) << threads << " threads";
    EXPECT_EQ(more.reported, one.reported) << threads << " threads";
  }
}

TEST(Threads, DoNotChangeAScene) {
  const Model model = mixed_scene();
  expect_same_on_any_number(model);
  EXPECT_EQ(encoded_on(3, model).reported.front(), "mesh 0");
  EXPECT_EQ(encoded_on(3, model).reported.size(), model.meshes.size());
}

TEST(Threads, DoNotChangeALargeMesh) {
  const Model model = one_mesh(test::torus(400, 250));
  expect_same_on_any_number(model);
  for (const Placement placement : {Placement::subset, Placement::optimal})
    expect_same_on_any_number(model, {.base_share = 0.3,
                                      .placement = placement,
                                      .metric = Metric::memoryless,
                                      .keep_order = true});
}

TEST(Threads, LargeMeshesWaitForEachOtherWhenMemoryIsShort) {
  const Model model = mixed_scene();
  EncodeOptions options;
  options.memory_bytes = 0;
  for (const Mesh& mesh : model.meshes)
    options.memory_bytes = std::max(options.memory_bytes, encoding_bytes(work_size(mesh)));
  EXPECT_TRUE(encoded_on(5, model, options).strips == encoded_on(1, model).strips);
}

TEST(Threads, TellProgressOneAtATimeAndOnwards) {
  std::atomic<int> telling = 0;
  double last = 0;
  const auto strips = encode(mixed_scene(), {.threads = 4}, [&](std::string_view, double done) {
    EXPECT_EQ(++telling, 1);
    EXPECT_GE(done, last - 1e-9);
    EXPECT_LE(done, 1);
    last = done;
    --telling;
    return true;
  });
  EXPECT_TRUE(strips);
  EXPECT_GT(last, 0.5);
}

TEST(Threads, AllStopWhenOneIsTold) {
  for (const int allowed : {0, 1, 20}) {
    int asked = 0;
    const auto strips = encode(mixed_scene(), {.threads = 4},
                               [&](std::string_view, double) { return asked++ < allowed; });
    ASSERT_FALSE(strips);
    EXPECT_EQ(strips.error().code, ErrorCode::interrupted);
    EXPECT_EQ(asked, allowed + 1);  // nobody asks again
  }
}

}  // namespace
}  // namespace pstrips
