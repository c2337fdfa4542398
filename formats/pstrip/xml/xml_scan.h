#pragma once

#include <optional>

#include "core/bytes.h"
#include "core/limits.h"
#include "core/result.h"

namespace pstrips::inline formats {

/// What the markup of a document amounts to.
struct XmlExtent {
  std::uint64_t elements = 0, attributes = 0, texts = 0;
};

/// Walks the markup of a whole document before a DOM is built of it. The DOM builder answers an
/// early end like any other error, knows no byte offsets and takes some documents that are not
/// well formed; a document that is too deep or too large exhausts it.
///
/// Holds afterwards: UTF-8 of characters that XML 1.0 allows; one root; tags match; attributes are
/// quoted; entities are the five of XML or character references; no DTD, no processing
/// instruction. Not checked: that attribute names differ within a tag.
///
/// errors  truncated, corrupt or over_limit (xml_depth), with the byte offset and the line
/// cost    O(bytes); memory O(depth)
Result<XmlExtent> scan_xml(ByteView document, const Limits& limits);

/// Where a line starts; the end of the document for a line past it. Lines count from 1.
std::uint64_t offset_of_line(ByteView document, std::uint64_t line);

}  // namespace pstrips::inline formats
