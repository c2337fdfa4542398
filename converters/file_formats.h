#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/file.h"
#include "core/progressive_strips.h"
#include "core/result.h"
#include "core/scene.h"

namespace pstrips::inline converters {

struct FileSet;
struct LoadedFile;
struct LoadOptions;
struct OutputName;
struct SaveOptions;

enum class FileFormat : std::uint8_t { ply, obj, gltf, glb, xyz, medit, pstrip, pstripx, pm };

/// What a file of a format can hold. What a model has and its target cannot hold is lost on the
/// way there.
enum class Feature : std::uint8_t {
  faces,             ///< triangles at least
  polygons,          ///< faces of more than three corners
  lines,             ///< polylines
  points,            ///< faces of one corner
  tetrahedra,        ///< and nothing else
  levels,            ///< levels of detail: the format is progressive
  double_positions,  ///< f64
  wedges,            ///< several tuples of attributes at a vertex
  attributes,        ///< of wedges, under any name
  face_attributes,   ///< under any name
  several_meshes,    ///< each with its name
  nodes,             ///< a scene with transforms
  materials,         ///< beyond the name of a texture
  embedded_images,   ///< image files within the file
  asset,             ///< animations, skins, cameras, lights and what else a glTF holds
  text_and_binary,   ///< has both forms, of which a writer chooses
  separate_strips,   ///< strips as primitives of their own, of which a writer chooses
};

class Features {
 public:
  constexpr Features(std::initializer_list<Feature> list) {
    for (const Feature f : list) bits_ |= bit(f);
  }
  constexpr bool has(Feature f) const { return (bits_ & bit(f)) != 0; }

 private:
  static constexpr std::uint32_t bit(Feature f) {
    return std::uint32_t{1} << static_cast<unsigned>(f);
  }
  std::uint32_t bits_ = 0;
};

/// How surely bytes are of a format. A signature counts more than the extension of the file's name,
/// the extension more than a likeness; of several formats the surest is taken.
enum class Certainty : std::uint8_t { none, possible, likely, signature };

/// All that is said of a format anywhere. A null function is something that the format cannot do.
struct FileFormatRow {
  FileFormat format;
  std::string_view name;   ///< "ply" …, as in --to and as the file extension
  std::string_view title;  ///< for people
  Features holds;
  std::string_view companion = {};  ///< extension of what save() may write beside, with the dot
  bool is_validated = false;        ///< the validator has rules for it
  Certainty (*detect)(ByteView file) = nullptr;
  Result<LoadedFile> (*read)(const FileBytes& file, const std::string& path,
                             const LoadOptions& options) = nullptr;
  Result<FileSet> (*write_model)(const Model& model, const OutputName& name,
                                 const SaveOptions& options) = nullptr;
  Result<FileSet> (*write_strips)(const ProgressiveStrips& strips,
                                  const OutputName& name) = nullptr;

  bool is_readable() const { return read != nullptr; }
  bool is_writable() const { return write_model != nullptr || write_strips != nullptr; }
};

/// The table of formats, in the order of FileFormat.
std::span<const FileFormatRow> file_formats();
const FileFormatRow& row_of(FileFormat format);

std::string_view name_of(FileFormat format);
std::optional<FileFormat> format_named(std::string_view name);
bool holds(FileFormat format, Feature feature);
inline bool is_progressive(FileFormat format) { return holds(format, Feature::levels); }

/// "ply, obj, … and pm": the formats that can be read or written, for messages.
std::string readable_formats();
std::string writable_formats();

/// By the extension, any case.
std::optional<FileFormat> format_of_path(std::string_view path);

/// By the first bytes, or by the extension where they are no signature. Signatures that are cut
/// short or mangled are still recognised by the extension, so that the reader says what is wrong.
/// Nothing for bytes that are of no known format and whose extension is not known either.
std::optional<FileFormat> detect_format(ByteView file, std::string_view path);

}  // namespace pstrips::inline converters
