#include <algorithm>
#include <filesystem>

#include "converters/file_io.h"
#include "converters/text_collapses.h"
#include "formats/gltf/gltf.h"
#include "formats/obj/obj.h"
#include "formats/ply/ply.h"
#include "formats/pstrip/container/binary.h"
#include "formats/pstrip/text/text.h"
#include "formats/pstrip/xml/xml.h"
#include "formats/xyz/xyz.h"

namespace pstrips::inline converters {
namespace {

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

}  // namespace

Result<LoadedFile> load_ply(const FileBytes& file, const std::string&, const LoadOptions& options) {
  return loaded(FileFormat::ply, read_ply(file.view(), options.limits));
}

Result<LoadedFile> load_obj(const FileBytes& file, const std::string& path,
                            const LoadOptions& options) {
  std::vector<std::string> notes;
  const auto companions = companions_of(path, options.limits);
  auto out = loaded(FileFormat::obj,
                    read_obj(file.view(), companions, options.limits,
                             {.allow_parent_paths = options.allow_parent_paths, .notes = &notes}));
  if (out) out->notes = std::move(notes);
  return out;
}

Result<LoadedFile> load_gltf(const FileBytes& file, const std::string& path,
                             const LoadOptions& options) {
  std::vector<std::string> notes;
  const auto companions = companions_of(path, options.limits);
  auto out = loaded(FileFormat::gltf, read_gltf(file.view(), companions, options.limits, &notes));
  if (out) out->notes = std::move(notes);
  return out;
}

Result<LoadedFile> load_xyz(const FileBytes& file, const std::string&, const LoadOptions& options) {
  return loaded(FileFormat::xyz, read_xyz(file.view(), options.limits));
}

// Piece by piece, so that the file and what is made of it are not in memory together.
Result<LoadedFile> load_pstrip(const FileBytes& file, const std::string&,
                               const LoadOptions& options) {
  constexpr std::size_t kPiece = 1 << 20;
  const ByteView bytes = file.view();
  BinaryParser parser(options.limits, bytes.size());
  for (std::size_t at = 0; at < bytes.size(); at += kPiece) {
    const auto fed = parser.feed(bytes.subspan(at, std::min(kPiece, bytes.size() - at)));
    if (!fed) return tl::unexpected(fed.error());
    file.release(at + kPiece);
  }
  const auto missing = parser.end();
  if (missing && !(options.allow_prefix && parser.has_base())) return tl::unexpected(*missing);
  return loaded(FileFormat::pstrip, Result<ProgressiveStrips>(std::move(parser).take()));
}

Result<LoadedFile> load_pstripx(const FileBytes& file, const std::string&,
                                const LoadOptions& options) {
  return loaded(FileFormat::pstripx, read_xml(file.view(), options.limits));
}

Result<LoadedFile> load_pm(const FileBytes& file, const std::string&, const LoadOptions& options) {
  auto text = read_text(file.view(), options.limits);
  if (!text) return tl::unexpected(text.error());
  std::vector<CollapseSequence> collapses{collapses_of(*text)};
  Model model;
  model.meshes.push_back(std::move(text->mesh));
  model.scene.texture_origin = TextureOrigin::lower_left;
  return loaded(FileFormat::pm, encode_with(model, collapses, options.text_options));
}

}  // namespace pstrips::inline converters
