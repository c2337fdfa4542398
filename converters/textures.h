#pragma once

#include <optional>
#include <string>
#include <vector>

#include "converters/file_formats.h"
#include "core/limits.h"
#include "core/scene.h"

namespace pstrips::inline converters {

/// Where the images of a model go.
enum class Textures : std::uint8_t {
  embed,      ///< into the file
  copy,       ///< beside the file, under their own names
  reference,  ///< nowhere: the file names them as its source did
};

/// What a format can do; by itself it embeds where it can hold several things in one file, else
/// copies. Nothing when it names no textures.
bool takes(FileFormat format, Textures textures);
std::optional<Textures> usual_textures(FileFormat format);

struct TextureSource {
  std::string model_path;           ///< images are looked for in its folder
  bool allow_parent_paths = false;  ///< and above it, when they are named with ".."
  Limits limits;
};

/// Brings the image files that a scene names into it, as Image::data.
///
/// notes  receives those that are not: not there, not in the folder, no files, too large
void read_textures(Scene& scene, const TextureSource& from, std::vector<std::string>& notes);

/// Gives each image with data a name under which it may be written beside a file: relative, below
/// the file's folder, no two the same. Those that had another one are noted.
///
/// stem   of names for images without one
/// named  whether images without a name need one; else the file embeds them
void name_textures(Scene& scene, const std::string& stem, bool named,
                   std::vector<std::string>& notes);

/// Both, as far as a target needs them, and a note on what the target will name without its being
/// there. With Textures::copy save() writes the images.
void prepare_textures(Scene& scene, const TextureSource& from, const std::string& target_path,
                      FileFormat target, Textures textures, std::vector<std::string>& notes);

}  // namespace pstrips::inline converters
