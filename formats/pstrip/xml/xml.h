#pragma once

#include <cstdint>
#include <map>
#include <optional>
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

/// Where a part of the model stands in a document.
struct XmlPlace {
  std::uint32_t line = 1;  ///< from 1
  std::string element;     ///< "/pstrips/packet[0]/vsplit[2]": siblings of a name count from 0
  std::optional<std::uint32_t> entry;  ///< of the list that the element holds

  /// "line 12, /pstrips/base[0]/map[0], entry 3"
  std::string text() const;
};

/// Where each part of the model stands in the document.
class XmlLocations {
 public:
  /// The smallest element that leads to the part with that path; paths are those of the errors of
  /// `check` (formats/pstrip/payload/check.h): "/packets/5", "/meshes/0/vsplits/17",
  /// "/meshes/0/base_map/3", "/scene/nodes/2", "/scene/foreign/1", "/unknown/0" …
  XmlPlace find(std::string_view path) const;

  // For the reader, which notes each element on the way.

  /// An element inside the one with the number `parent`, the root first; returns its number.
  /// ordinal  among its siblings of that name
  Index add(Index parent, const char* name, std::size_t ordinal, std::uint32_t line);
  /// The element is the part with that path; the first one stays.
  void name(std::string path, Index element);
  /// The elements for the items of the list with that path.
  std::vector<Index>& items(std::string path);

 private:
  struct Element {
    Index parent, ordinal;
    std::uint32_t line;
    const char* name;
  };
  XmlPlace place_of(Index element, std::optional<std::uint32_t> entry) const;

  std::vector<Element> elements_;
  std::map<std::string, Index, std::less<>> parts_;
  std::map<std::string, std::vector<Index>, std::less<>> items_;
};

/// Writes a whole document. The same strips give the same bytes, and read_xml gives the same
/// strips, bit for bit.
///
/// Precondition: `check(strips)` holds (formats/pstrip/payload/check.h).
/// cost  O(size); about 80 bytes a vertex of a mesh without wedge attributes
Bytes write_xml(const ProgressiveStrips& strips);

/// Reads a document; what it returns satisfies `check` (formats/pstrip/payload/check.h).
///
/// locations  when not null, filled with the place of each part
/// errors     truncated, corrupt, over_limit, unsupported, each with its fault; the path is the
///            line, then the element; the offset is that of the byte or of the line's start
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
