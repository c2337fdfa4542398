#pragma once

#include <array>
#include <span>
#include <string_view>

#include "core/progressive_strips.h"

namespace pstrips::inline formats {

// Words that stand for values in the XML variant. [spec/xml.md §5]

/// What the variant's own versions count. [spec/xml.md X-004]
inline constexpr Index kXmlVersionMajor = 2;
inline constexpr std::string_view kXmlVersion = "2.0";
static_assert(kXmlVersion.front() - '0' == kXmlVersionMajor);

/// In the order of the enumeration that each belongs to.
inline constexpr std::array<std::string_view, 2> kEncodingNames = {"naive", "offset"};
inline constexpr std::array<std::string_view, 2> kPlacementNames = {"subset", "optimal"};
inline constexpr std::array<std::string_view, 3> kFaceKindNames = {"polygons", "lines", "points"};
/// From kSameAsMinus2 to kRestart.
inline constexpr std::array<std::string_view, 5> kMarkerNames = {"R-2", "R-1", "R+1", "R+2", "|"};
inline constexpr std::string_view kDigestAlgorithm = "SHA-256";

inline std::string_view name_of(MapEncoding v) {
  return kEncodingNames[static_cast<std::size_t>(v)];
}
inline std::string_view name_of(Placement v) {
  return kPlacementNames[static_cast<std::size_t>(v)];
}
inline std::string_view name_of(FaceKind v) { return kFaceKindNames[static_cast<std::size_t>(v)]; }
/// Precondition: !is_wedge(entry).
inline std::string_view name_of_marker(Index entry) { return kMarkerNames[entry - kSameAsMinus2]; }

}  // namespace pstrips::inline formats
