#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/bytes.h"
#include "core/limits.h"
#include "core/progressive_strips.h"
#include "core/result.h"

namespace pstrips::inline formats {

// The XML variant of progressive strips, `.pstripx`: the information of the binary variant, for
// people to read and for other tools to make. [spec/xml.md]

/// In which line of the document each part of the model stands.
struct XmlLocations {
  /// Lines by the path that errors of `check` (formats/pstrip/payload/check.h) have: "/packets/5",
  /// "/scene/nodes/2", "/meshes/0/faces", "/foreign/1", "/unknown/0" … Lines count from 1.
  std::map<std::string, std::uint32_t, std::less<>> elements;
  std::vector<std::vector<std::uint32_t>> vsplits;  ///< per mesh, one a vsplit

  /// The line of the smallest part that the path leads into: "/meshes/0/vsplits/17/parent" gives
  /// the line of that vsplit, a path without a part of its own the line of what encloses it.
  std::uint32_t line_of(std::string_view path) const;
};

/// Writes a whole document. The same strips give the same bytes, and read_xml gives the same
/// strips, bit for bit.
///
/// Precondition: `check(strips)` holds (formats/pstrip/payload/check.h).
/// cost  O(size); about 80 bytes a vertex of a mesh without wedge attributes
Bytes write_xml(const ProgressiveStrips& strips);

/// Reads a document; what it returns satisfies `check` (formats/pstrip/payload/check.h).
///
/// locations  when not null, filled with the line of each part
/// errors     truncated, corrupt, over_limit, unsupported; the path is the line, then the element
///            or the part of the model; the offset is that of the byte or of the line's start
/// cost       O(document); peak memory about 5 times the document, bounded by
///            Limits::memory_bytes before anything is built
Result<ProgressiveStrips> read_xml(ByteView document, const Limits& limits = {},
                                   XmlLocations* locations = nullptr);

/// The same without `check`: what the document says, for a validator that judges each value by
/// itself. Attributes have one element for each vertex and wedge that base and vsplits bring; each
/// vsplit has the lists it counts. Nothing else is certain, indices least of all.
Result<ProgressiveStrips> read_xml_unchecked(ByteView document, const Limits& limits,
                                             XmlLocations* locations);

/// Whether the bytes look like an XML document rather than another format: white space or a byte
/// order mark, then '<'.
bool looks_like_xml(ByteView start);

}  // namespace pstrips::inline formats
