#pragma once

#include <optional>

#include "core/limits.h"
#include "formats/pstrip/xml/xml.h"
#include "formats/pstrip/xml/xml_names.h"

namespace tinyxml2 {
class XMLElement;
class XMLNode;
}  // namespace tinyxml2

namespace pstrips::inline formats {

/// What the reading of one document shares: its limits and the first error, which sticks.
class XmlReadContext {
 public:
  /// places  when not null, filled with the line of each part
  XmlReadContext(ByteView document, const Limits& limits, XmlLocations* places)
      : document_(document), limits_(limits), places_(places) {}

  bool ok() const { return !error_; }
  const std::optional<Error>& error() const { return error_; }
  const Limits& limits() const { return limits_; }
  XmlLocations* places() { return places_; }

  void fail(const tinyxml2::XMLElement& at, Fault fault, std::string_view message,
            std::string_view attribute = {});
  /// Something that no version 2.0 file has.
  void fail_unknown(const tinyxml2::XMLElement& at, Fault fault, std::string_view message);
  void set_newer_version() { newer_version_ = true; }

  /// Adds to what the file holds, which the limits bound.
  void announce(const tinyxml2::XMLElement& at, const XmlTotals& more);
  /// Refuses a list that is as long as a list of meshes may be; packets follow vsplits.
  template <class T>
  void grow(const tinyxml2::XMLElement& at, const std::vector<T>& list) {
    if (!std::is_same_v<T, Packet> && list.size() >= limits_.meshes)
      fail(at, Fault::over_limit, "more of these than the limit");
  }

 private:
  ByteView document_;
  const Limits& limits_;
  XmlLocations* places_;
  bool newer_version_ = false;
  XmlTotals totals_;
  std::optional<Error> error_;
};

}  // namespace pstrips::inline formats
