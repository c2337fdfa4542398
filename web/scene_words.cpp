#include "web/scene_words.h"

namespace pstrips::inline web {
namespace {

template <class T>
std::uint32_t number(T value) {
  return static_cast<std::uint32_t>(value);
}

template <class List, class Write>
void write_list(ByteWriter& out, const List& list, Write write) {
  out.u32(number(list.size()));
  for (const auto& element : list) write(element);
}

void write_material(ByteWriter& out, const Material& material) {
  out.string(material.name);
  out.array<double>(material.base_color);
  out.array<double>(material.emissive);
  out.f64(material.metallic);
  out.f64(material.roughness);
  out.f64(material.alpha_cutoff);
  out.u32(number(material.alpha_mode));
  out.u32(material.image(MapRole::base_color));
  out.u32(number(material.double_sided));
}

void write_mesh(ByteWriter& out, const ProgressiveMesh& mesh) {
  out.string(mesh.name);
  out.u32(mesh.vertices);
  out.u32(mesh.wedges);
  out.u32(mesh.triangles);
  write_list(out, mesh.groups, [&](const Group& group) {
    out.string(group.name);
    out.u32(group.material);
    out.u32(number(group.kind));
  });
  write_list(out, mesh.wedge_attributes, [&](const Attribute& attribute) {
    out.string(attribute.semantic);
    out.u32(number(attribute.type));
    out.u32(attribute.count);
    out.u32(number(attribute.normalized));
  });
}

}  // namespace

Bytes scene_words(const ProgressiveStrips& strips, std::uint64_t packets) {
  ByteWriter out;
  out.u32(number(strips.profile));
  out.u32(number(packets));
  out.u32(number(strips.scene.texture_origin));
  write_list(out, strips.scene.materials,
             [&](const Material& material) { write_material(out, material); });
  write_list(out, strips.scene.images, [&](const Image& image) {
    out.string(image.name);
    out.string(image.uri);
    out.string(image.mime_type);
  });
  write_list(out, strips.scene.nodes, [&](const Node& node) {
    out.string(node.name);
    out.u32(node.parent);
    out.array<double>(node.matrix);
    write_list(out, node.meshes, [&](Index mesh) { out.u32(mesh); });
  });
  write_list(out, strips.meshes, [&](const ProgressiveMesh& mesh) { write_mesh(out, mesh); });
  return std::move(out).take();
}

}  // namespace pstrips::inline web
