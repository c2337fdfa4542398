#include <tinyxml2.h>

#include "core/fault_list.h"
#include "core/text.h"
#include "formats/pstrip/payload/check.h"
#include "formats/pstrip/xml/xml.h"
#include "formats/pstrip/xml/xml_layout.h"
#include "formats/pstrip/xml/xml_read_io.h"
#include "formats/pstrip/xml/xml_scan.h"
#include "formats/pstrip/xml/xml_text.h"

namespace pstrips::inline formats {
namespace {

/// What the DOM, the places and the model may take at most, before any of them is built.
std::uint64_t memory_for(const XmlExtent& extent, std::uint64_t document_bytes) {
  constexpr std::uint64_t kPlaceBytes = 64;  // 24 and a number in a list, with room to grow
  // The DOM keeps a copy of the text. No token is shorter than two characters, with its space, and
  // the widest component they can stand for has eight bytes.
  return extent.elements * (sizeof(tinyxml2::XMLElement) + kPlaceBytes) +
         extent.attributes * sizeof(tinyxml2::XMLAttribute) +
         extent.texts * sizeof(tinyxml2::XMLText) + document_bytes * 5;
}

tl::unexpected<Error> refuse(ByteView document, Fault fault, const char* message, int line) {
  const auto from_one = static_cast<std::uint64_t>(line);
  return tl::unexpected(Error{code_of(fault), message, offset_of_line(document, from_one),
                              "line " + std::to_string(line), fault});
}

/// What the root element holds. `places` may be null.
Result<ProgressiveStrips> read_root(const tinyxml2::XMLElement& root, ByteView document,
                                    const Limits& limits, XmlLocations* places) {
  XmlReadContext in(document, limits, places);
  if (std::string_view(root.Name()) != kRootName)
    in.fail(root, Fault::xml_schema, "root element is not pstrips");
  XmlReadIo io(in, root);
  ProgressiveStrips strips;
  xml_layout::document_fields(io, strips);
  io.finish();
  if (in.error()) return tl::unexpected(*in.error());
  return strips;
}

Result<ProgressiveStrips> read(ByteView document, const Limits& limits, bool checked,
                               XmlLocations* locations) {
  const Result<XmlExtent> extent = scan_xml(document, limits);
  if (!extent) return tl::unexpected<Error>(extent.error());
  if (memory_for(*extent, document.size()) > limits.memory_bytes)
    return refuse(document, Fault::over_limit, "document needs more memory than the limit", 1);
  tinyxml2::XMLDocument dom;
  const std::string_view text = as_text(document);
  if (dom.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    if (dom.ErrorID() == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED)
      return refuse(document, Fault::over_limit, "elements nest deeper than the limit",
                    dom.ErrorLineNum());
    return refuse(document, Fault::xml_malformed, "malformed XML", dom.ErrorLineNum());
  }
  const tinyxml2::XMLElement& root = *dom.RootElement();
  Result<ProgressiveStrips> strips = read_root(root, document, limits, locations);
  if (!strips || !checked) return strips;
  if (Result<void> ok = check(*strips); !ok) {
    // Where things stand is only worth finding out now.
    XmlLocations places;
    if (locations == nullptr) (void)read_root(root, document, limits, &places);
    const XmlPlace place = (locations == nullptr ? places : *locations).find(ok.error().path);
    Error error = ok.error();
    error.path = place.text();
    error.offset = offset_of_line(document, place.line);
    return tl::unexpected<Error>(std::move(error));
  }
  return strips;
}

}  // namespace

Result<ProgressiveStrips> read_xml(ByteView document, const Limits& limits,
                                   XmlLocations* locations) {
  return read(document, limits, true, locations);
}

Result<ProgressiveStrips> read_xml_unchecked(ByteView document, const Limits& limits,
                                             XmlLocations* locations) {
  return read(document, limits, false, locations);
}

bool looks_like_xml(ByteView start) {
  return Tokens(without_utf8_mark(as_text(start))).next().starts_with('<');
}

}  // namespace pstrips::inline formats
