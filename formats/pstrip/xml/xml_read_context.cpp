#include "formats/pstrip/xml/xml_read_context.h"

#include <tinyxml2.h>

#include "core/fault_list.h"
#include "formats/pstrip/xml/xml_scan.h"

namespace pstrips::inline formats {

using tinyxml2::XMLElement;
using tinyxml2::XMLNode;

namespace {

/// "/pstrips/packet[3]/vsplit[17]". Only for errors: it counts siblings.
std::string path_of(const XMLElement& element) {
  const XMLNode* parent = element.Parent();
  const XMLElement* above = parent == nullptr ? nullptr : parent->ToElement();
  if (above == nullptr) return std::string("/") + element.Name();
  std::size_t same = 0;
  for (auto* e = element.PreviousSiblingElement(element.Name()); e != nullptr;
       e = e->PreviousSiblingElement(element.Name()))
    ++same;
  return path_of(*above) + "/" + element.Name() + "[" + std::to_string(same) + "]";
}

}  // namespace

void XmlReadContext::fail(const XMLElement& at, Fault fault, std::string_view message,
                          std::string_view attribute) {
  if (error_) return;
  const auto line = static_cast<std::uint64_t>(at.GetLineNum());
  std::string path = "line " + std::to_string(line) + ", " + path_of(at);
  if (!attribute.empty()) path.append("/@").append(attribute);
  error_ = Error{code_of(fault), std::string(message), offset_of_line(document_, line),
                 std::move(path), fault};
}

void XmlReadContext::fail_unknown(const XMLElement& at, Fault fault, std::string_view message) {
  fail(at, newer_version_ ? Fault::xml_unsupported : fault, message);
}

void XmlReadContext::announce(const XMLElement& at, const XmlTotals& more) {
  const auto add = [&](std::uint64_t& total, std::uint64_t n, const char* what,
                       std::uint64_t limit) {
    total += n;
    if (total > limit) fail(at, Fault::over_limit, over_limit_message(total, what, limit));
  };
  add(totals_.vertices, more.vertices, "vertices", limits_.vertices);
  add(totals_.wedges, more.wedges, "wedges", limits_.wedges);
  add(totals_.corners, more.corners, "corners and map entries", limits_.corners);
}

}  // namespace pstrips::inline formats
