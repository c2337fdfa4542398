#pragma once

#include <cstdint>
#include <string_view>

namespace pstrips::inline formats::obj {

/// How many statements a text has at least: those that begin a line without a blank before them.
struct LineCounts {
  std::uint64_t vertices = 0;  ///< v
  std::uint64_t tuples = 0;    ///< vt and vn
  std::uint64_t faces = 0;     ///< f
};

/// Looks at the beginnings of lines only; many times quicker than reading them.
LineCounts count_lines(std::string_view text);

}  // namespace pstrips::inline formats::obj
