#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "converters/decode.h"
#include "converters/encode.h"
#include "core/file.h"
#include "core/limits.h"
#include "core/progressive_strips.h"
#include "core/scene.h"
#include "core/tetra.h"

namespace pstrips::inline converters {

enum class FileFormat : std::uint8_t { ply, obj, gltf, glb, xyz, pstrip, pstripx, pm };

/// "ply" … as file extensions without the dot.
std::string_view name_of(FileFormat format);
std::optional<FileFormat> format_named(std::string_view name);
constexpr bool is_progressive(FileFormat format) { return format >= FileFormat::pstrip; }

/// By the first bytes; OBJ, which has no signature, is what the extension says or what is left.
/// Nothing for bytes that are none of ours and whose extension is not ".obj".
std::optional<FileFormat> detect_format(ByteView bytes, std::string_view path);

/// By the extension, any case.
std::optional<FileFormat> format_of_path(std::string_view path);

/// A file as read, before any conversion. A Skabek-Pojda text becomes progressive strips on the
/// way (`text_options` says how it is stripified).
struct LoadedFile {
  FileFormat format;
  std::uint64_t bytes = 0;
  std::variant<Model, ProgressiveStrips> content;
  std::vector<std::string> notes;  ///< what the reader left out

  bool is_progressive() const { return std::holds_alternative<ProgressiveStrips>(content); }
  /// A progressive file is decoded as far as `choice` says. The content is used up.
  /// errors  as decode()
  Result<Model> model(const LevelChoice& choice = {}) &&;
};

struct LoadOptions {
  Limits limits;
  bool allow_prefix =
      false;  ///< a binary progressive file that ends early is read as far as it goes
  EncodeOptions text_options;  ///< for FileFormat::pm
};

/// Reads a model or progressive file; "-" is standard input. Companions (buffers, material
/// libraries) are looked for beside the file and nowhere else.
///
/// errors  io, truncated, corrupt, over_limit, unsupported; unsupported also when no format fits
Result<LoadedFile> load(const std::string& path, const LoadOptions& options = {});
/// The same for a file that was opened already; the path says where its companions are.
Result<LoadedFile> load(const FileBytes& file, const std::string& path,
                        const LoadOptions& options = {});

/// Reads the tetrahedra of a file that looks_like_medit(), or is called ".mesh".
Result<TetraMesh> load_tetra_mesh(const FileBytes& file, const Limits& limits = {});
bool holds_tetra_mesh(const FileBytes& file, const std::string& path);

struct SaveOptions {
  bool ascii = false;    ///< PLY: text instead of little-endian binary
  bool strips = false;   ///< glTF: one primitive a strip instead of triangle lists
  unsigned threads = 0;  ///< see thread_count(); the bytes are the same
};

/// What became of a save.
struct SavedFiles {
  std::vector<std::string> paths;
  std::uint64_t bytes = 0;         ///< of all files
  std::vector<std::string> notes;  ///< what the target format cannot hold
};

/// Writes a model as ply, obj, gltf or glb; companions go beside it. All files or none.
Result<SavedFiles> save(const Model& model, const std::string& path, FileFormat format,
                        const SaveOptions& options = {});

/// Writes progressive strips as pstrip, pstripx or pm.
Result<SavedFiles> save(const ProgressiveStrips& strips, const std::string& path,
                        FileFormat format);

}  // namespace pstrips::inline converters
