#pragma once

#include <vector>

#include "core/limits.h"
#include "core/result.h"
#include "core/scene.h"

namespace pstrips::inline formats::ply {

/// Where a stretch of whole lines of an ascii body starts.
struct Run {
  std::uint64_t begin = 0;  ///< offset into the file
  std::uint64_t rows = 0;   ///< lines before it that are not blank
};

/// Cuts the text from `body` on into runs of about `run_bytes` and counts their rows on up to
/// `threads` threads. The last entry is the end: the size of the file and all rows.
///
/// Precondition: body <= file.size(), run_bytes > 0.
std::vector<Run> cut_into_runs(ByteView file, std::uint64_t body, std::size_t run_bytes,
                               unsigned threads);

/// Text that one thread takes at a time: some tenths of a millisecond of work.
inline constexpr std::size_t kRunBytes = 256 << 10;

/// read_ply() with runs of another size than kRunBytes, so that tests need no long files.
Result<Model> read_ply_in_runs(ByteView file, const Limits& limits, std::size_t run_bytes);

}  // namespace pstrips::inline formats::ply
