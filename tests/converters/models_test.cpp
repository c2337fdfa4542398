// Every model there is, shipped or real: convert, validate, convert back, compare. Models that
// cannot be read say so with the code that tests/data/models_refused.tsv has for them.

#include "tests/support/models.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "converters/compare.h"
#include "converters/decode.h"
#include "converters/encode.h"
#include "converters/files.h"
#include "tests/support/meshes.h"
#include "tests/support/paths.h"
#include "tests/support/round_trip.h"

namespace pstrips {
namespace {

namespace fs = std::filesystem;

struct Variant {
  MapEncoding encoding;
  bool xml;
  bool keep_order;
  Placement placement = Placement::subset;
  Metric metric = Metric::qem;
};

// Together they have both values of each; all of the others run on small models.
const Variant kTwo[] = {{MapEncoding::offset, false, true},
                        {MapEncoding::naive, true, false, Placement::optimal, Metric::memoryless}};
const Variant kAll[] = {{MapEncoding::naive, false, false},
                        {MapEncoding::naive, false, true},
                        {MapEncoding::naive, true, false},
                        {MapEncoding::naive, true, true},
                        {MapEncoding::offset, false, false},
                        {MapEncoding::offset, false, true},
                        {MapEncoding::offset, true, false},
                        {MapEncoding::offset, true, true},
                        {MapEncoding::offset, false, true, Placement::optimal},
                        {MapEncoding::naive, true, true, Placement::optimal, Metric::memoryless},
                        {MapEncoding::naive, false, false, Placement::subset, Metric::memoryless}};
constexpr std::uint64_t kLargeCorners = 20'000;

std::uint64_t corners_of(const Model& model) {
  std::uint64_t sum = 0;
  for (const Mesh& m : model.meshes) sum += m.corners.size();
  return sum;
}

std::string round_trip(const Model& model, const Variant& variant) {
  EncodeOptions options;
  options.encoding = variant.encoding;
  options.keep_order = variant.keep_order;
  options.placement = variant.placement;
  options.metric = variant.metric;
  return test::round_trip(model, options, variant.xml);
}

// The way back into the format it came from. What a broken file has that the format forbids is
// mended or left out, and said.
std::string save_again(const LoadedFile& file, const Model& model, bool is_broken,
                       const fs::path& folder) {
  const std::string path = (folder / ("again." + std::string(name_of(file.format)))).string();
  const auto saved = save(model, path, file.format);
  if (!saved) return "save: " + saved.error().message;
  if (is_broken && !(saved->notes.empty() && saved->converted.empty())) return {};
  auto again = load(path);
  if (!again) return "load what was saved: " + again.error().message + " " + again.error().path;
  const Model back = std::move(*again).model().value();
  const Comparison c = compare(model, back, 1000);
  if (c.equivalence != Equivalence::different) return {};
  return "saved model is different: " + (c.differences.empty() ? std::string() : c.differences[0]);
}

class Models : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "pstrips-models-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_;
};

TEST_F(Models, GeneratedOnesComeBack) {
  for (const Mesh& mesh : {test::grid(12), test::torus(9, 7), test::cube(true), test::cube(false),
                           test::random_soup(1, 40, 90), test::random_soup(2, 5, 60)}) {
    Model model;
    model.meshes.push_back(mesh);
    for (const Variant& variant : kAll) EXPECT_EQ(round_trip(model, variant), "");
  }
}

TEST_F(Models, InFilesComeBack) {
  for (const auto& [name, path] : test::model_files({".ply", ".obj", ".gltf", ".glb", ".pm"})) {
    SCOPED_TRACE(name);
    auto file = load(path.string());
    EXPECT_EQ(test::outcome_of(file), test::expected_outcome(name));
    if (!file) {
      EXPECT_FALSE(file.error().message.empty());
      continue;
    }
    const LoadedFile info{file->format, file->bytes, Model{}, {}};
    const Model model = std::move(*file).model().value();
    const bool large = corners_of(model) > kLargeCorners;
    for (const Variant& variant :
         large ? std::span<const Variant>(kTwo) : std::span<const Variant>(kAll))
      EXPECT_EQ(round_trip(model, variant), "")
          << "naive " << (variant.encoding == MapEncoding::naive) << " xml " << variant.xml
          << " order " << variant.keep_order;
    if (info.format != FileFormat::pm) {
      EXPECT_EQ(save_again(info, model, name.starts_with("nasty/broken-gltf"), folder_), "");
    }
  }
}

}  // namespace
}  // namespace pstrips
