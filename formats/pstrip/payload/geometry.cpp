#include "formats/pstrip/payload/geometry.h"

#include "formats/pstrip/payload/compact/compact.h"
#include "formats/pstrip/payload/plain/plain.h"

namespace pstrips::inline formats {
namespace {

struct ProfileCodec {
  Profile profile;
  const GeometryCodec& (*codec)();
};
constexpr ProfileCodec kCodecs[] = {{Profile::plain, plain_codec},
                                    {Profile::compact, compact_codec}};
static_assert(std::ranges::equal(kCodecs, kProfiles, {}, &ProfileCodec::profile,
                                 &ProfileName::profile));

}  // namespace

bool GeometryReader::needs_fine(Index) const { return false; }
bool GeometryReader::read_fine(layout::ReadIo&, Index, ProgressiveMesh&) { return false; }
bool GeometryReader::codes_faces() const { return false; }
bool GeometryReader::read_faces(layout::ReadIo&, Index, ProgressiveMesh&) { return false; }

const GeometryCodec& codec_of(Profile profile) {
  return std::ranges::find(kCodecs, profile, &ProfileCodec::profile)->codec();
}

}  // namespace pstrips::inline formats
