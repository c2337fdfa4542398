#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/byte_sink.h"
#include "core/bytes.h"
#include "core/result.h"

namespace pstrips::inline core {

/// The bytes of a file, mapped where the system can and read otherwise. Moves, does not copy; the
/// view stays valid as long as the object.
class FileBytes {
 public:
  FileBytes() = default;
  explicit FileBytes(Bytes owned) : owned_(std::move(owned)), view_(owned_) {}
  FileBytes(FileBytes&& other) noexcept;
  FileBytes& operator=(FileBytes&& other) noexcept;
  ~FileBytes();

  ByteView view() const { return view_; }
  /// Gives the memory of the first `size` bytes back while a mapped file is read front to back;
  /// they are read from disk again when touched again.
  void release(std::size_t size) const;

 private:
  friend Result<FileBytes> read_file(const std::filesystem::path& path, std::uint64_t max_bytes);
  void* mapping_ = nullptr;
  Bytes owned_;
  ByteView view_;
};

/// Opens a regular file, or reads a pipe or a terminal to its end. "-" is standard input.
///
/// errors  io with the path and the system's words; over_limit beyond max_bytes
Result<FileBytes> read_file(const std::filesystem::path& path,
                            std::uint64_t max_bytes = ~std::uint64_t{0});

/// Hands a reader a file that stands beside the model: a buffer, an image, a material library. The
/// path is plain text (not percent-encoded), relative, uses '/' and never leads out of the model's
/// folder; the reader sees to that. A file that is not there is ErrorCode::io.
using ReadFile = std::function<Result<Bytes>(const std::string& relative_path)>;

/// Writes the bytes of a file to a sink, piece by piece.
using WriteBytes = std::function<Result<void>(ByteSink&)>;

/// A file that is to be written: its bytes, or what writes them.
struct OutputFile {
  std::filesystem::path path;
  ByteView bytes;
  WriteBytes write = {};  ///< when set, instead of `bytes`
};

/// Writes all files or none: each to a temporary file beside its path first, then all are renamed.
/// "-" is standard output, written last. Leaves no temporary file behind, whatever fails.
///
/// errors  io with the path and the system's words; those of OutputFile::write
Result<void> write_files(const std::vector<OutputFile>& files);

/// Whether write_files() could write there now, found out before the work that makes the bytes: the
/// folder exists and takes files, and the path is no folder. Leaves nothing behind.
///
/// errors  io with the path and the system's words
Result<void> check_writable(const std::filesystem::path& path);

/// Removes the temporary files of a write_files() under way; safe to call from a signal handler.
void remove_temporary_files() noexcept;

}  // namespace pstrips::inline core
