#include <algorithm>
#include <filesystem>

#include "codecs/triangulate/triangulate.h"
#include "converters/file_io.h"
#include "converters/merge.h"
#include "core/texture_origin.h"
#include "formats/gltf/gltf.h"
#include "formats/obj/obj.h"
#include "formats/ply/ply.h"
#include "formats/pstrip/container/binary.h"
#include "formats/pstrip/text/text.h"
#include "formats/pstrip/xml/xml.h"

namespace pstrips::inline converters {
namespace {

// What companions of an output are called. A name that a reader would take for a scheme, a folder
// or the end of a line gets underscores.
std::string companion_stem(const std::string& path) {
  std::string stem = std::filesystem::path(path).stem().string();
  std::ranges::replace_if(
      stem, [](unsigned char c) { return c < 0x20 || c == 0x7f || c == ':' || c == '\\'; }, '_');
  if (stem.starts_with(' ')) stem.front() = '_';
  return stem;
}

FileSet one_file(const OutputName& name, Bytes bytes, std::vector<std::string> notes = {}) {
  FileSet out;
  out.files.push_back({name.path, std::move(bytes)});
  out.notes = std::move(notes);
  return out;
}

std::string beside(const std::string& path, const std::string& name) {
  return (std::filesystem::path(path).parent_path() / name).string();
}

GltfTopology topology_of(const SaveOptions& options) {
  if (options.joined_strips) return GltfTopology::joined_strips;
  return options.strips ? GltfTopology::strips : GltfTopology::triangles;
}

// What write_ply has no words for.
void note_ply_losses(const Scene& scene, std::vector<std::string>& notes) {
  Material only_texture;  // as read_ply makes one from a texture's name
  only_texture.metallic = 0;
  const auto is_lost = [&](const Material& material) {
    only_texture.maps.clear();
    if (material.map(MapRole::base_color))
      only_texture.set_map({.image = material.image(MapRole::base_color)});
    return material != only_texture;
  };
  const auto is_embedded = [](const Image& image) {
    return !image.data.empty() && image.uri.empty();
  };
  const auto is_moved = [](const Node& node) {
    return !node.meshes.empty() && node.matrix != Node{}.matrix;
  };
  if (std::ranges::any_of(scene.materials, is_lost))
    notes.emplace_back("materials beyond a texture's name");
  if (std::ranges::any_of(scene.images, is_embedded)) notes.emplace_back("embedded images");
  if (std::ranges::any_of(scene.nodes, is_moved)) notes.emplace_back("node transforms");
}

// The same of faces that are not polygons.
void note_ply_losses(const Mesh& mesh, std::vector<std::string>& notes) {
  bool has_points = false, has_long_lines = false;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const FaceKind kind = mesh.groups[mesh.group_of(f)].kind;
    has_points |= kind == FaceKind::points;
    has_long_lines |= kind == FaceKind::lines && mesh.face(f).size() > 2;
  }
  if (has_points) notes.emplace_back("that points are faces: they are vertices");
  if (has_long_lines) notes.emplace_back("which edges are one line");
}

Result<FileSet> make_any_gltf(const Model& model, const OutputName& name, bool binary,
                              const SaveOptions& options) {
  // Concave polygons are more than the fans that a format can make of them.
  const auto has_polygons = [](const Mesh& mesh) { return !mesh.face_first.empty(); };
  const bool cuts = std::ranges::any_of(model.meshes, has_polygons);
  Model cut;
  if (cuts) {
    cut.scene = model.scene;
    for (const Mesh& mesh : model.meshes) cut.meshes.push_back(with_triangles(mesh));
  }
  auto written =
      write_gltf(cuts ? cut : model, {.binary = binary,
                                      .topology = topology_of(options),
                                      .swaps = options.strip_swaps,
                                      .embed = name.path == "-",
                                      .embed_images = options.textures == Textures::embed,
                                      .buffer_name = name.companion});
  if (!written) return tl::unexpected(written.error());
  FileSet out = one_file(name, std::move(written->main), std::move(written->dropped));
  out.converted = std::move(written->converted);
  for (auto& [other, bytes] : written->others)
    out.files.push_back({beside(name.path, other), std::move(bytes)});
  return out;
}

}  // namespace

OutputName output_name(const std::string& path, FileFormat format) {
  const std::string_view extension = row_of(format).companion;
  if (path == "-" || extension.empty()) return {path, {}};
  return {path, companion_stem(path).append(extension)};
}

std::vector<std::string> output_paths(const std::string& path, FileFormat format) {
  const OutputName name = output_name(path, format);
  if (name.companion.empty()) return {path};
  return {path, beside(path, name.companion)};
}

Result<FileSet> make_ply(const Model& model, const OutputName& name, const SaveOptions& options) {
  std::vector<std::string> notes;
  const bool several = model.meshes.size() > 1;
  Model other = several ? merge_meshes(model, notes) : Model{};
  const bool turns = model.scene.texture_origin != TextureOrigin::lower_left;
  if (turns)
    other = with_texture_origin(several ? std::move(other) : model, TextureOrigin::lower_left);
  note_ply_losses(model.scene, notes);
  for (const Mesh& mesh : model.meshes) note_ply_losses(mesh, notes);
  std::vector<std::string> dropped;
  auto bytes = write_ply(several || turns ? other : model,
                         {.format = options.ascii ? PlyWriteOptions::Format::ascii
                                                  : PlyWriteOptions::Format::little_endian,
                          .threads = options.threads},
                         &dropped);
  if (!bytes) return tl::unexpected(bytes.error());
  notes.insert(notes.end(), dropped.begin(), dropped.end());
  return one_file(name, std::move(bytes).value(), std::move(notes));
}

Result<FileSet> make_obj(const Model& model, const OutputName& name, const SaveOptions& options) {
  auto written = write_obj(model, name.companion, options.threads);
  if (!written) return tl::unexpected(written.error());
  FileSet out = one_file(name, std::move(written->obj), std::move(written->dropped));
  if (!written->mtl.empty())
    out.files.push_back({beside(name.path, written->mtl_name), std::move(written->mtl)});
  return out;
}

Result<FileSet> make_gltf(const Model& model, const OutputName& name, const SaveOptions& options) {
  return make_any_gltf(model, name, false, options);
}

Result<FileSet> make_glb(const Model& model, const OutputName& name, const SaveOptions& options) {
  return make_any_gltf(model, name, true, options);
}

Result<FileSet> make_pstrip(const ProgressiveStrips& strips, const OutputName& name) {
  FileSet out = one_file(name, {});
  out.files[0].write = [&strips](ByteSink& sink) { return write_binary(strips, sink); };
  return out;
}

Result<FileSet> make_pstripx(const ProgressiveStrips& strips, const OutputName& name) {
  return one_file(name, write_xml(strips));
}

Result<FileSet> make_pm(const ProgressiveStrips& strips, const OutputName& name) {
  // The records have no word for it; they come from programs that count upwards.
  const bool turns = strips.scene.texture_origin != TextureOrigin::lower_left;
  auto text = turns ? write_text(with_texture_origin(strips, TextureOrigin::lower_left))
                    : write_text(strips);
  if (!text) return tl::unexpected(text.error());
  return one_file(name, std::move(text->bytes), std::move(text->dropped));
}

}  // namespace pstrips::inline converters
