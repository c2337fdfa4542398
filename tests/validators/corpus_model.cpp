#include <limits>

#include "tests/validators/edits.h"
#include "tests/validators/samples.h"

namespace pstrips::test {
namespace {

constexpr Case kCases[] = {
    {"PS2001_count_past_the_largest.pstrip",
     [] { return edited_mesh(roof(), [](ProgressiveMesh& m) { m.strips = 0xffffff01; }); }},
    {"PS2002_wedges_of_single_wedges.pstrip",
     [] { return edited_mesh(roof(), [](ProgressiveMesh& m) { m.wedges = 8; }); }},
    {"PS2003_type_8.pstrip",
     [] { return recut(roof(), [](ChunkFile& f) { f.put("MESH", 24, std::uint8_t{8}); }); }},
    {"PS2003_type_f16.pstripx", [] { return reworded(roof(), "type=\"f32\"", "type=\"f16\""); }},
    {"PS2004_no_components.pstrip",
     [] { return recut(roof(), [](ChunkFile& f) { f.put("MESH", 25, std::uint8_t{0}); }); }},
    {"PS2004_no_components.pstripx", [] { return reworded(roof(), "count=\"3\"", "count=\"0\""); }},
    {"PS2005_semantic_twice.pstrip",
     [] {
       return edited_mesh(bare_seam(), [](ProgressiveMesh& m) {
         m.wedge_attributes.push_back(m.wedge_attributes[0]);
       });
     }},
    {"PS2006_too_many_attributes.pstrip",
     [] {
       return edited_mesh(empty_mesh(), [](ProgressiveMesh& m) {
         for (int i = 0; i < 1025; ++i)
           m.wedge_attributes.push_back({std::to_string(i), ComponentType::u8, 1, false, {}});
       });
     }},
    {"PS2007_no_group.pstrip",
     [] {
       return edited_mesh(empty_mesh(), [](ProgressiveMesh& m) {
         m.groups.clear();
         m.group_entries.clear();
       });
     }},
    {"PS2008_material.pstrip",
     [] { return edited_mesh(roof(), [](ProgressiveMesh& m) { m.groups[0].material = 3; }); }},
    {"PS2008_material.pstripx",
     [] { return reworded(roof(), "kind=\"polygons\"", "material=\"0\" kind=\"polygons\""); }},
    {"PS2009_entries_of_a_group.pstrip",
     [] { return edited_mesh(roof(), [](ProgressiveMesh& m) { m.group_entries[0] = 10; }); }},
    {"PS2010_strips_of_lines.pstrip",
     [] {
       return edited_mesh(roof(), [](ProgressiveMesh& m) { m.groups[0].kind = FaceKind::lines; });
     }},
    {"PS2011_base_larger_than_the_mesh.pstrip",
     [] { return edited_mesh(bare_seam(), [](ProgressiveMesh& m) { m.wedges = 3; }); }},
    {"PS2012_vsplits_too_few.pstrip",
     [] { return edited_mesh(bare_seam(), [](ProgressiveMesh& m) { m.vertices = 7; }); }},
    {"PS2013_more_strips_than_entries.pstrip",
     [] { return edited_mesh(roof(), [](ProgressiveMesh& m) { m.strips = 10; }); }},
    {"PS2014_wedge_of_no_vertex.pstrip",
     [] {
       return edited_mesh(bare_seam(), [](ProgressiveMesh& m) { m.base_wedge_vertex[1] = 3; });
     }},
    {"PS2014_wedge_of_no_vertex.pstripx",
     [] { return reworded(bare_seam(), "<wedge_vertex>0 0", "<wedge_vertex>0 9"); }},
    {"PS2015_wedges.pstrip",
     [] { return edited_mesh(bare_seam(), [](ProgressiveMesh& m) { m.wedges = 9; }); }},
    {"PS2016_triangles.pstrip",
     [] { return edited_mesh(roof(), [](ProgressiveMesh& m) { m.triangles = 5; }); }},
    {"PS2017_vertex_without_wedge.pstrip",
     [] {
       return edited_mesh(bare_seam(), [](ProgressiveMesh& m) { m.base_wedge_vertex[3] = 1; });
     }},
    {"PS2018_entries_of_triangles.pstrip",
     [] {
       ProgressiveStrips strips = growing();
       strips.meshes[0].group_entries[0] = 12;
       return recut(strips, [](ChunkFile& f) {
         f.put("MESH", f.payload("MESH").size() - 20, 18u);
         f.put("PSHD", 48, std::uint64_t{18});
       });
     }},
    {"PS2019_group_of_a_triangle.pstrip",
     [] { return edited_mesh(growing(), [](ProgressiveMesh& m) { m.triangle_group[4] = 2; }); }},
    {"PS2019_group_of_a_triangle.pstripx",
     [] { return reworded(growing(), "<triangle_group>0 1", "<triangle_group>0 2"); }},
    {"PS2020_gap_between_packets.pstrip",
     [] {
       // first_vsplit of the second packet
       return recut(roof(), [](ChunkFile& f) { f.put("PCKT", 4, 2u, 1); });
     }},
    {"PS2020_gap_between_packets.pstripx",
     [] { return reworded(roof(), "first_vsplit=\"1\"", "first_vsplit=\"2\""); }},
    {"PS2021_last_packet_missing.pstrip",
     [] { return edited(roof(), [](ProgressiveStrips& s) { s.packets.pop_back(); }); }},
    {"PS2022_packet_without_vsplits.pstrip",
     [] {
       return edited(roof(), [](ProgressiveStrips& s) {
         Packet packet = s.packets[0];
         packet.first_vsplit = 1;
         packet.vsplits = 0;
         s.packets.insert(s.packets.begin() + 1, packet);
       });
     }},
    {"PS2023_vertices_after_a_packet.pstripx",
     [] {
       return reworded(roof(), "vertices=\"5\" triangles=\"4\"", "vertices=\"6\" triangles=\"4\"");
     }},
    {"PS2024_triangles_after_the_base.pstrip",
     [] { return edited(roof(), [](ProgressiveStrips& s) { s.bases[0].triangles = 3; }); }},
    {"PS2024_triangles_after_a_packet.pstripx",
     [] {
       return reworded(roof(), "vertices=\"5\" triangles=\"4\"", "vertices=\"5\" triangles=\"3\"");
     }},
    {"PS2025_strips_after_a_packet.pstrip",
     [] { return edited(roof(), [](ProgressiveStrips& s) { s.packets[1].strips = 1; }); }},
    {"PS2026_error_not_a_number.pstrip",
     [] {
       return edited(roof(), [](ProgressiveStrips& s) {
         s.bases[0].error = std::numeric_limits<float>::quiet_NaN();
       });
     }},
    {"PS2026_error_negative.pstripx",
     [] {
       return reworded(roof(), " error=\"0\" one_sided_error=\"0\"",
                       " error=\"-1\" one_sided_error=\"-1\"");
     }},
    {"PS2026_one_sided_error_infinite.pstrip",
     [] {
       return edited(roof(), [](ProgressiveStrips& s) {
         s.bases[0].error = s.bases[0].one_sided_error = std::numeric_limits<float>::infinity();
       });
     }},
    {"PS2027_error_rises.pstrip",
     [] { return edited(roof(), [](ProgressiveStrips& s) { s.packets[0].error = 1; }); }},
    {"PS2027_one_sided_error_rises.pstripx",
     [] {
       return reworded(roof(), " error=\"0.25\" one_sided_error=\"0.125\"",
                       " error=\"0.25\" one_sided_error=\"0.25\"");
     }},
    {"PS2029_one_side_farther_than_both.pstrip",
     [] { return edited(roof(), [](ProgressiveStrips& s) { s.bases[0].one_sided_error = 1; }); }},
    {"PS2030_first_falls.pstrip",
     [] { return edited_mesh(seam(), [](ProgressiveMesh& m) {
            m.faces.first = {0, 7, 6};
          }); }},
    {"PS2031_corner_past_the_end.pstrip",
     [] { return edited_mesh(seam(), [](ProgressiveMesh& m) { m.faces.corners[5] = 8; }); }},
    {"PS2031_corner_past_the_end.pstripx",
     [] { return reworded(seam(), "corners=\"0 1\"", "corners=\"0 8\""); }},
    {"PS2032_group_of_a_face.pstrip",
     [] { return edited_mesh(seam(), [](ProgressiveMesh& m) { m.faces.group[1] = 3; }); }},
    {"PS2033_replaced_past_the_end.pstrip",
     [] { return edited_mesh(seam(), [](ProgressiveMesh& m) { m.faces.replaced[0] = 2; }); }},
    {"PS2034_replaced_twice.pstrip",
     [] {
       return edited_mesh(seam(), [](ProgressiveMesh& m) {
         m.faces.replaced = {1, 1};
         m.faces.replaced_first = {0, 2, 2};
         m.faces.attributes[0].data.pop_back();
         m.order = {};
       });
     }},
    {"PS2035_replaced_in_another_group.pstrip",
     [] {
       return edited(seam(), [](ProgressiveStrips& s) {
         s.meshes[0].faces.replaced[0] = 0;
         set_digests(s);
       });
     }},
    {"PS2036_faces.pstrip",
     [] {
       return recut(roof(), [](ChunkFile& f) {
         f.put("PSHD", 56, std::uint64_t{5});
         f.put("MESH", f.payload("MESH").size() - 12, 5u);
       });
     }},
    {"PS2037_face_attribute_too_short.pstrip",
     [] {
       return settled(numbered_faces(),
                      [](ChunkFile& f) { f.payload("fACE").resize(f.payload("fACE").size() - 8); });
     }},
    {"PS2038_replaced_first_falls.pstrip",
     [] {
       return edited_mesh(seam(), [](ProgressiveMesh& m) { m.faces.replaced_first = {0, 2, 1}; });
     }},
    {"PS2040_vertex_twice_in_the_order.pstrip",
     [] { return edited_mesh(seam(), [](ProgressiveMesh& m) { m.order.vertex[0] = 0; }); }},
    {"PS2040_order_too_short.pstripx", [] { return reworded(seam(), "<vertex>5 4", "<vertex>5"); }},
    {"PS2041_wedge_twice_in_the_order.pstrip",
     [] { return edited_mesh(seam(), [](ProgressiveMesh& m) { m.order.wedge[7] = 7; }); }},
    {"PS2042_face_past_the_end_of_the_order.pstrip",
     [] { return edited_mesh(seam(), [](ProgressiveMesh& m) { m.order.face[2] = 3; }); }},
    {"PS2043_rotation_past_the_corners.pstrip",
     [] { return edited_mesh(seam(), [](ProgressiveMesh& m) { m.order.rotation[0] = 3; }); }},
    {"PS2045_digest.pstrip",
     [] { return edited_mesh(seam(), [](ProgressiveMesh& m) { m.digest[0] ^= std::byte{1}; }); }},
    {"PS2045_another_colour.pstripx",
     [] { return reworded(seam(), "<values>1\n2", "<values>1\n3"); }},
    {"PS2046_wedge_past_the_end.pstrip",
     [] { return edited_mesh(welded(), [](ProgressiveMesh& m) { m.welding.skip[1] = 2; }); }},
    {"PS2046_corner_not_named_before.pstrip",
     [] { return edited_mesh(welded(), [](ProgressiveMesh& m) { m.welding.corner[0] = 1; }); }},
    {"PS2046_wedge_without_corner.pstrip",
     [] { return edited_mesh(welded(), [](ProgressiveMesh& m) { m.welding.corner[2] = 1; }); }},
    {"PS2046_vertices.pstripx",
     [] { return reworded(welded(), "vertices=\"5\"", "vertices=\"6\""); }},
    {"PS2046_moved_past_the_end.pstrip",
     [] { return edited_mesh(welded(), [](ProgressiveMesh& m) { m.welding.moved[0] = 5; }); }},
    {"PS2047_more_wedges_than_corners.pstrip",
     [] { return recut(welded(), [](ChunkFile& f) { f.put("wELD", 8, 11u); }); }},
    {"PS2047_more_wedges_than_corners.pstripx",
     [] { return reworded(welded(), "wedges=\"6\"", "wedges=\"11\""); }},
    {"PS2050_parent_after_its_child.pstrip",
     [] { return edited(scene(), [](ProgressiveStrips& s) { s.scene.nodes[0].parent = 1; }); }},
    {"PS2051_node_with_no_such_mesh.pstrip",
     [] { return edited(scene(), [](ProgressiveStrips& s) { s.scene.nodes[0].meshes[0] = 2; }); }},
    {"PS2052_no_such_image.pstrip",
     [] {
       return edited(scene(), [](ProgressiveStrips& s) { s.scene.materials[0].maps[0].image = 3; });
     }},
    {"PS2053_key_twice.pstrip",
     [] {
       return edited(scene(),
                     [](ProgressiveStrips& s) { s.scene.foreign[1].key = s.scene.foreign[0].key; });
     }},
    {"PS2054_role_twice.pstrip",
     [] {
       return edited(scene(), [](ProgressiveStrips& s) {
         s.scene.materials[0].maps.push_back(s.scene.materials[0].maps[0]);
       });
     }},
    {"PS2060_triangles_of_a_group.pstrip",
     [] { return edited_mesh(growing(), [](ProgressiveMesh& m) { m.triangle_group[0] = 1; }); }},
    {"PS2061_grid_without_a_step.pstripx",
     [] { return reworded(compact(), "grid_step=\"0.125\"", "grid_step=\"0\""); }},
    {"PS2061_cells_of_no_power_of_two.pstripx",
     [] {
       return reworded(compact(), "grid_step=\"0.125\" grid_origin=\"0 0 0\" grid_exact=\"true\"",
                       "grid_step=\"0.75\" grid_origin=\"0 0 0\" grid_exact=\"false\"");
     }},

    {"PS3001_entry_past_the_base.pstrip",
     [] { return edited_mesh(roof(), [](ProgressiveMesh& m) { m.base_map[8] = 4; }); }},
    {"PS3002_symbol_in_a_naive_map.pstrip",
     [] { return edited_mesh(roof(), [](ProgressiveMesh& m) { m.base_map[8] = kSameAsMinus1; }); }},
    {"PS3002_symbol_in_a_naive_map.pstripx", [] { return reworded(roof(), "3 0 0", "3 0 R-1"); }},
    {"PS3003_symbol_before_its_strip.pstrip",
     [] {
       return edited_mesh(symbols(), [](ProgressiveMesh& m) { m.base_map[6] = kSameAsMinus2; });
     }},
    {"PS3003_symbols_in_a_circle.pstrip",
     [] {
       return edited_mesh(symbols(), [](ProgressiveMesh& m) { m.base_map[7] = kSameAsPlus1; });
     }},
    {"PS3004_strip_across_groups.pstrip",
     [] {
       return edited_mesh(bare_seam(), [](ProgressiveMesh& m) { m.group_entries = {3, 4, 0}; });
     }},

    {"PS3005_restart_among_triangles.pstrip",
     [] { return edited_mesh(growing(), [](ProgressiveMesh& m) { m.base_map[3] = kRestart; }); }},
    {"PS3005_part_of_a_triangle.pstripx",
     [] { return reworded(growing(), "3 4 1</map>", "3 4 1 0</map>"); }},
    {"PS3006_two_corners_of_a_vertex.pstrip",
     [] { return edited_mesh(growing(), [](ProgressiveMesh& m) { m.base_map[4] = 3; }); }},
    {"PS3006_new_triangle_degenerate.pstrip",
     [] { return edited_mesh(growing(), [](ProgressiveMesh& m) { m.new_corners[1] = 0; }); }},

    {"PS4001_parent_not_there_yet.pstrip",
     [] { return edited_mesh(roof(), [](ProgressiveMesh& m) { m.vsplits[0].parent = 5; }); }},
    {"PS4001_parent_not_there_yet.pstripx",
     [] { return reworded(roof(), "<vsplit parent=\"0\"", "<vsplit parent=\"6\""); }},
    {"PS4002_isolated_vertex_reassigns.pstrip",
     [] {
       return edited_mesh(bare_seam(), [](ProgressiveMesh& m) {
         m.vsplits[2].reassigned = 1;
         m.reassigned.push_back(2);
       });
     }},
    {"PS4003_isolated_vertex_writes.pstrip",
     [] {
       return edited_mesh(bare_seam(), [](ProgressiveMesh& m) {
         m.vsplits[2].map_offsets = 1;
         m.wedge_offset_counts[3] = 1;
         m.map_offsets.push_back(0);
       });
     }},
    {"PS4003_isolated_vertex_brings_a_triangle.pstrip",
     [] {
       return edited_mesh(growing(), [](ProgressiveMesh& m) {
         m.vsplits[1].triangles = 1;
         m.vsplits[2].triangles = 0;
       });
     }},
    {"PS4005_vertex_without_wedges.pstrip",
     [] {
       return edited(bare_seam(), [](ProgressiveStrips& s) {
         ProgressiveMesh& m = s.meshes[0];
         m.vsplits[2].wedges = 0;
         m.wedge_offset_counts.pop_back();
         m.wedge_attributes[0].data.pop_back();
         --m.wedges;
       });
     }},
    {"PS4006_parent_loses_its_wedges.pstrip",
     [] {
       return edited_mesh(bare_seam(), [](ProgressiveMesh& m) {
         m.vsplits[0].reassigned = 2;
         m.reassigned = {0, 1};
       });
     }},
    {"PS4007_reassigned_wedge_not_there_yet.pstrip",
     [] { return edited_mesh(bare_seam(), [](ProgressiveMesh& m) { m.reassigned[0] = 4; }); }},
    {"PS4008_reassigned_from_another_vertex.pstrip",
     [] { return edited_mesh(bare_seam(), [](ProgressiveMesh& m) { m.reassigned[0] = 3; }); }},
    {"PS4008_reassigned_from_another_vertex.pstripx",
     [] { return reworded(bare_seam(), "reassigned=\"1\"", "reassigned=\"3\""); }},
    {"PS4010_offset_past_the_map.pstrip",
     [] { return edited_mesh(roof(), [](ProgressiveMesh& m) { m.map_offsets[2] = 9; }); }},
    {"PS4010_offset_of_a_later_triangle.pstrip",
     [] { return edited_mesh(growing(), [](ProgressiveMesh& m) { m.map_offsets[0] = 6; }); }},
    {"PS4011_offset_of_a_restart.pstrip",
     [] { return edited_mesh(roof(), [](ProgressiveMesh& m) { m.map_offsets[2] = 5; }); }},
    {"PS4012_offsets_descend.pstrip",
     [] {
       return edited_mesh(
           roof(), [](ProgressiveMesh& m) { std::swap(m.map_offsets[0], m.map_offsets[1]); });
     }},
    {"PS4013_offset_of_two_wedges.pstrip",
     [] { return edited_mesh(bare_seam(), [](ProgressiveMesh& m) { m.map_offsets[2] = 1; }); }},
    {"PS4014_offset_of_another_vertex.pstrip",
     [] { return edited_mesh(roof(), [](ProgressiveMesh& m) { m.map_offsets[2] = 0; }); }},
    {"PS4015_isolated_vertex_moves.pstrip",
     [] {
       return edited_mesh(bare_seam(),
                          [](ProgressiveMesh& m) { m.parent_position.back() ^= std::byte{1}; });
     }},
    {"PS4016_corner_not_there_yet.pstrip",
     [] { return edited_mesh(growing(), [](ProgressiveMesh& m) { m.new_corners[2] = 6; }); }},
    {"PS4016_corner_not_there_yet.pstripx",
     [] { return reworded(growing(), "new_triangles=\"2 5 7\"", "new_triangles=\"2 5 8\""); }},
};

}  // namespace

const std::span<const Case> kModelCases = kCases;

}  // namespace pstrips::test
