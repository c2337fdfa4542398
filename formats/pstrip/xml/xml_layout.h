#pragma once

#include <algorithm>

#include "core/progressive_strips.h"
#include "formats/pstrip/container/chunks.h"
#include "formats/pstrip/payload/check.h"
#include "formats/pstrip/payload/predicates.h"
#include "formats/pstrip/xml/xml_names.h"
#include "formats/pstrip/xml/xml_text.h"

// For formats/pstrip/xml: what each element of the XML variant holds, once, for reading, writing,
// locating and for the test that compares it with the schema. [spec/xml.md §2]
//
// A `…_fields(io, v)` function names the attributes of an element, then its content, in file
// order; what happens to them is the Io's business: XmlReadIo fills v and notes where each part
// stands, XmlWriteIo writes v. v is const for all but XmlReadIo. An operation takes the name of
// the attribute or element; where a part of the model has a path of its own, what its element adds
// to the path follows: "/groups" in "/meshes/0/groups/2", "" for nothing.
//
// `demand` says whether a condition holds, and fails the reading with its fault when not; what
// comes after it may rely on the condition.

namespace pstrips::inline formats::xml_layout {

template <class Io, class N>
void node_fields(Io& io, N& node) {
  io.string("name", node.name);
  io.index_or_none("parent", node.parent);
  io.reals("matrix", node.matrix);
  io.indices("meshes", node.meshes);
}

template <class Io, class S>
void scene_fields(Io& io, S& strips) {
  io.string("generator", strips.generator);
  io.word("texture_origin", strips.scene.texture_origin, kTextureOriginNames,
          Fault::value_undefined);
  io.content();
  io.children("node", "/nodes", strips.scene.nodes,
              [](auto& child, auto& node) { node_fields(child, node); });
}

template <class Io, class M>
void map_fields(Io& io, M& map) {
  io.word("role", map.role, kMapRoleNames, Fault::value_undefined);
  io.index("image", map.image);
  io.index("texcoord", map.texcoord);
  io.real("strength", map.strength);
  io.reals("offset", map.offset);
  io.reals("scale", map.scale);
  io.real("rotation", map.rotation);
}

template <class Io, class M>
void material_fields(Io& io, M& material) {
  io.string("name", material.name);
  io.reals("base_color", material.base_color);
  io.reals("emissive", material.emissive);
  io.real("metallic", material.metallic);
  io.real("roughness", material.roughness);
  io.word("alpha_mode", material.alpha_mode, kAlphaModeNames, Fault::value_undefined);
  io.real("alpha_cutoff", material.alpha_cutoff);
  io.flag("double_sided", material.double_sided);
  io.content();
  io.children("map", "/maps", material.maps,
              [](auto& child, auto& map) { map_fields(child, map); });
}

template <class Io, class I>
void image_fields(Io& io, I& image) {
  io.string("name", image.name);
  io.string("uri", image.uri);
  io.string("mime_type", image.mime_type);
}

template <class Io, class S>
void materials_fields(Io& io, S& scene) {
  io.content();
  io.children("material", "/materials", scene.materials,
              [](auto& child, auto& material) { material_fields(child, material); });
  io.children("image", "/images", scene.images,
              [](auto& child, auto& image) { image_fields(child, image); });
}

// ---- Meshes --------------------------------------------------------------------------------

template <class Io, class A>
void format_fields(Io& io, A& attribute) {
  io.string("semantic", attribute.semantic);
  io.word("type", attribute.type, kTypeNames, Fault::type_undefined);
  io.component_count("count", attribute.count);
  io.flag_unless("normalized", attribute.normalized, false);
}

template <class Io, class M, class G>
void group_fields(Io& io, M& mesh, G& group) {
  if constexpr (Io::kReads) mesh.group_entries.resize(mesh.groups.size());
  io.string("name", group.name);
  io.index_or_none("material", group.material);
  io.word("kind", group.kind, kFaceKindNames, Fault::value_undefined);
  io.index("map_entries", mesh.group_entries[static_cast<std::size_t>(&group - &mesh.groups[0])]);
}

/// The plain profile has no use for a grid, nor for an effort.
template <class Io, class M>
void mesh_fields(Io& io, M& mesh, Profile profile) {
  io.string("name", mesh.name);
  io.word("encoding", mesh.encoding, kEncodingNames, Fault::value_undefined);
  io.word("placement", mesh.placement, kPlacementNames, Fault::value_undefined);
  io.flag("single_wedges", mesh.single_wedges);
  io.index("vertices", mesh.vertices);
  io.index("wedges", mesh.wedges);
  io.index("triangles", mesh.triangles);
  io.index("strips", mesh.strips);
  io.index("base_vertices", mesh.base_vertices);
  io.index("base_wedges", mesh.base_wedges);
  if (profile != Profile::plain) {
    io.real("grid_step", mesh.grid.step);
    io.integers("grid_origin", mesh.grid.origin);
    io.flag("grid_exact", mesh.grid.exact);
    io.word("effort", mesh.effort, kEffortNames, Fault::value_undefined);
  }
  io.content();
  const auto format = [](auto& child, auto& attribute) { format_fields(child, attribute); };
  io.child("position", "/position", [&](auto& child) { format_fields(child, mesh.position); });
  io.children("wedge_attribute", "/wedge_attributes", mesh.wedge_attributes, format);
  io.children("face_attribute", "/face_attributes", mesh.face_attribute_formats, format);
  io.children("group", "/groups", mesh.groups,
              [&](auto& child, auto& group) { group_fields(child, mesh, group); });
  std::uint64_t map_entries = 0;
  for (const Index n : mesh.group_entries) map_entries += n;
  io.announce({mesh.vertices, mesh.wedges, map_entries});
}

// ---- Levels --------------------------------------------------------------------------------

template <class Io, class P>
void level_fields(Io& io, P& level) {
  io.index("vertices", level.vertices);
  io.index("triangles", level.triangles);
  io.index("strips", level.strips);
  io.real("error", level.error);
  io.real("one_sided_error", level.one_sided_error);
}

template <class Io, class S, class B>
void base_fields(Io& io, S& strips, B& base) {
  const auto number = static_cast<std::size_t>(&base - &strips.bases[0]);
  io.index("mesh", base.mesh);
  level_fields(io, base);
  io.content();
  if (!io.demand(base.mesh == number && number < strips.meshes.size(), Fault::xml_bases,
                 "bases are not in the order of the meshes", "mesh"))
    return;
  auto& mesh = strips.meshes[number];
  io.belongs_to("/meshes/", number);
  io.elements("positions", mesh.position, mesh.base_vertices);
  if (!mesh.single_wedges) io.numbers("wedge_vertex", "/base_wedge_vertex", mesh.base_wedge_vertex);
  for (auto& attribute : mesh.wedge_attributes) io.elements("values", attribute, mesh.base_wedges);
  io.map_entries("map", "/base_map", mesh.base_map, mesh.encoding);
  if (!has_triangle_groups(mesh)) return;
  io.numbers("triangle_group", "/triangle_group", mesh.triangle_group, mesh.base_map.size() / 3);
}

/// What a new wedge brings: the attributes of a `wedge`, or of a `vsplit` that is its only wedge.
/// start  where the wedge's part of each of the mesh's lists begins; moves on to the next wedge
template <class Io, class M, class V>
void wedge_fields(Io& io, M& mesh, V& vsplit, PacketStart& start) {
  if constexpr (Io::kReads) mesh.wedge_offset_counts.push_back(0);
  auto& count = mesh.wedge_offset_counts[start.offset_count];
  io.values("values", mesh.wedge_attributes, start.wedges);
  io.run("map_offsets", mesh.map_offsets, start.map_offset, count);
  if constexpr (Io::kReads) {
    ++vsplit.wedges;
    vsplit.map_offsets += count;
  }
  ++start.wedges;
  ++start.offset_count;
  start.map_offset += count;
}

/// What a vsplit appends to a map of triangles.
/// start  where the vsplit's part of each of the mesh's lists begins
template <class Io, class M, class V>
void triangle_fields(Io& io, M& mesh, V& vsplit, const PacketStart& start) {
  if (mesh.encoding != MapEncoding::triangles) return;
  Index corners = 3 * vsplit.triangles, groups = vsplit.triangles;
  io.run_unless_empty("new_triangles", mesh.new_corners, start.new_corner, corners);
  if constexpr (Io::kReads) vsplit.triangles = corners / 3;
  if (!io.demand(corners % 3 == 0, Fault::xml_list_length, "not three wedges for each triangle",
                 "new_triangles") ||
      !has_triangle_groups(mesh))
    return;
  io.run_unless_empty("triangle_group", mesh.triangle_group,
                      (mesh.base_map.size() + start.new_corner) / 3, groups);
  io.demand(groups == vsplit.triangles, Fault::xml_list_length,
            "not one group for each new triangle", "triangle_group");
}

/// start  where the vsplit's part of each of the mesh's lists begins
template <class Io, class M>
void vsplit_fields(Io& io, M& mesh, const PacketStart& start) {
  if constexpr (Io::kReads) mesh.vsplits.emplace_back();
  auto& vsplit = mesh.vsplits[start.vsplit];
  PacketStart wedge = start;
  io.shape_is(Fault::xml_vsplit_form);
  io.index("parent", vsplit.parent);
  io.element("position", mesh.position, mesh.position.data, start.vertices);
  if (mesh.placement == Placement::optimal)
    io.element("parent_position", mesh.position, mesh.parent_position, start.vsplit);
  if (mesh.single_wedges) {
    wedge_fields(io, mesh, vsplit, wedge);
    return triangle_fields(io, mesh, vsplit, start);
  }
  io.run_unless_empty("reassigned", mesh.reassigned, start.reassigned, vsplit.reassigned);
  triangle_fields(io, mesh, vsplit, start);
  io.content(vsplit.wedges > 0);
  io.each("wedge", "", vsplit.wedges,
          [&](auto& child) { wedge_fields(child, mesh, vsplit, wedge); });
}

/// start  where the packet's part of each of the mesh's lists begins, one a mesh; moves on
template <class Io, class S, class P>
void packet_fields(Io& io, S& strips, P& packet, std::vector<PacketStart>& starts) {
  io.index("mesh", packet.mesh);
  io.index("first_vsplit", packet.first_vsplit);
  io.index("vsplits", packet.vsplits);
  level_fields(io, packet);
  io.content();
  if (!io.demand(packet.mesh < strips.meshes.size(), Fault::packet_mesh,
                 "packet names a mesh past the end", "mesh"))
    return;
  auto& mesh = strips.meshes[packet.mesh];
  PacketStart& start = starts[packet.mesh];
  io.belongs_to("/meshes/", packet.mesh);
  const std::size_t found = io.each("vsplit", "/vsplits", packet.vsplits, [&](auto& child) {
    vsplit_fields(child, mesh, start);
    start = packet_after(mesh, start, 1);
  });
  io.demand(found == packet.vsplits, Fault::xml_packet_vsplits, "not as many vsplits as announced",
            "vsplits");
}

// ---- Tail ----------------------------------------------------------------------------------

template <class Io, class F>
void face_fields(Io& io, F& faces, std::size_t f) {
  if constexpr (Io::kReads) {
    if (f == 0) faces.first = faces.replaced_first = {0};
    faces.group.push_back(0);
  }
  io.index("group", faces.group[f]);
  io.run_to_bound("corners", faces.corners, faces.first, f);
  io.run_to_bound("replaced", faces.replaced, faces.replaced_first, f);
}

template <class Io, class M>
void faces_fields(Io& io, M& mesh) {
  auto& faces = mesh.faces;
  io.content();
  io.each("face", "", faces.count(),
          [&, f = std::size_t{0}](auto& child) mutable { face_fields(child, faces, f++); });
  io.announce({0, 0, faces.corners.size()});
  if (!io.demand(faces.replaced.size() <= mesh.triangles, Fault::xml_list_length,
                 "more triangles replaced than there are"))
    return;
  if constexpr (Io::kReads) faces.attributes = mesh.face_attribute_formats;
  for (auto& attribute : faces.attributes) io.elements("values", attribute, face_count(mesh));
}

template <class Io, class M>
void welding_fields(Io& io, M& mesh) {
  auto& welding = mesh.welding;
  io.index("vertices", welding.vertices);
  io.index("wedges", welding.wedges);
  io.content();
  io.numbers("skip", "/skip", welding.skip);
  io.numbers("more", "/more", welding.more);
  io.numbers("corner", "/corner", welding.corner);
  io.numbers("vertex", "/vertex", welding.vertex);
  io.numbers("moved", "/moved", welding.moved);
  if constexpr (Io::kReads) welding.moved_position = mesh.position.format();
  io.elements("positions", welding.moved_position, welding.moved.size());
}

template <class Io, class M>
void order_fields(Io& io, M& mesh) {
  io.content();
  io.numbers("vertex", "/vertex", mesh.order.vertex);
  if (mesh.orders_wedges()) io.numbers("wedge", "/wedge", mesh.order.wedge);
  io.numbers("face", "/face", mesh.order.face);
  io.numbers("rotation", "/rotation", mesh.order.rotation);
}

template <class Io, class M>
void digest_fields(Io& io, M& mesh) {
  io.constant("algorithm", kDigestAlgorithm, Fault::digest_unknown);
  io.hexadecimal(mesh.digest, 32);
}

template <class Io, class F>
void foreign_fields(Io& io, F& foreign) {
  ForeignForm form = ForeignForm::text;
  if constexpr (!Io::kReads)
    if (!fits_content(foreign.data)) form = ForeignForm::base64;
  io.string("key", foreign.key);
  io.word("form", form, kFormNames, Fault::value_undefined);
  if (form == ForeignForm::base64)
    io.base64(foreign.data);
  else
    io.text(foreign.data);
}

template <class Io, class C>
void chunk_fields(Io& io, C& chunk) {
  io.letters("type", chunk.type, Fault::xml_chunk_type);
  io.demand(is_chunk_type(chunk.type), Fault::xml_chunk_type, "not a chunk type", "type");
  io.demand(!is_known(chunk.type), Fault::xml_chunk_type, "chunk type that has elements of its own",
            "type");
  io.demand(!is_critical(chunk.type), Fault::critical_chunk_unknown,
            "critical chunk that this build does not know", "type");
  io.base64(chunk.payload);
}

// ---- The document --------------------------------------------------------------------------

/// A part that items of a list may have, each once: an element that names its item by an
/// attribute.
template <class Has, class Fields>
struct ItemPart {
  const char* name;
  const char* part;
  Fault past_end;  ///< of an item that is not there
  Has has;
  Fields fields;
};

template <class Io, class S>
void tail_fields(Io& io, S& strips) {
  io.parts("mesh", "/meshes/", strips.meshes,
           ItemPart{"faces", "/faces", Fault::faces_mesh,
                    [](const ProgressiveMesh& m) { return !m.faces.empty(); },
                    [](auto& child, auto& mesh) { faces_fields(child, mesh); }},
           ItemPart{"welding", "/welding", Fault::welding_mesh,
                    [](const ProgressiveMesh& m) { return !m.welding.empty(); },
                    [](auto& child, auto& mesh) { welding_fields(child, mesh); }},
           ItemPart{"order", "/order", Fault::order_mesh,
                    [](const ProgressiveMesh& m) { return m.order != OriginalOrder{}; },
                    [](auto& child, auto& mesh) { order_fields(child, mesh); }},
           ItemPart{"digest", "/digest", Fault::digest_mesh,
                    [](const ProgressiveMesh& m) { return !m.digest.empty(); },
                    [](auto& child, auto& mesh) { digest_fields(child, mesh); }});
  io.parts("image", "/scene/images/", strips.scene.images,
           ItemPart{"image_data", "/data", Fault::image_data,
                    [](const Image& image) { return !image.data.empty(); },
                    [](auto& child, auto& image) { child.base64(image.data); }});
  io.children("foreign", "/scene/foreign", strips.scene.foreign,
              [](auto& child, auto& foreign) { foreign_fields(child, foreign); });
  io.children("chunk", "/unknown", strips.unknown,
              [](auto& child, auto& chunk) { chunk_fields(child, chunk); });
}

/// Of the first version 2 that has all of it.
inline Index needed_version_minor(const ProgressiveStrips& strips) {
  if (has_scene_fields(strips) || has_materials(strips.scene)) return 2;
  Index needed = strips.profile == Profile::plain ? 0 : 1;
  for (const ProgressiveMesh& mesh : strips.meshes) {
    if (mesh.encoding == MapEncoding::triangles) needed = std::max(needed, Index{1});
    if (!mesh.welding.empty()) needed = std::max(needed, Index{2});
  }
  return needed;
}

template <class Io, class S>
void document_fields(Io& io, S& strips) {
  io.version("version", needed_version_minor(strips));
  io.profile("profile", strips.profile);
  io.flag_unless("complete", strips.complete, true);
  io.content();
  auto& scene = strips.scene;
  io.child_if(has_scene_fields(strips), "scene", "/scene",
              [&](auto& child) { scene_fields(child, strips); });
  io.child_if(has_materials(scene), "materials", "/scene",
              [&](auto& child) { materials_fields(child, scene); });
  io.children("mesh", "/meshes", strips.meshes,
              [&](auto& child, auto& mesh) { mesh_fields(child, mesh, strips.profile); });
  io.children("base", "/bases", strips.bases,
              [&](auto& child, auto& base) { base_fields(child, strips, base); });
  if (!io.demand(strips.bases.size() == strips.meshes.size(), Fault::xml_bases,
                 "not one base for each mesh"))
    return;
  std::vector<PacketStart> starts;
  for (const auto& mesh : strips.meshes) starts.push_back(first_packet(mesh));
  io.children("packet", "/packets", strips.packets,
              [&](auto& child, auto& packet) { packet_fields(child, strips, packet, starts); });
  tail_fields(io, strips);
}

}  // namespace pstrips::inline formats::xml_layout
