#pragma once

#include <array>
#include <span>
#include <string_view>

#include "core/progressive_strips.h"

namespace pstrips::inline formats {

// Words that stand for values in the XML variant. [spec/xml.md §5]

/// What the variant's own versions count. [spec/xml.md X-004]
inline constexpr Index kXmlVersionMajor = 2;
inline constexpr Index kXmlVersionMinor = 2;

/// In the order of the enumeration that each belongs to.
inline constexpr std::array<std::string_view, 3> kEncodingNames = {"naive", "offset", "triangles"};
inline constexpr std::array<std::string_view, 2> kPlacementNames = {"subset", "optimal"};
inline constexpr std::array<std::string_view, 2> kEffortNames = {"fast", "small"};
inline constexpr std::array<std::string_view, 3> kFaceKindNames = {"polygons", "lines", "points"};
inline constexpr std::array<std::string_view, 8> kTypeNames = {"i8",  "u8",  "i16", "u16",
                                                               "i32", "u32", "f32", "f64"};
inline constexpr std::array<std::string_view, 2> kTextureOriginNames = {"upper_left", "lower_left"};
inline constexpr std::array<std::string_view, 3> kAlphaModeNames = {"opaque", "mask", "blend"};
inline constexpr std::array<std::string_view, 8> kMapRoleNames = {
    "base_color",         "opacity", "metallic",  "roughness",
    "metallic_roughness", "normal",  "occlusion", "emissive"};
/// How the data of a foreign entry is written.
enum class ForeignForm : std::uint8_t { text, base64 };
inline constexpr std::array<std::string_view, 2> kFormNames = {"text", "base64"};
/// From kSameAsMinus2 to kRestart.
inline constexpr std::array<std::string_view, 5> kMarkerNames = {"R-2", "R-1", "R+1", "R+2", "|"};
inline constexpr const char* kRootName = "pstrips";
inline constexpr std::string_view kDigestAlgorithm = "SHA-256";

/// Precondition: !is_wedge(entry).
inline std::string_view name_of_marker(Index entry) { return kMarkerNames[entry - kSameAsMinus2]; }

/// What a document holds, as far as Limits bounds it.
struct XmlTotals {
  std::uint64_t vertices = 0, wedges = 0;
  std::uint64_t corners = 0;  ///< of faces, and index-map entries
};

}  // namespace pstrips::inline formats
