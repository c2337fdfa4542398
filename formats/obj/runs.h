#pragma once

#include <vector>

#include "core/file.h"
#include "core/scene.h"
#include "formats/obj/geometry.h"
#include "formats/obj/obj.h"

namespace pstrips::inline formats::obj {

/// A line of a run that only a reader of all lines before it understands: names, materials,
/// relative indices, the first face after such a line.
struct Event {
  std::size_t line_at = 0;  ///< offset into the text
  Extent before;            ///< what the run says ahead of it
};

/// A stretch of whole statements and what it says by itself.
struct Run {
  std::size_t begin = 0, end = 0;  ///< offsets into the text
  bool good = false;               ///< no fault was found
  Geometry geometry;
  std::vector<Event> events;

  /// Memory that reading its lines takes at most.
  std::uint64_t max_bytes(std::uint64_t name_bytes) const;
};

/// The end of the run of about `run_bytes` that starts at `begin`: behind a line that does not go
/// on in the next.
std::size_t run_end(std::string_view text, std::size_t begin, std::size_t run_bytes, char line_end);

/// Reads the lines of a run; precondition: the comments at the top of the file are behind.
void read_run(Run& run, std::string_view text, char line_end, const Limits& limits);

inline bool is_continued(std::string_view line) {
  return line.ends_with('\\') || line.ends_with("\\\r");
}

/// Whether the statement of the line [begin, end) goes on in the next: it ends in a backslash and
/// is no comment. A name that ends in one, of a folder for instance, does not swallow a statement.
bool goes_on(std::string_view text, std::size_t begin, std::size_t end, char line_end);

inline constexpr std::string_view kNote = "# note: ";

/// Text that one thread takes at a time: about a millisecond of work.
inline constexpr std::size_t kRunBytes = 256 << 10;

/// read_obj() with runs of another size than kRunBytes, so that tests need no long files.
Result<Model> read_obj_in_runs(ByteView file, const ReadFile& read_file, const Limits& limits,
                               std::size_t run_bytes, const ObjReadOptions& options = {});

}  // namespace pstrips::inline formats::obj
