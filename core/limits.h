#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace pstrips::inline core {

/// What a reader accepts from untrusted input. A reader answers a count that exceeds a limit with
/// ErrorCode::over_limit, before it allocates anything for it.
struct Limits {
  std::uint64_t vertices = 1u << 28;        ///< per file, all meshes together
  std::uint64_t wedges = 1u << 28;          ///< per file
  std::uint64_t corners = 1u << 30;         ///< face corners or index-map entries, per file
  std::uint64_t meshes = 1u << 20;          ///< meshes, materials, images and nodes, each
  std::uint64_t string_bytes = 1u << 24;    ///< one name, comment or text value
  std::uint64_t memory_bytes = 8ull << 30;  ///< what a reader may allocate in all
  std::uint32_t xml_depth = 64;             ///< nesting of elements (also of JSON)
  /// Threads that a reader may work with, see thread_count(). The result is the same for any
  /// number.
  unsigned threads = 0;
};

/// "9 vertices, more than the limit of 8"
inline std::string over_limit_message(std::uint64_t figure, std::string_view what,
                                      std::uint64_t limit) {
  return std::to_string(figure) + " " + std::string(what) + ", more than the limit of " +
         std::to_string(limit);
}

}  // namespace pstrips::inline core
