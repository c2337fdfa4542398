#include <gtest/gtest.h>

#include <set>
#include <string>

#include "formats/gltf/extensions/extension.h"

namespace pstrips {
namespace {

using namespace formats::gltf;

TEST(Extensions, HaveOneRowEach) {
  std::set<std::string_view> names;
  for (const Extension* extension : extensions()) {
    EXPECT_TRUE(names.insert(extension->name).second) << extension->name;
    EXPECT_EQ(find_extension(extension->name), extension);
  }
}

TEST(Extensions, AreFoundByNameElseByFamily) {
  EXPECT_EQ(find_extension("KHR_texture_basisu"), &kTextureBasisu);
  ASSERT_NE(find_extension("KHR_texture_transform"), nullptr);
  EXPECT_EQ(find_extension("KHR_texture_transform")->name, "KHR_texture_");
  EXPECT_EQ(find_extension("MSFT_lod")->name, "MSFT_lod");
  for (const std::string_view name : {"", "KHR_", "MSFT_lod2", "VENDOR_thing", "KHR_texture"})
    EXPECT_EQ(find_extension(name), nullptr) << name;
}

// A file may require what leaves its geometry readable, and nothing else.
TEST(Extensions, ThatHideGeometryMayNotBeRequired) {
  for (const Extension* extension : extensions()) {
    const bool hides = extension->fate == Fate::dropped;
    EXPECT_EQ(extension->may_be_required, !hides) << extension->name;
  }
}

struct ReferenceRow {
  const Extension* extension;
  std::string_view parent, key;
  Reference reference;
};
const ReferenceRow kReferences[] = {
    {&kMeshGpuInstancing, "attributes", "TRANSLATION", Reference::accessor},
    {&kMeshGpuInstancing, "", "count", Reference::none},
    {&kStructuralMetadata, "properties", "values", Reference::view},
    {&kStructuralMetadata, "", "stringOffsets", Reference::view},
    {&kStructuralMetadata, "", "count", Reference::none},
};

TEST(Extensions, SayWhatTheirNumbersReferTo) {
  for (const ReferenceRow& row : kReferences) {
    SCOPED_TRACE(std::string(row.extension->name) + " " + std::string(row.key));
    EXPECT_EQ(row.extension->reference(row.parent, row.key), row.reference);
  }
  EXPECT_EQ(conventional_reference("accessor"), Reference::accessor);
  EXPECT_EQ(conventional_reference("bufferView"), Reference::view);
  EXPECT_EQ(conventional_reference("myBufferView"), Reference::view);
  EXPECT_EQ(conventional_reference("bufferViews"), Reference::none);
}

}  // namespace
}  // namespace pstrips
