#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/byte_sink.h"
#include "core/bytes.h"
#include "core/limits.h"
#include "core/progressive_strips.h"
#include "core/result.h"
#include "formats/pstrip/container/header.h"

namespace pstrips::inline formats {

// The binary variant of progressive strips. [spec/container.md]

/// Writes a whole file, chunk by chunk. The same strips give the same bytes.
///
/// Precondition: `strips` is complete and `check(strips)` holds (formats/pstrip/payload/check.h).
/// errors  bad_argument for what the profile cannot hold, over_limit when a chunk would exceed
///         2^31 - 1 bytes, both before anything is written; those of the sink
/// cost    O(file); memory for the largest chunk
Result<void> write_binary(const ProgressiveStrips& strips, ByteSink& out);
/// The same into memory.
Result<Bytes> write_binary(const ProgressiveStrips& strips);

/// The same for strips that break rules, to make files that a validator must refuse. Lists must be
/// as long as the counts that the file stores for them.
Result<Bytes> write_binary_unchecked(const ProgressiveStrips& strips);

enum class ReadMode : std::uint8_t {
  whole,   ///< a file that ends early is an error
  prefix,  ///< a file that ends early gives what its whole packets brought
};

/// Reads a file. What it returns satisfies `check` (formats/pstrip/payload/check.h): every index is
/// in range, so that a decoder may follow it without a check. A validator has still to check
/// whether the records mean what they say.
///
/// errors  truncated before the end (prefix mode: before the last BASE), corrupt, unsupported
///         (unknown critical chunk, version or profile), over_limit; with the byte offset
/// cost    O(file) time; O(file) memory however large the counts in it
Result<ProgressiveStrips> read_binary(ByteView file, const Limits& limits = {},
                                      ReadMode mode = ReadMode::whole);

/// The push form of read_binary, for bytes as they arrive.
///
/// After each whole chunk the strips grow: arrays are in order of appearance, so that a prefix of
/// the file fills a prefix of each. At most one chunk is buffered. A chunk that is refused leaves
/// the strips as they were before it.
class BinaryParser {
 public:
  /// file_bytes  the size of the file when it is known, else 0; memory is then reserved at once
  explicit BinaryParser(const Limits& limits = {}, std::uint64_t file_bytes = 0);
  ~BinaryParser();
  BinaryParser(BinaryParser&&) noexcept;
  BinaryParser& operator=(BinaryParser&&) noexcept;

  /// Takes the next bytes of the file. The first error stays: later calls return it again.
  Result<void> feed(ByteView bytes);

  /// What the whole chunks brought so far. `complete` is false before PEND.
  const ProgressiveStrips& strips() const;
  ProgressiveStrips take() &&;

  /// Every BASE is there: level 0 can be shown.
  bool has_base() const;
  /// Meshes of which a FINE chunk has completed the numbers, ascending.
  std::span<const Index> completed_meshes() const;
  /// PEND is there.
  bool complete() const;
  const std::optional<Error>& error() const;
  /// What to answer when the file ends here: `error()`, truncated, or nothing when complete.
  std::optional<Error> end() const;

  const std::optional<FileHeader>& header() const;  ///< once PSHD is there
  std::span<const IndexRow> index() const;          ///< once PIDX is there: bases, then packets
  std::uint64_t bytes_taken() const;                ///< all that was fed

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pstrips::inline formats
