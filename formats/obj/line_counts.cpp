#include "formats/obj/line_counts.h"

#include <algorithm>

namespace pstrips::inline formats::obj {

LineCounts count_lines(std::string_view text) {
  LineCounts out;
  bool continued = false;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    at = end + 1;
    if (!continued) {
      out.vertices += line.starts_with("v ");
      out.tuples += line.starts_with("vt ") || line.starts_with("vn ");
      out.faces += line.starts_with("f ");
    }
    continued = line.ends_with('\\') || line.ends_with("\\\r");
  }
  return out;
}

}  // namespace pstrips::inline formats::obj
