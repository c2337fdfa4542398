#include "converters/files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

#include "converters/merge.h"
#include "converters/text_collapses.h"
#include "formats/gltf/gltf.h"
#include "formats/medit/medit.h"
#include "formats/obj/obj.h"
#include "formats/ply/ply.h"
#include "formats/pstrip/container/binary.h"
#include "formats/pstrip/text/text.h"
#include "formats/pstrip/xml/xml.h"
#include "formats/xyz/xyz.h"

namespace pstrips::inline converters {
namespace {

constexpr std::array<std::string_view, 8> kNames = {"ply", "obj",    "gltf",    "glb",
                                                    "xyz", "pstrip", "pstripx", "pm"};

// Companions are looked for in the folder of the model.
auto companions_of(const std::string& path, const Limits& limits) {
  return [folder = std::filesystem::path(path == "-" ? "." : path).parent_path(),
          max = limits.memory_bytes](const std::string& name) -> Result<Bytes> {
    auto file = read_file(folder / name, max);
    if (!file) return tl::unexpected(file.error());
    return Bytes(file->view().begin(), file->view().end());
  };
}

template <class T>
Result<LoadedFile> loaded(FileFormat format, Result<T> content) {
  if (!content) return tl::unexpected(content.error());
  return LoadedFile{
      .format = format, .bytes = 0, .content = std::move(content).value(), .notes = {}};
}

Result<LoadedFile> load_text(ByteView bytes, const LoadOptions& options) {
  auto text = read_text(bytes, options.limits);
  if (!text) return tl::unexpected(text.error());
  std::vector<CollapseSequence> collapses{collapses_of(*text)};
  Model model;
  model.meshes.push_back(std::move(text->mesh));
  return loaded(FileFormat::pm, encode_with(model, collapses, options.text_options));
}

// Piece by piece, so that the file and what is made of it are not in memory together.
Result<LoadedFile> load_binary(const FileBytes& file, const LoadOptions& options) {
  constexpr std::size_t kPiece = 1 << 20;
  const ByteView bytes = file.view();
  BinaryParser parser(options.limits, bytes.size());
  for (std::size_t at = 0; at < bytes.size(); at += kPiece) {
    const auto fed = parser.feed(bytes.subspan(at, std::min(kPiece, bytes.size() - at)));
    if (!fed) return tl::unexpected(fed.error());
    file.forget(at + kPiece);
  }
  const auto missing = parser.end();
  if (missing && !(options.allow_prefix && parser.has_base())) return tl::unexpected(*missing);
  return loaded(FileFormat::pstrip, Result<ProgressiveStrips>(std::move(parser).take()));
}

Result<LoadedFile> parse(FileFormat format, const FileBytes& file, const std::string& path,
                         const LoadOptions& options) {
  const ByteView bytes = file.view();
  const auto companions = companions_of(path, options.limits);
  switch (format) {
    case FileFormat::ply:
      return loaded(format, read_ply(bytes, options.limits));
    case FileFormat::obj:
      return loaded(format, read_obj(bytes, companions, options.limits));
    case FileFormat::gltf:
    case FileFormat::glb: {
      std::vector<std::string> notes;
      auto out = loaded(format, read_gltf(bytes, companions, options.limits, &notes));
      if (out) out->notes = std::move(notes);
      return out;
    }
    case FileFormat::xyz:
      return loaded(format, read_xyz(bytes, options.limits));
    case FileFormat::pstrip:
      return load_binary(file, options);
    case FileFormat::pstripx:
      return loaded(format, read_xml(bytes, options.limits));
    case FileFormat::pm:
      return load_text(bytes, options);
  }
  return fail(ErrorCode::bad_argument, "no such format");
}

// What companions of an output are called. A name that a reader would take for a scheme, a folder
// or the end of a line gets underscores.
std::string companion_stem(const std::string& path) {
  if (path == "-") return "model";
  std::string stem = std::filesystem::path(path).stem().string();
  std::ranges::replace_if(
      stem, [](unsigned char c) { return c < 0x20 || c == 0x7f || c == ':' || c == '\\'; }, '_');
  if (stem.starts_with(' ')) stem.front() = '_';
  return stem;
}

struct Pending {
  std::string path;
  Bytes bytes;
};

Result<SavedFiles> write(std::vector<Pending> files, std::vector<std::string> notes) {
  SavedFiles out;
  out.notes = std::move(notes);
  std::vector<OutputFile> views;
  for (const Pending& file : files) {
    views.push_back({file.path, file.bytes});
    out.paths.push_back(file.path);
    out.bytes += file.bytes.size();
  }
  if (auto done = write_files(views); !done) return tl::unexpected(done.error());
  return out;
}

std::string beside(const std::string& path, const std::string& name) {
  return (std::filesystem::path(path).parent_path() / name).string();
}

// What write_ply has no words for.
void note_ply_losses(const Scene& scene, std::vector<std::string>& notes) {
  Material only_texture;  // as read_ply makes one from a texture's name
  only_texture.metallic = 0;
  const auto is_lost = [&](const Material& material) {
    only_texture.base_color_image = material.base_color_image;
    return material != only_texture;
  };
  const auto is_embedded = [](const Image& image) { return !image.data.empty(); };
  const auto is_moved = [](const Node& node) {
    return !node.meshes.empty() && node.matrix != Node{}.matrix;
  };
  if (std::ranges::any_of(scene.materials, is_lost))
    notes.emplace_back("materials beyond a texture's name");
  if (std::ranges::any_of(scene.images, is_embedded)) notes.emplace_back("embedded images");
  if (std::ranges::any_of(scene.nodes, is_moved)) notes.emplace_back("node transforms");
}

Result<SavedFiles> save_ply(const Model& model, const std::string& path,
                            const SaveOptions& options) {
  std::vector<std::string> notes;
  const bool several = model.meshes.size() > 1;
  const Model one = several ? merge_meshes(model, notes) : Model{};
  note_ply_losses(model.scene, notes);
  auto bytes = write_ply(several ? one : model,
                         {.format = options.ascii ? PlyWriteOptions::Format::ascii
                                                  : PlyWriteOptions::Format::little_endian,
                          .threads = options.threads});
  if (!bytes) return tl::unexpected(bytes.error());
  std::vector<Pending> files;
  files.push_back({path, std::move(bytes).value()});
  return write(std::move(files), std::move(notes));
}

Result<SavedFiles> save_obj(const Model& model, const std::string& path, unsigned threads) {
  auto written =
      write_obj(model, path == "-" ? std::string() : companion_stem(path) + ".mtl", threads);
  if (!written) return tl::unexpected(written.error());
  std::vector<Pending> files;
  files.push_back({path, std::move(written->obj)});
  if (!written->mtl.empty() && path != "-")
    files.push_back({beside(path, written->mtl_name), std::move(written->mtl)});
  return write(std::move(files), std::move(written->dropped));
}

Result<SavedFiles> save_gltf(const Model& model, const std::string& path, FileFormat format,
                             const SaveOptions& options) {
  auto written = write_gltf(
      model, {.binary = format == FileFormat::glb,
              .topology = options.strips ? GltfTopology::strips : GltfTopology::triangles,
              .embed = path == "-",
              .buffer_name = companion_stem(path) + ".bin"});
  if (!written) return tl::unexpected(written.error());
  std::vector<Pending> files;
  files.push_back({path, std::move(written->main)});
  for (auto& [name, bytes] : written->others)
    files.push_back({beside(path, name), std::move(bytes)});
  return write(std::move(files), std::move(written->dropped));
}

}  // namespace

std::string_view name_of(FileFormat format) { return kNames[static_cast<std::size_t>(format)]; }

std::optional<FileFormat> format_named(std::string_view name) {
  const auto at = std::ranges::find(kNames, name);
  if (at == kNames.end()) return std::nullopt;
  return static_cast<FileFormat>(at - kNames.begin());
}

std::optional<FileFormat> format_of_path(std::string_view path) {
  std::string extension = std::filesystem::path(path).extension().string();
  if (extension.empty()) return std::nullopt;
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return format_named(std::string_view(extension).substr(1));
}

std::optional<FileFormat> detect_format(ByteView bytes, std::string_view path) {
  const std::string_view text = as_text(bytes);
  const auto by_path = format_of_path(path);
  if (text.starts_with("ply\n") || text.starts_with("ply\r")) return FileFormat::ply;
  if (text.starts_with("glTF")) return FileFormat::glb;
  // Signatures cut short or mangled are still recognised by the name, so that the reader says what
  // is wrong with them.
  if (text.starts_with("\x8aPST")) return FileFormat::pstrip;
  if (by_path) return by_path;
  if (looks_like_xml(bytes)) return FileFormat::pstripx;
  if (looks_like_text(bytes)) return FileFormat::pm;
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != text.npos && text[first] == '{') return FileFormat::gltf;
  // An OBJ is text whose lines begin with its keywords or comments.
  if (first != text.npos && std::string_view("#vfgomus").find(text[first]) != text.npos &&
      text.substr(0, 4096).find('\0') == text.npos)
    return FileFormat::obj;
  return std::nullopt;
}

