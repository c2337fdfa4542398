#include "formats/pstrip/payload/geometry_layout.h"

#include <algorithm>

#include "formats/pstrip/payload/compact/compact.h"
#include "formats/pstrip/payload/plain/plain.h"

namespace pstrips::inline formats {
namespace {

struct ProfileLayout {
  Profile profile;
  const GeometryLayout& (*layout)();
};
constexpr ProfileLayout kLayouts[] = {{Profile::plain, plain_layout},
                                      {Profile::compact, compact_layout}};
static_assert(std::ranges::equal(kLayouts, kProfiles, {}, &ProfileLayout::profile,
                                 &ProfileName::profile));

}  // namespace

std::uint64_t GeometryWriter::fine_bytes(Index) { return 0; }
void GeometryWriter::write_fine(Index, std::span<std::byte>) {}
const Bytes* GeometryWriter::coded_faces(Index) const { return nullptr; }

const GeometryLayout& layout_of(Profile profile) {
  return std::ranges::find(kLayouts, profile, &ProfileLayout::profile)->layout();
}

}  // namespace pstrips::inline formats
