#include "converters/textures.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <set>

#include "core/file.h"
#include "core/text.h"

namespace pstrips::inline converters {
namespace {

namespace fs = std::filesystem;

bool is_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x20 || byte == 0x7f;
}

/// Whether a name is a path that leads to a file from the model's folder, and not out of it.
bool is_path(const std::string& uri, bool may_climb) {
  if (uri.empty() || uri.front() == '/' || uri.back() == '/') return false;
  if (std::ranges::any_of(uri, [](char c) { return is_control(c) || c == ':'; })) return false;
  for (const fs::path& part : fs::path(uri))
    if (part == ".." && !may_climb) return false;
  return true;
}

std::string with_slashes(std::string uri) {
  std::ranges::replace(uri, '\\', '/');
  return uri;
}

/// What is left of a name when its folders go.
std::string file_name(const std::string& uri) {
  std::string name = uri.substr(uri.find_last_of("/:") + 1);
  std::ranges::replace_if(name, is_control, '_');
  return name == ".." || name == "." ? std::string() : name;
}

std::string ending_of(const Image& image) {
  const std::size_t slash = image.mime_type.find('/');
  const std::string kind = slash == std::string::npos ? "" : image.mime_type.substr(slash + 1);
  const bool plain = !kind.empty() && std::ranges::all_of(kind, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
  });
  if (kind == "jpeg") return ".jpg";
  if (plain) return "." + kind;
  return as_text(image.data).starts_with("\xff\xd8") ? ".jpg" : ".png";
}

/// The name, or one with a number before its ending that nobody has.
std::string unique_name(const std::string& name, std::set<std::string>& taken) {
  const fs::path path(name);
  std::string out = name;
  for (int n = 2; !taken.insert(lower_case(out)).second; ++n)
    out = (path.parent_path() / path.stem()).string() + "_" + std::to_string(n) +
          path.extension().string();
  return out;
}

std::string folder_of(const std::string& path) {
  return fs::path(path == "-" ? "." : path).parent_path().string();
}

bool is_same_folder(const std::string& a, const std::string& b) {
  std::error_code none;
  return fs::equivalent(folder_of(a).empty() ? "." : folder_of(a),
                        folder_of(b).empty() ? "." : folder_of(b), none);
}

/// Why an image is not read; empty: it was.
std::string read_texture(Image& image, const TextureSource& from, std::uint64_t& left) {
  const std::string path = with_slashes(image.uri);
  if (!is_path(path, from.allow_parent_paths)) {
    const bool is_url = path.find("://") != std::string::npos;
    return is_url ? "is no file" : "is outside the model's folder";
  }
  const auto file = read_file(fs::path(folder_of(from.model_path)) / path, left);
  if (!file)
    return file.error().code == ErrorCode::io ? "is not there" : "exceeds the memory limit";
  image.data.assign(file->view().begin(), file->view().end());
  left -= image.data.size();
  return image.data.empty() ? "is empty" : "";
}

void note_references(const Scene& scene, bool stay, std::vector<std::string>& notes) {
  for (const Image& image : scene.images) {
    if (!image.data.empty() && !image.uri.empty())
      notes.push_back("texture " + image.uri + ", which is embedded in the source");
    else if (stay && !image.uri.empty())
      notes.push_back("texture " + image.uri + ", which stays in the folder of the source");
  }
}

}  // namespace

bool takes(FileFormat format, Textures textures) {
  const bool embeds = holds(format, Feature::embedded_images);
  const bool is_named = embeds || format == FileFormat::obj || format == FileFormat::ply;
  if (textures == Textures::embed) return embeds;
  if (textures == Textures::copy) return is_named && !is_progressive(format);
  return is_named;
}

std::optional<Textures> usual_textures(FileFormat format) {
  const bool is_one_file = is_progressive(format) || format == FileFormat::glb;
  for (const Textures textures : {Textures::embed, Textures::copy})
    if (takes(format, textures) && is_one_file == (textures == Textures::embed)) return textures;
  return std::nullopt;
}

void read_textures(Scene& scene, const TextureSource& from, std::vector<std::string>& notes) {
  std::uint64_t left = from.limits.memory_bytes;
  for (Image& image : scene.images) {
    if (!image.data.empty() || image.uri.empty()) continue;
    const std::string why = read_texture(image, from, left);
    if (!why.empty()) notes.push_back("texture " + image.uri + ", which " + why);
  }
}

void name_textures(Scene& scene, const std::string& stem, bool named,
                   std::vector<std::string>& notes) {
  std::set<std::string> taken;
  std::size_t number = 0;
  for (Image& image : scene.images) {
    ++number;
    if (image.data.empty() || (image.uri.empty() && !named)) continue;
    std::string name = with_slashes(image.uri);
    const bool is_odd = !name.empty() && !is_path(name, false);
    if (is_odd) name = file_name(name);
    if (name.empty()) name = stem + "_" + std::to_string(number) + ending_of(image);
    name = unique_name(name, taken);
    if (is_odd) notes.push_back("the place of texture " + image.uri + ", written as " + name);
    if (is_odd || name != with_slashes(image.uri)) image.uri = name;
  }
}

void prepare_textures(Scene& scene, const TextureSource& from, const std::string& target_path,
                      FileFormat target, Textures textures, std::vector<std::string>& notes) {
  const bool embeds = holds(target, Feature::embedded_images);
  if (textures == Textures::reference) {
    if (!embeds || !is_same_folder(from.model_path, target_path))
      note_references(scene, !is_same_folder(from.model_path, target_path), notes);
    return;
  }
  read_textures(scene, from, notes);
  if (textures == Textures::copy)
    name_textures(scene, fs::path(target_path).stem().string(), !embeds, notes);
}

}  // namespace pstrips::inline converters