Result<Model> LoadedFile::model(const LevelChoice& choice) && {
  if (auto* model = std::get_if<Model>(&content)) return std::move(*model);
  ProgressiveStrips strips = std::move(std::get<ProgressiveStrips>(content));
  content = Model{};
  const std::size_t packets = packets_for(strips, choice);
  return decode(std::move(strips), packets);
}

Result<LoadedFile> load(const FileBytes& file, const std::string& path,
                        const LoadOptions& options) {
  const auto format = detect_format(file.view(), path);
  if (!format) return fail(ErrorCode::unsupported, "is none of the known formats", kNoOffset, path);
  auto out = parse(*format, file, path, options);
  if (out) out->bytes = file.view().size();
  return out;
}

Result<LoadedFile> load(const std::string& path, const LoadOptions& options) {
  const auto file = read_file(path, options.limits.memory_bytes);
  if (!file) return tl::unexpected(file.error());
  return load(*file, path, options);
}

Result<TetraMesh> load_tetra_mesh(const FileBytes& file, const Limits& limits) {
  return read_medit(file.view(), limits);
}

bool holds_tetra_mesh(const FileBytes& file, const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".mesh" || looks_like_medit(file.view());
}

Result<SavedFiles> save(const Model& model, const std::string& path, FileFormat format,
                        const SaveOptions& options) {
  switch (format) {
    case FileFormat::ply:
      return save_ply(model, path, options);
    case FileFormat::obj:
      return save_obj(model, path, options.threads);
    case FileFormat::gltf:
    case FileFormat::glb:
      return save_gltf(model, path, format, options);
    case FileFormat::xyz:
      return fail(ErrorCode::bad_argument, "points in text are read, not written");
    default:
      return fail(ErrorCode::bad_argument, "a progressive format needs encoding first");
  }
}

Result<SavedFiles> save(const ProgressiveStrips& strips, const std::string& path,
                        FileFormat format) {
  std::vector<Pending> files;
  std::vector<std::string> notes;
  switch (format) {
    case FileFormat::pstrip: {
      auto bytes = write_binary(strips);
      if (!bytes) return tl::unexpected(bytes.error());
      files.push_back({path, std::move(bytes).value()});
      break;
    }
    case FileFormat::pstripx:
      files.push_back({path, write_xml(strips)});
      break;
    case FileFormat::pm: {
      auto text = write_text(strips);
      if (!text) return tl::unexpected(text.error());
      files.push_back({path, std::move(text->bytes)});
      notes = std::move(text->dropped);
      break;
    }
    default:
      return fail(ErrorCode::bad_argument, "not a progressive format");
  }
  return write(std::move(files), std::move(notes));
}

}  // namespace pstrips::inline converters
