#include "tests/validators/samples.h"

#include "codecs/weld/unweld.h"
#include "formats/pstrip/payload/digest.h"
#include "tests/support/progressive.h"

namespace pstrips::test {

void set_digests(ProgressiveStrips& strips) {
  for (ProgressiveMesh& mesh : strips.meshes) {
    const Mesh shown = decode_slowly(mesh, mesh.vsplits.size());
    const Digest d = digest(mesh.welding.empty() ? shown : unweld(shown, mesh.welding).value());
    mesh.digest.assign(d.begin(), d.end());
  }
}

namespace {

/// One record, then the two others.
ProgressiveStrips in_two_packets(ProgressiveMesh mesh) {
  ProgressiveStrips strips;
  strips.meshes.push_back(std::move(mesh));
  strips.bases = {{.error = 0.5f, .one_sided_error = 0.125f}};
  strips.packets = {{.vsplits = 1, .error = 0.25f, .one_sided_error = 0.125f},
                    {.first_vsplit = 1, .vsplits = 2}};
  recount_levels(strips);
  return strips;
}

}  // namespace

ProgressiveStrips roof() {
  ProgressiveMesh mesh;
  mesh.name = "roof";
  mesh.groups.resize(1);
  mesh.position = {"POSITION", ComponentType::f32, 3, false, {}};
  mesh.position.data = bytes_of({0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f,
                                 0.f, .5f, .5f, 1.f, 9.f, 9.f, 9.f, .5f, .6f, 1.f});
  mesh.base_vertices = mesh.base_wedges = 4;
  mesh.base_map = {0, 1, 0, 2, 3, kRestart, 3, 0, 0};
  mesh.group_entries = {9};
  mesh.vsplits = {{0, 1, 0, 2}, {5, 1, 0, 0}, {4, 1, 0, 1}};
  mesh.wedge_offset_counts = {2, 0, 1};
  mesh.map_offsets = {2, 8, 8};
  mesh.vertices = mesh.wedges = 7;
  mesh.triangles = 4;
  mesh.strips = 2;
  ProgressiveStrips strips = in_two_packets(std::move(mesh));
  strips.generator = "corpus";
  return strips;
}

ProgressiveStrips symbols() {
  ProgressiveStrips strips = roof();
  strips.meshes[0].encoding = MapEncoding::offset;
  strips.meshes[0].base_map = {0, 1, kSameAsMinus2, 2, 3, kRestart, 3, 0, kSameAsMinus1};
  return strips;
}

ProgressiveStrips seam() {
  ProgressiveMesh mesh;
  mesh.name = "seam";
  mesh.placement = Placement::optimal;
  mesh.single_wedges = false;
  mesh.groups = {{"left", kNone, FaceKind::polygons},
                 {"right", kNone, FaceKind::polygons},
                 {"edges", kNone, FaceKind::lines}};
  mesh.group_entries = {4, 3, 0};
  mesh.position = {"POSITION", ComponentType::f32, 2, false, {}};
  mesh.position.data = bytes_of({0.f, 0.f, 1.f, 0.f, 0.f, 1.f, .5f, 0.f, 1.f, .5f, 4.f, 4.f});
  mesh.wedge_attributes = {
      {"COLOR_0", ComponentType::u8, 1, true, bytes_of<std::uint8_t>({1, 2, 3, 4, 5, 6, 7, 8})}};
  mesh.base_vertices = 3;
  mesh.base_wedges = 4;
  mesh.base_wedge_vertex = {0, 0, 1, 2};
  mesh.base_map = {0, 2, 3, kRestart, 1, 2, 3};
  mesh.vsplits = {{0, 1, 1, 1}, {1, 2, 0, 2}, {5, 1, 0, 0}};
  mesh.reassigned = {1};
  mesh.wedge_offset_counts = {1, 1, 1, 0};
  mesh.map_offsets = {0, 1, 5};
  mesh.parent_position = bytes_of({-.5f, 0.f, 1.f, -.5f, 4.f, 4.f});
  mesh.vertices = 6;
  mesh.wedges = 8;
  mesh.triangles = mesh.strips = 2;
  mesh.face_attribute_formats = {{"_FACE_ID", ComponentType::u8, 1, false, {}}};
  mesh.faces.first = {0, 4, 6};
  mesh.faces.corners = {1, 6, 3, 0, 0, 1};
  mesh.faces.group = {1, 2};
  mesh.faces.replaced_first = {0, 1, 1};
  mesh.faces.replaced = {1};
  mesh.faces.attributes = mesh.face_attribute_formats;
  mesh.faces.attributes[0].data = bytes_of<std::uint8_t>({7, 8, 9});
  mesh.order = {{5, 4, 3, 2, 1, 0}, {7, 6, 5, 4, 3, 2, 1, 0}, {1, 2, 0}, {2, 3, 0}};
  ProgressiveStrips strips;
  strips.meshes.push_back(std::move(mesh));
  strips.bases = {{.error = 2, .one_sided_error = 2}};
  strips.packets = {{.vsplits = 2, .error = 1, .one_sided_error = 0.5f},
                    {.first_vsplit = 2, .vsplits = 1}};
  recount_levels(strips);
  set_digests(strips);
  return strips;
}

ProgressiveStrips growing() {
  ProgressiveMesh mesh;
  mesh.encoding = MapEncoding::triangles;
  mesh.single_wedges = false;
  mesh.groups = {{"left", kNone, FaceKind::polygons}, {"right", kNone, FaceKind::polygons}};
  mesh.group_entries = {9, 6};
  mesh.position = {"POSITION", ComponentType::f32, 3, false, {}};
  mesh.position.data = bytes_of({0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f,
                                 0.f, .5f, .5f, 1.f, 9.f, 9.f, 9.f, .5f, .6f, 1.f});
  mesh.wedge_attributes = {
      {"COLOR_0", ComponentType::u8, 1, true, bytes_of<std::uint8_t>({1, 2, 3, 4, 5, 6, 7, 8})}};
  mesh.base_vertices = 4;
  mesh.base_wedges = 5;
  mesh.base_wedge_vertex = {0, 0, 1, 2, 3};
  mesh.base_map = {2, 3, 0, 3, 4, 1};
  mesh.vsplits = {{0, 1, 1, 1, 2}, {5, 1, 0, 0}, {4, 1, 0, 1, 1}};
  mesh.wedge_offset_counts = {1, 0, 1};
  mesh.map_offsets = {2, 8};
  mesh.reassigned = {1};
  mesh.new_corners = {0, 2, 5, 4, 0, 1, 2, 5, 7};
  mesh.triangle_group = {0, 1, 0, 1, 0};
  mesh.vertices = 7;
  mesh.wedges = 8;
  mesh.triangles = mesh.strips = 5;
  return in_two_packets(std::move(mesh));
}

ProgressiveStrips compact() {
  ProgressiveMesh mesh;
  mesh.encoding = MapEncoding::triangles;
  mesh.groups.resize(1);
  mesh.group_entries = {18};
  mesh.grid.step = 0.125f;
  mesh.position = {"POSITION", ComponentType::f32, 3, false, {}};
  mesh.position.data = bytes_of({0.f, 0.f, 0.f, 1.f, 0.f, 0.f,   1.f, 1.f, 0.f, 0.f, 1.f,
                                 0.f, .5f, .5f, 1.f, .5f, .625f, 1.f, 9.f, 9.f, 9.f});
  mesh.base_vertices = mesh.base_wedges = 4;
  mesh.base_map = {1, 2, 0, 2, 3, 0};
  mesh.vsplits = {{0, 1, 0, 2, 2}, {4, 1, 0, 1, 2}, {6, 1, 0, 0}};
  mesh.wedge_offset_counts = {2, 1, 0};
  mesh.map_offsets = {2, 5, 5};
  mesh.new_corners = {0, 1, 4, 0, 4, 3, 4, 2, 5, 4, 5, 3};
  mesh.vertices = mesh.wedges = 7;
  mesh.triangles = mesh.strips = 6;
  ProgressiveStrips strips;
  strips.profile = Profile::compact;
  strips.meshes.push_back(std::move(mesh));
  strips.bases = {{.error = 0.5f, .one_sided_error = 0.125f}};
  strips.packets = {{.vsplits = 1, .error = 0.25f, .one_sided_error = 0.125f},
                    {.first_vsplit = 1, .vsplits = 1},
                    {.first_vsplit = 2, .vsplits = 1}};
  recount_levels(strips);
  set_digests(strips);
  return strips;
}

ProgressiveStrips welded() {
  ProgressiveMesh mesh;
  mesh.groups.resize(1);
  mesh.group_entries = {4};
  mesh.position = {"POSITION", ComponentType::f32, 3, false, {}};
  mesh.position.data = bytes_of({0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 1.f, 1.f, 0.f});
  mesh.base_vertices = mesh.base_wedges = mesh.vertices = mesh.wedges = 4;
  mesh.base_map = {0, 1, 2, 3};
  mesh.triangles = 2;
  mesh.strips = 1;
  // The first vertex stays; of the second there are two, of the third two wedges.
  mesh.welding = {.vertices = 5,
                  .wedges = 6,
                  .skip = {1, 0},
                  .more = {0, 0},
                  .corner = {0, 0, 0, 0},
                  .vertex = {0, 0, 0, 1},
                  .moved = {1},
                  .moved_position = mesh.position.format()};
  mesh.welding.moved_position.data = bytes_of({1.f, -0.f, 0.f});
  ProgressiveStrips strips;
  strips.meshes.push_back(std::move(mesh));
  strips.bases = {{}};
  recount_levels(strips);
  set_digests(strips);
  return strips;
}

ProgressiveStrips numbered_faces() {
  ProgressiveStrips strips = roof();
  ProgressiveMesh& mesh = strips.meshes[0];
  mesh.face_attribute_formats = {{"_FACE_ID", ComponentType::u8, 1, false, {}}};
  mesh.faces.attributes = mesh.face_attribute_formats;
  mesh.faces.attributes[0].data = bytes_of<std::uint8_t>({4, 3, 2, 1});
  return strips;
}

ProgressiveStrips empty() { return {}; }

ProgressiveStrips empty_mesh() {
  ProgressiveStrips strips;
  ProgressiveMesh& mesh = strips.meshes.emplace_back();
  mesh.position = {"POSITION", ComponentType::f32, 3, false, {}};
  mesh.groups.resize(1);
  mesh.group_entries = {0};
  strips.bases = {{}};
  return strips;
}

ProgressiveStrips bare_seam() {
  ProgressiveStrips strips = seam();
  ProgressiveMesh& mesh = strips.meshes[0];
  mesh.face_attribute_formats.clear();
  mesh.faces = {};
  mesh.order = {};
  mesh.digest.clear();
  return strips;
}

ProgressiveStrips scene() {
  ProgressiveStrips strips = roof();
  strips.meshes.push_back(strips.meshes[0]);
  strips.meshes[1].name = "annex";
  strips.bases.push_back(strips.bases[0]);
  strips.bases[1].mesh = 1;
  for (std::size_t k = 0; k < 2; ++k) {
    strips.packets.push_back(strips.packets[k]);
    strips.packets.back().mesh = 1;
  }
  strips.meshes[0].groups[0].material = 0;
  strips.scene.materials = {{.name = "brick", .maps = {{.image = 1}}}};
  strips.scene.images = {{"sky", "sky.png", "image/png", {}},
                         {"wall", "", "image/png", bytes_of<std::uint8_t>({1, 2, 3})},
                         {"door", "", "image/png", bytes_of<std::uint8_t>({4})}};
  strips.scene.nodes.resize(2);
  strips.scene.nodes[0].meshes = {0};
  strips.scene.nodes[1].parent = 0;
  strips.scene.nodes[1].meshes = {0, 1};
  strips.scene.foreign = {{"ply/comment", bytes_of<char>({'h', 'i'})}, {"obj/comment", {}}};
  strips.unknown = {{{'x', 'Y', 'Z', 'a'}, bytes_of<std::uint8_t>({0, 255})}};
  set_digests(strips);
  return strips;
}

ProgressiveStrips chained(Index entries, Index records) {
  ProgressiveMesh mesh;
  mesh.encoding = MapEncoding::offset;
  mesh.groups.resize(1);
  mesh.position = {"POSITION", ComponentType::u8, 1, false, Bytes(records + 1)};
  mesh.base_vertices = mesh.base_wedges = 1;
  mesh.base_map.assign(entries, kSameAsMinus1);
  mesh.base_map[0] = 0;
  mesh.group_entries = {entries};
  for (Index i = 0; i < records; ++i) mesh.vsplits.push_back({i, 1, 0, 1});
  mesh.wedge_offset_counts.assign(records, 1);
  mesh.map_offsets.assign(records, 0);
  mesh.vertices = mesh.wedges = records + 1;
  ProgressiveStrips strips;
  strips.meshes.push_back(std::move(mesh));
  strips.bases = {{}};
  strips.packets = {{.vsplits = records}};
  recount_levels(strips);
  return strips;
}

}  // namespace pstrips::test
