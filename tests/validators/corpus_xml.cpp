#include "tests/validators/edits.h"
#include "tests/validators/samples.h"

namespace pstrips::test {
namespace {

constexpr Case kCases[] = {
    {"PS5001_tags_cross.pstripx", [] { return reworded(roof(), "</base>", "</bases>"); }},
    {"PS5001_control_character.pstripx", [] { return reworded(roof(), "corpus", "cor\x01pus"); }},
    {"PS5002_document_type.pstripx",
     [] { return reworded(roof(), "<pstrips", "<!DOCTYPE pstrips>\n<pstrips"); }},
    {"PS5002_processing_instruction.pstripx",
     [] { return reworded(roof(), "<base", "<?php?><base"); }},
    {"PS5003_another_root.pstripx",
     [] {
       Bytes bytes = reworded(roof(), "<pstrips", "<pstraps");
       const std::string_view text = as_text(bytes);
       bytes[text.rfind("pstrips") + 4] = std::byte{'a'};
       return bytes;
     }},
    {"PS5003_attribute_missing.pstripx", [] { return reworded(roof(), " strips=\"2\"", ""); }},
    {"PS5003_attribute_unknown.pstripx",
     [] { return reworded(roof(), "<base ", "<base colour=\"red\" "); }},
    {"PS5003_group_after_base.pstripx",
     [] { return reworded(roof(), "<packet", "<group/><packet"); }},
    {"PS5004_later_minor_version.pstripx",
     [] {
       return reworded(roof(), "version=\"2.2\" profile=\"plain\"",
                       "version=\"2.7\" profile=\"plain\" colour=\"red\"");
     }},
    {"PS5010_base_of_another_mesh.pstripx",
     [] { return reworded(roof(), "<base mesh=\"0\"", "<base mesh=\"1\""); }},
    {"PS5011_vsplits_of_a_packet.pstripx",
     [] { return reworded(roof(), "vsplits=\"2\"", "vsplits=\"3\""); }},
    {"PS5012_positions_too_few.pstripx",
     [] { return reworded(roof(), "<positions>0 0 0", "<positions>0 0"); }},
    {"PS5012_wedge_vertices_too_many.pstripx",
     [] { return reworded(bare_seam(), "<wedge_vertex>0", "<wedge_vertex>0 0"); }},
    {"PS5013_single_wedges_reassigned.pstripx",
     [] {
       return reworded(roof(), "<vsplit parent=\"0\"", "<vsplit reassigned=\"1\" parent=\"0\"");
     }},
    {"PS5013_parent_position_missing.pstripx",
     [] { return reworded(bare_seam(), " parent_position=\"-0.5 0\"", ""); }},
    {"PS5012_part_of_a_new_triangle.pstripx",
     [] { return reworded(growing(), "new_triangles=\"2 5 7\"", "new_triangles=\"2 5\""); }},
    {"PS5012_group_of_a_new_triangle_missing.pstripx",
     [] {
       return reworded(growing(), "new_triangles=\"2 5 7\" triangle_group=\"0\"",
                       "new_triangles=\"2 5 7\"");
     }},
    {"PS5013_triangles_of_a_map_of_strips.pstripx",
     [] {
       return reworded(roof(), "<vsplit parent=\"0\"",
                       "<vsplit new_triangles=\"0 1 2\" parent=\"0\"");
     }},
    {"PS5013_values_missing.pstripx", [] { return reworded(bare_seam(), " values=\"5\"", ""); }},
    {"PS5016_digest_twice.pstripx",
     [] {
       const Bytes bytes = write_xml(seam());
       const std::string_view text = as_text(bytes);
       const std::size_t begin = text.find("<digest");
       const std::string_view element = text.substr(begin, text.find("</digest>") + 9 - begin);
       return reworded(seam(), element, std::string(element) + std::string(element));
     }},
    {"PS5016_order_empty.pstripx",
     [] {
       return reworded(empty_mesh(), "</pstrips>",
                       "<order mesh=\"0\"><vertex/><face/><rotation/></order></pstrips>");
     }},
    {"PS5018_type_of_a_chunk.pstripx",
     [] { return reworded(scene(), "type=\"xYZa\"", "type=\"xY1a\""); }},
    {"PS5018_known_chunk.pstripx",
     [] { return reworded(scene(), "type=\"xYZa\"", "type=\"dGST\""); }},
    {"PS5020_index_negative.pstripx",
     [] { return reworded(roof(), "parent=\"0\"", "parent=\"-1\""); }},
    {"PS5020_component_out_of_range.pstripx",
     [] { return reworded(bare_seam(), "<values>1", "<values>256"); }},
    {"PS5020_nan_with_capitals.pstripx",
     [] { return reworded(roof(), "<positions>0", "<positions>nan:0xFFC00001"); }},
    {"PS5020_map_entry.pstripx", [] { return reworded(roof(), "3 0 0", "3 0 R-3"); }},
    {"PS5030_backslash.pstripx", [] { return reworded(roof(), "\"corpus\"", "\"cor\\pus\""); }},
    {"PS5031_base64_cut.pstripx",
     [] { return reworded(scene(), "type=\"xYZa\">", "type=\"xYZa\">A"); }},
};

}  // namespace

const std::span<const Case> kXmlCases = kCases;

}  // namespace pstrips::test
