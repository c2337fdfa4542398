#include <algorithm>
#include <cassert>

#include "formats/gltf/container.h"
#include "formats/gltf/image_type.h"
#include "formats/gltf/primitives.h"

namespace pstrips::inline formats {
namespace gltf {
namespace {

std::string image_pointer(std::size_t i) { return "/images/" + std::to_string(i); }

/// Moves embedded image files into the images.
Result<void> read_images(Data& data, Document& document, Budget& budget) {
  for (std::size_t i = 0; i < document.images.size(); ++i) {
    Image& image = document.images[i];
    if (const Index view = document.image_view[i]; view != kNone) {
      const auto bytes = data.range(view, 0, document.views[view].bytes);
      if (!bytes) return tl::unexpected(bytes.error());
      if (!budget.take(bytes->size()))
        return fail(ErrorCode::over_limit, "images exceed the memory limit", kNoOffset,
                    image_pointer(i));
      image.data.assign(bytes->begin(), bytes->end());
    } else if (is_data_uri(image.uri)) {
      if (!budget.take(image.uri.size()))
        return fail(ErrorCode::over_limit, "images exceed the memory limit", kNoOffset,
                    image_pointer(i));
      Result<DataUri> uri = decode_data_uri(image.uri);
      if (!uri) return fail(uri.error().code, uri.error().message, kNoOffset, image_pointer(i));
      if (image.mime_type.empty()) image.mime_type = std::move(uri->mime_type);
      image.data = std::move(uri->data);
      image.uri.clear();
    }
    if (!image.data.empty() && image.mime_type.empty()) image.mime_type = mime_type_of(image.data);
  }
  return {};
}

Result<Bytes> read_kept(Data& data, const Document& document, Budget& budget) {
  if (!budget.take(document.kept_bytes))
    return fail(ErrorCode::over_limit, "animations, skins and extensions exceed the memory limit");
  Bytes out;
  for (const Kept& part : document.kept) {
    Bytes elements;
    ByteView bytes;
    if (part.is_accessor) {
      Result<Bytes> read = data.elements(part.source);
      if (!read) return read;
      elements = std::move(*read);
      bytes = elements;
    } else {
      const Result<ByteView> range = data.range(part.source, 0, part.bytes);
      if (!range) return tl::unexpected(range.error());
      bytes = *range;
    }
    out.resize(part.offset);
    out.insert(out.end(), bytes.begin(), bytes.end());
  }
  return out;
}

/// Nodes name glTF meshes; the scene's name all meshes that those became.
void place_meshes(std::vector<Node>& nodes, const PrimitiveMap& map) {
  for (Node& node : nodes) {
    if (node.meshes.empty()) continue;
    std::vector<Index> meshes;
    for (const auto& place : map.meshes[node.meshes.front()])
      if (place.mesh != kNone) meshes.push_back(place.mesh);
    std::ranges::sort(meshes);
    meshes.erase(std::unique(meshes.begin(), meshes.end()), meshes.end());
    node.meshes = std::move(meshes);
  }
}

void add_foreign(Scene& scene, std::string_view key, Bytes data) {
  if (!data.empty()) scene.foreign.push_back({std::string(key), std::move(data)});
}

}  // namespace
}  // namespace gltf

Result<Model> read_gltf(ByteView file, const ReadFile& read_file, const Limits& limits,
                        std::vector<std::string>* dropped) {
  using namespace gltf;
  std::vector<std::string> ignored;
  if (!dropped) dropped = &ignored;
  Result<Container> container = split(file);
  if (!container) return tl::unexpected(std::move(container).error());
  Result<Document> document = parse(container->json, container->json_offset, limits, *dropped);
  if (!document) return tl::unexpected(std::move(document).error());

  if (container->bytes_after > 0)
    dropped->push_back(std::to_string(container->bytes_after) + " bytes after the end of the .glb");
  Budget budget(limits);
  Data data(*document, container->bin, read_file, budget);
  Model model;
  const auto map = read_meshes(data, *document, limits, budget, model.meshes, *dropped);
  if (!map) return tl::unexpected(map.error());
  if (const auto read = read_images(data, *document, budget); !read)
    return tl::unexpected(read.error());
  Result<Bytes> kept = read_kept(data, *document, budget);
  if (!kept) return tl::unexpected(std::move(kept).error());

  model.scene.materials = std::move(document->materials);
  model.scene.images = std::move(document->images);
  model.scene.nodes = std::move(document->nodes);
  place_meshes(model.scene.nodes, *map);
  const ByteView rest = as_bytes(document->rest);
  add_foreign(model.scene, kRestKey, Bytes(rest.begin(), rest.end()));
  add_foreign(model.scene, kPrimitivesKey, map->write());
  add_foreign(model.scene, kBinKey, std::move(*kept));
  add_foreign(model.scene, kChunksKey, std::move(container->other_chunks));
  return model;
}

}  // namespace pstrips::inline formats
