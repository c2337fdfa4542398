#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "converters/decode.h"
#include "converters/encode.h"
#include "converters/file_formats.h"
#include "converters/textures.h"
#include "core/file.h"
#include "core/limits.h"
#include "core/progressive_strips.h"
#include "core/scene.h"
#include "core/tetra.h"

namespace pstrips::inline converters {

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
  /// A binary progressive file that ends early is read as far as it goes.
  bool allow_prefix = false;
  /// Companions of an OBJ may stand outside the model's folder, when it names them with "..".
  bool allow_parent_paths = false;
  EncodeOptions text_options;  ///< for FileFormat::pm
};

/// Reads a model or progressive file; "-" is standard input. Companions (buffers, material
/// libraries) are looked for beside the file and nowhere else.
///
/// errors  io, truncated, corrupt, over_limit, unsupported; unsupported also when no format fits,
///         with the list of those that would
Result<LoadedFile> load(const std::string& path, const LoadOptions& options = {});
/// The same for a file that was opened already; the path says where its companions are.
Result<LoadedFile> load(const FileBytes& file, const std::string& path,
                        const LoadOptions& options = {});

/// Reads the tetrahedra of a file that looks_like_medit(), or is called ".mesh".
Result<TetraMesh> load_tetra_mesh(const FileBytes& file, const Limits& limits = {});
bool holds_tetra_mesh(const FileBytes& file, const std::string& path);

struct SaveOptions {
  bool ascii = false;          ///< PLY: text instead of little-endian binary
  bool strips = false;         ///< glTF: one primitive a strip instead of triangle lists
  bool joined_strips = false;  ///< glTF: one strip a group, its parts joined by repeated indices
  bool strip_swaps = false;    ///< glTF strips: they may turn by a repeated index
  unsigned threads = 0;        ///< see thread_count(); the bytes are the same
  bool transforms = true;      ///< apply nodes where the format has none, see place_meshes()
  Limits limits{};             ///< what the copies that nodes make may take
  /// Writes nothing when anything is left out: SavedFiles::files is empty then.
  bool strict = false;
  /// What was left out on the way here: it stands first in the notes and counts for `strict`.
  std::vector<std::string> dropped_before = {};
  /// With `copy` the images that have data and a name are written beside the output, into folders
  /// below it; see prepare_textures(), which makes the names.
  Textures textures = Textures::embed;
  /// Whether files beside the output, which the caller did not name, may be replaced by others.
  bool replace_companions = true;
};

struct SavedFile {
  std::string path;
  std::uint64_t bytes = 0;
};

/// What became of a save.
struct SavedFiles {
  std::vector<SavedFile> files;    ///< all that were written, the named one first
  std::vector<std::string> notes;  ///< what the target format cannot hold
  /// What it holds in another way, such as node transforms that became positions.
  std::vector<std::string> converted;

  std::uint64_t bytes() const;  ///< of all files
};

/// The files that save() may write: the path itself first, then its companions, which are written
/// when the model needs them. Standard output has no companions.
std::vector<std::string> output_paths(const std::string& path, FileFormat format);

/// Writes a model in a format that holds one; companions go beside it. All files or none.
///
/// errors  io, also for a companion that would replace another file against the options, with its
///         path; bad_argument for a format that is not written; those of the format's writer
Result<SavedFiles> save(const Model& model, const std::string& path, FileFormat format,
                        const SaveOptions& options = {});

/// Writes progressive strips in a progressive format.
Result<SavedFiles> save(const ProgressiveStrips& strips, const std::string& path, FileFormat format,
                        const SaveOptions& options = {});

}  // namespace pstrips::inline converters
