#include "validators/rules.h"

#include <algorithm>

#include "validators/checks.h"

namespace pstrips::inline validators {
namespace {

using namespace checks;

constexpr Severity kError = Severity::error;
constexpr Severity kWarning = Severity::warning;

// The last three digits of a code are those of its clause; the first says on which page that is:
// 0 answers other than "corrupt", 1 container.md, 2 model.md, 3 strips.md, 4 vsplit.md, 5 xml.md,
// 6 compact.md.
constexpr Rule kRules[] = {
    {"PS0001", kError, "D-010", Stage::file, "The file goes on to its end.",
     noticed<Fault::truncated>, Verdict::truncated},
    {"PS0002", kError, "D-032", Stage::file,
     "The file asks for no more than the limits of the validation grant.",
     noticed<Fault::over_limit>, Verdict::over_limit},
    {"PS0003", kError, "D-043", Stage::replay,
     "Replaying the records takes work in proportion to their size.", noticed<Fault::too_much_work>,
     Verdict::over_limit},
    {"PS1001", kError, "C-001", Stage::file,
     "The file starts with the signature 8A 50 53 54 0D 0A 1A 0A.", noticed<Fault::signature>},
    {"PS1002", kError, "C-002", Stage::file, "A chunk type is four ASCII letters.",
     noticed<Fault::type_not_letters>},
    {"PS1003", kError, "C-003", Stage::file, "The third letter of a chunk type is upper case.",
     noticed<Fault::type_third_letter>},
    {"PS1004", kError, "C-004", Stage::file, "A payload is at most 2147483647 bytes long.",
     noticed<Fault::chunk_length>},
    {"PS1005", kError, "C-005", Stage::file, "The padding of a chunk is zero.",
     noticed<Fault::chunk_padding>},
    {"PS1006", kError, "C-006", Stage::file, "The CRC of a chunk is that of its bytes.",
     noticed<Fault::chunk_crc>},
    {"PS1007", kError, "C-007", Stage::file, "No critical chunk is unknown.",
     noticed<Fault::critical_chunk_unknown>, Verdict::unsupported, "X-018"},
    {"PS1008", kWarning, "C-008", Stage::file, "A string is UTF-8.",
     noticed<Fault::string_not_utf8>},
    {"PS1010", kError, "C-010", Stage::file, "The first chunk is PSHD.",
     noticed<Fault::first_chunk>},
    {"PS1011", kError, "C-011", Stage::file, "Known chunks stand in the order of the table.",
     noticed<Fault::chunk_order>},
    {"PS1012", kError, "C-012", Stage::file, "PSHD, sCNE, mTRL, PIDX and PEND stand once at most.",
     noticed<Fault::chunk_twice>},
    {"PS1013", kError, "C-013", Stage::file,
     "There are as many MESH chunks as PSHD declares meshes.", noticed<Fault::mesh_chunks>},
    {"PS1014", kError, "C-014", Stage::file, "There is one BASE chunk for each mesh.",
     noticed<Fault::base_chunks>},
    {"PS1015", kError, "C-015", Stage::file,
     "There are as many PCKT chunks as PSHD declares packets.", noticed<Fault::packet_chunks>},
    {"PS1016", kError, "C-016", Stage::file,
     "FINE, fACE, wELD, oRDP and dGST stand mesh by mesh in that order, iMGE by image, each once.",
     noticed<Fault::tail_order>},
    {"PS1017", kError, "C-017", Stage::file, "PEND is the end of the file.",
     noticed<Fault::bytes_after_end>},
    {"PS1018", kError, "C-018", Stage::file, "The payload of PEND is empty.",
     noticed<Fault::end_payload>},
    {"PS1020", kError, "C-020", Stage::file,
     "A payload has exactly the fields of its table, and its counts agree with its length.",
     noticed<Fault::payload_length>},
    {"PS1021", kError, "C-021", Stage::file, "Reserved bytes are zero.",
     noticed<Fault::reserved_not_zero>},
    {"PS1022", kError, "C-022", Stage::file,
     "The bytes between an aligned array and what follows it are zero.",
     noticed<Fault::array_padding>},
    {"PS1023", kError, "C-023", Stage::file, "A field with a list of values has one of them.",
     noticed<Fault::value_undefined>},
    {"PS1030", kError, "C-030", Stage::file,
     "The major version is the one that the specification defines.",
     noticed<Fault::version_unknown>, Verdict::unsupported, "X-004"},
    {"PS1031", kError, "C-031", Stage::file, "profile is 0 or 1.", noticed<Fault::profile_unknown>,
     Verdict::unsupported, "X-005"},
    {"PS1032", kError, "C-032", Stage::file, "flags is 0.", noticed<Fault::flags_unknown>,
     Verdict::unsupported},
    {"PS1033", kError, "C-033", Stage::model,
     "conformance is the smallest conformance level that admits the file.", conformance_computed},
    {"PS1034", kError, "C-034", Stage::model, "Each total of PSHD is the sum over the meshes.",
     totals_summed},
    {"PS1035", kError, "C-035", Stage::model, "decoder_memory is the value of its formula.",
     decoder_memory_computed},
    {"PS1036", kError, "C-036", Stage::model,
     "base_end is where the last BASE ends, without meshes PIDX.", base_end},
    {"PS1037", kError, "C-037", Stage::file, "file_bytes is the size of the file.", file_bytes},
    {"PS1040", kError, "C-040", Stage::file,
     "PIDX has one row for each mesh and one for each packet.", rows_counted},
    {"PS1041", kError, "C-041", Stage::model, "offset and bytes of a row are those of its chunk.",
     rows_point_to_chunks},
    {"PS1042", kError, "C-042", Stage::model, "mesh and vsplits of a row are those of its chunk.",
     rows_describe_chunks},
    {"PS1050", kError, "C-050", Stage::file, "BASE chunks name the meshes one after the other.",
     noticed<Fault::base_mesh>},
    {"PS1051", kError, "C-051", Stage::file,
     "vertices, wedges and map_entries of BASE agree with MESH; a map of triangles is at most as "
     "long.",
     noticed<Fault::base_counts>},
    {"PS1052", kError, "C-052", Stage::model,
     "In the compact profile index maps are maps of triangles.", profile_encodings},
    {"PS1055", kError, "C-055", Stage::file, "The mesh of a PCKT is below the number of meshes.",
     noticed<Fault::packet_mesh>},
    {"PS1056", kError, "C-056", Stage::file,
     "The wedges and reassigned wedges of the records add up to the counts of their PCKT.",
     noticed<Fault::packet_wedges>},
    {"PS1057", kError, "C-057", Stage::file,
     "wedge_offset_counts adds up to the map offsets of its PCKT.", noticed<Fault::packet_offsets>},
    {"PS1058", kError, "C-058", Stage::file,
     "With single wedges a PCKT has one new wedge a vsplit and reassigns none.",
     noticed<Fault::packet_single_wedges>, Verdict::invalid, "V-004"},
    {"PS1059", kError, "C-059", Stage::file,
     "The triangles of the records add up to the triangles of their PCKT.",
     noticed<Fault::packet_triangles>},
    {"PS1060", kError, "C-060", Stage::file, "The mesh of a fACE is below the number of meshes.",
     noticed<Fault::faces_mesh>},
    {"PS1061", kError, "C-061", Stage::model,
     "A mesh has a fACE chunk when it needs one, and only then.", faces_needed},
    {"PS1062", kError, "C-062", Stage::file, "The mesh of an oRDP is below the number of meshes.",
     noticed<Fault::order_mesh>},
    {"PS1063", kError, "C-063", Stage::file, "The mesh of a dGST is below the number of meshes.",
     noticed<Fault::digest_mesh>},
    {"PS1064", kError, "C-064", Stage::file, "The algorithm of a dGST is 1.",
     noticed<Fault::digest_unknown>, Verdict::unsupported, "X-017"},
    {"PS1065", kError, "C-065", Stage::file,
     "rotation_bits of an oRDP is the bit length of the largest rotation.",
     noticed<Fault::order_rotation_bits>},
    {"PS1066", kError, "C-066", Stage::file,
     "The bits between a packed array and what follows it are zero.",
     noticed<Fault::packed_padding>},
    {"PS1067", kError, "C-067", Stage::file, "The mesh of a FINE is below the number of meshes.",
     noticed<Fault::fine_mesh>},
    {"PS1068", kError, "C-068", Stage::file,
     "A mesh has a FINE chunk when its cells leave bits, and only then.",
     noticed<Fault::fine_needed>},
    {"PS1069", kError, "C-069", Stage::file,
     "A FINE chunk holds the bits below the cells of its mesh, and zeros behind them.",
     noticed<Fault::fine_length>},
    {"PS1070", kError, "C-070", Stage::file,
     "An iMGE brings data of an image that mTRL says is embedded.", noticed<Fault::image_data>},
    {"PS1071", kError, "C-071", Stage::model, "Each embedded image has an iMGE chunk.",
     images_there},
    {"PS1072", kError, "C-072", Stage::file, "The mesh of a wELD is below the number of meshes.",
     noticed<Fault::welding_mesh>},
    {"PS1073", kError, "C-073", Stage::file,
     "Each width of a wELD is the bit length of the largest number of its list.",
     noticed<Fault::welding_bits>},
    {"PS2001", kError, "M-001", Stage::base, "The counts of a mesh are at most 0xFFFFFF00.",
     counts_representable},
    {"PS2002", kError, "M-002", Stage::base,
     "With single wedges there are as many wedges as vertices, in the base and in all.",
     single_wedges_hold},
    {"PS2003", kError, "M-003", Stage::file, "The type of an attribute is one of the eight.",
     noticed<Fault::type_undefined>},
    {"PS2004", kError, "M-004", Stage::file, "An attribute has at least one component.",
     noticed<Fault::no_components>},
    {"PS2005", kError, "M-005", Stage::model,
     "The semantics of a mesh's wedge attributes differ, and those of its face attributes.",
     semantics_differ},
    {"PS2006", kError, "M-006", Stage::model,
     "A mesh has at most 1024 wedge attributes and 1024 face attributes.", few_attributes},
    {"PS2007", kError, "M-007", Stage::base, "A mesh has at least one group.", has_group},
    {"PS2008", kError, "M-008", Stage::model,
     "The material of a group is none or below the number of materials.", group_materials_exist},
    {"PS2009", kError, "M-009", Stage::base,
     "The map_entries of the groups add up to the length of the index map.", group_entries_summed},
    {"PS2010", kError, "M-010", Stage::model, "Groups of lines and of points have no map entries.",
     only_polygons_have_strips},
    {"PS2011", kError, "M-011", Stage::model,
     "base_vertices is at most vertices, base_wedges at most wedges.", counts_of_base},
    {"PS2012", kError, "M-012", Stage::model,
     "Each vsplit brings one of the vertices that the base lacks.", vsplits_fill},
    {"PS2013", kError, "M-013", Stage::base, "triangles and strips are at most map_entries.",
     strips_fit_map},
    {"PS2014", kError, "M-014", Stage::base,
     "Each wedge of the base belongs to a vertex of the base.", wedge_vertices_exist},
    {"PS2015", kError, "M-015", Stage::model,
     "wedges is base_wedges plus the new wedges of all vsplits.", mesh_wedges_come},
    {"PS2016", kError, "M-016", Stage::replay,
     "triangles and strips are those that the index map shows after the last vsplit.",
     full_counts_reached},
    {"PS2017", kError, "M-017", Stage::base, "Each vertex of the base has a wedge.",
     vertices_have_wedges},
    {"PS2018", kError, "M-018", Stage::base,
     "map_entries of a map of triangles is three times triangles.", triangle_entries_hold},
    {"PS2019", kError, "M-019", Stage::base,
     "The group of each triangle of a map of triangles is below the number of groups.",
     triangle_groups_exist},
    {"PS2020", kError, "M-020", Stage::file,
     "A packet starts with the vsplit after the last one of the packet before it.",
     noticed<Fault::packet_not_next>},
    {"PS2021", kError, "M-021", Stage::model, "The packets of a mesh hold all its vsplits.",
     packets_hold_vsplits},
    {"PS2022", kError, "M-022", Stage::model, "A packet holds at least one vsplit.",
     packets_not_empty},
    {"PS2023", kError, "M-023", Stage::replay,
     "vertices of a packet is the number of vertices after it.", row_vertices},
    {"PS2024", kError, "M-024", Stage::replay,
     "triangles of a packet is the number of triangles that the map shows after it.",
     row_triangles},
    {"PS2025", kError, "M-025", Stage::replay,
     "strips of a packet is the number of strips that show a triangle after it.", row_strips},
    {"PS2026", kError, "M-026", Stage::model,
     "error and one_sided_error are finite numbers and not negative.", errors_finite},
    {"PS2027", kError, "M-027", Stage::model,
     "error and one_sided_error do not rise from one packet of a mesh to the next.", errors_fall},
    {"PS2029", kError, "M-029", Stage::model, "one_sided_error is at most error.",
     one_side_within_both},
    {"PS2030", kError, "M-030", Stage::model,
     "first of the face table starts with 0, never falls and ends with the number of corners.",
     face_bounds},
    {"PS2031", kError, "M-031", Stage::model,
     "Each corner of the face table is below the number of wedges.", face_corners_exist},
    {"PS2032", kError, "M-032", Stage::model,
     "The group of an explicit face is below the number of groups.", face_groups_exist},
    {"PS2033", kError, "M-033", Stage::model,
     "Each replaced triangle is below the number of triangles.", replaced_exist},
    {"PS2034", kError, "M-034", Stage::model, "No triangle is replaced twice.", replaced_once},
    {"PS2035", kError, "M-035", Stage::replay,
     "A replaced triangle stands in the group of the face that replaces it.", replaced_in_group},
    {"PS2036", kError, "M-036", Stage::model,
     "The number of faces is triangles - replaced + explicit faces.", faces_counted},
    {"PS2037", kError, "M-037", Stage::file,
     "Face attributes have one element for each face of the decoded mesh.",
     noticed<Fault::face_elements>},
    {"PS2038", kError, "M-038", Stage::model,
     "replaced_first starts with 0, never falls and ends with the number of replaced triangles.",
     replaced_bounds},
    {"PS2040", kError, "M-040", Stage::model,
     "vertex of the original order is a permutation of the vertices.", order_vertices},
    {"PS2041", kError, "M-041", Stage::model,
     "wedge of the original order is a permutation of the wedges, absent with single wedges.",
     order_wedges},
    {"PS2042", kError, "M-042", Stage::model,
     "face of the original order is a permutation of the faces.", order_faces},
    {"PS2043", kError, "M-043", Stage::model,
     "rotation is below the number of corners of its face, and 0 for a face without.", rotations},
    {"PS2045", kError, "M-045", Stage::replay, "The digest is that of the decoded mesh.",
     digest_matches},
    {"PS2046", kError, "M-046", Stage::replay, "The lists of the welding lead to a mesh.",
     welding_fits},
    {"PS2047", kError, "M-047", Stage::file,
     "A welding has no more of anything than the mesh has room for.", welding_counts},
    {"PS2050", kError, "M-050", Stage::model, "The parent of a node is none or a node before it.",
     node_parents},
    {"PS2051", kError, "M-051", Stage::model,
     "The meshes of a node are below the number of meshes.", node_meshes},
    {"PS2052", kError, "M-052", Stage::model,
     "The image of a map of a material is below the number of images.", material_images},
    {"PS2053", kError, "M-053", Stage::model, "The keys of foreign entries differ.",
     foreign_keys_differ},
    {"PS2054", kError, "M-054", Stage::model, "The maps of a material ascend by role.",
     material_maps},
    {"PS2060", kError, "M-060", Stage::model,
     "A group of a map of triangles has a third of its map_entries triangles.",
     triangles_of_groups_counted},
    {"PS2061", kError, "M-061", Stage::model,
     "In the compact profile positions are three numbers of a type that their grid can have.",
     position_grids},
    {"PS3001", kError, "S-001", Stage::base,
     "An entry of the base's map is a wedge of the base, a symbol or a restart.", map_wedges_exist},
    {"PS3002", kError, "S-002", Stage::base, "Only a map of the offset encoding holds symbols.",
     symbols_allowed},
    {"PS3003", kError, "S-003", Stage::base,
     "The chain from each symbol ends at a wedge without leaving its strip.", symbols_resolve},
    {"PS3004", kError, "S-004", Stage::model, "No strip goes from one group into the next.",
     groups_end_strips},
    {"PS3005", kError, "S-005", Stage::base,
     "A map of triangles holds three entries a triangle and no restart.", triangles_whole},
    {"PS3006", kError, "S-006", Stage::replay,
     "The corners of a triangle of a map of triangles are wedges of three vertices.",
     noticed<Fault::degenerate_triangle>},
    {"PS4001", kError, "V-001", Stage::replay,
     "parent is a vertex that is there, or the new vertex itself.",
     noticed<Fault::parent_not_there>},
    {"PS4002", kError, "V-002", Stage::replay,
     "A vertex that appears on its own reassigns no wedges.",
     noticed<Fault::isolated_vertex_reassigns>},
    {"PS4003", kError, "V-003", Stage::replay,
     "A vertex that appears on its own has no map offsets and no new triangles.",
     noticed<Fault::isolated_vertex_writes>},
    {"PS4005", kError, "V-005", Stage::replay, "A record has at least one new or reassigned wedge.",
     noticed<Fault::new_vertex_without_wedge>},
    {"PS4006", kError, "V-006", Stage::replay, "At least one wedge of the parent remains with it.",
     noticed<Fault::parent_without_wedge>},
    {"PS4007", kError, "V-007", Stage::replay, "Each reassigned wedge is there.",
     noticed<Fault::reassigned_not_there>},
    {"PS4008", kError, "V-008", Stage::replay,
     "Each reassigned wedge belongs to the parent and is named once.",
     noticed<Fault::reassigned_not_of_parent>},
    {"PS4010", kError, "V-010", Stage::replay,
     "Each map offset is below the length of the map before the record.",
     noticed<Fault::offset_past_end>},
    {"PS4011", kError, "V-011", Stage::replay, "No map offset is that of a restart.",
     noticed<Fault::offset_is_restart>},
    {"PS4012", kError, "V-012", Stage::replay, "The map offsets of a wedge ascend.",
     noticed<Fault::offsets_not_ascending>},
    {"PS4013", kError, "V-013", Stage::replay, "No map offset stands twice in a record.",
     noticed<Fault::offset_twice>},
    {"PS4014", kError, "V-014", Stage::replay,
     "The wedge at each map offset belongs to the parent before the record.",
     noticed<Fault::offset_not_of_parent>},
    {"PS4015", kError, "V-015", Stage::replay,
     "A vertex that appears on its own stands where its record puts it.",
     noticed<Fault::isolated_vertex_moves>},
    {"PS4016", kError, "V-016", Stage::replay,
     "Each corner of a new triangle is a wedge that is there after the record.",
     noticed<Fault::corner_not_there>},
    {"PS5001", kError, "X-001", Stage::file, "An XML file is well-formed XML 1.0 in UTF-8.",
     noticed<Fault::xml_malformed>},
    {"PS5002", kError, "X-002", Stage::file,
     "An XML file has no document type declaration and no processing instruction.",
     noticed<Fault::xml_declaration>},
    {"PS5003", kError, "X-003", Stage::file,
     "An XML file has the elements and attributes of the format, in its order and of its types.",
     noticed<Fault::xml_schema>},
    {"PS5004", kError, "X-004", Stage::file,
     "An XML file has nothing that only a later minor version could define.",
     noticed<Fault::xml_unsupported>, Verdict::unsupported},
    {"PS5010", kError, "X-010", Stage::file, "There is one base for each mesh, in mesh order.",
     noticed<Fault::xml_bases>},
    {"PS5011", kError, "X-011", Stage::file,
     "A packet holds as many vsplit elements as its attribute says.",
     noticed<Fault::xml_packet_vsplits>},
    {"PS5012", kError, "X-012", Stage::file, "A list is as long as the model fixes.",
     noticed<Fault::xml_list_length>},
    {"PS5013", kError, "X-013", Stage::file,
     "A vsplit has the attributes and elements that single_wedges, wedge attributes, placement and "
     "encoding of its mesh call for.",
     noticed<Fault::xml_vsplit_form>, Verdict::invalid, "X-014 X-015 X-019"},
    {"PS5016", kError, "X-016", Stage::file,
     "faces, welding, order and digest stand once for a mesh, image_data once for an image, none "
     "empty.",
     noticed<Fault::xml_twice>},
    {"PS5018", kError, "X-018", Stage::file,
     "The type of a chunk element is an ancillary one that the binary variant does not define.",
     noticed<Fault::xml_chunk_type>},
    {"PS5020", kError, "X-020", Stage::file,
     "A number or map entry is written as one and in range of its type.",
     noticed<Fault::xml_number>, Verdict::invalid, "X-021"},
    {"PS5030", kError, "X-030", Stage::file, "A backslash in a string stands for something.",
     noticed<Fault::xml_backslash>},
    {"PS5031", kError, "X-031", Stage::file, "Base64 is whole.", noticed<Fault::xml_base64>},
    {"PS6001", kError, "K-001", Stage::file,
     "A mesh of the compact profile has at most 1024 components of wedge attributes, and is what "
     "C-052 and M-061 demand.",
     noticed<Fault::compact_mesh>},
    {"PS6002", kError, "K-002", Stage::file, "The cells of an attribute fit its type.",
     noticed<Fault::compact_cells>},
    {"PS6003", kError, "K-003", Stage::file,
     "The numbers of a head are in their shortest form and not too large.",
     noticed<Fault::compact_number>},
    {"PS6004", kError, "K-004", Stage::file, "A run of codes ends with its last one.",
     noticed<Fault::compact_run>},
    {"PS6005", kError, "K-005", Stage::file,
     "A base names what is there, three vertices a triangle and one a wedge.",
     noticed<Fault::compact_base>},
    {"PS6006", kError, "K-006", Stage::file,
     "A packet brings what it says, and no mesh more than MESH says.",
     noticed<Fault::compact_counts>},
    {"PS6007", kError, "K-007", Stage::file, "The vertices of a split lie in cells.",
     noticed<Fault::compact_step>},
    {"PS6008", kError, "K-008", Stage::file, "A wedge is one of its vertex.",
     noticed<Fault::compact_wedge>},
    {"PS6009", kError, "K-009", Stage::file,
     "The third vertex of a new face is there, and none of the other two.",
     noticed<Fault::compact_face>},
};

static_assert(std::ranges::adjacent_find(kRules, std::ranges::greater_equal{}, &Rule::code) ==
              std::end(kRules));

/// The page of a clause, by its first letter.
std::string_view page_of(std::string_view clause) {
  switch (clause.front()) {
    case 'M':
      return "model.md";
    case 'S':
      return "strips.md";
    case 'K':
      return "compact.md";
    case 'V':
      return "vsplit.md";
    case 'X':
      return "xml.md";
    default:
      return "container.md";
  }
}

/// What to make of a file that breaks the rule, in a sentence.
std::string_view consequence_of(const Rule& rule) {
  if (rule.severity == Severity::warning) return "Every decoder still takes the file.";
  switch (rule.verdict) {
    case Verdict::truncated:
      return "The file is truncated, not corrupt: more bytes may mend it, and its whole packets "
             "can "
             "be shown.";
    case Verdict::over_limit:
      return "The file may be valid; larger limits may admit it.";
    case Verdict::unsupported:
      return "The file may be one of a later version; a decoder refuses it.";
    default:
      return "The file is corrupt: what a decoder makes of it is not defined.";
  }
}

}  // namespace

std::span<const Rule> rules() { return kRules; }

const Rule* find_rule(std::string_view code) {
  const auto* const found = std::ranges::lower_bound(kRules, code, {}, &Rule::code);
  return found != std::end(kRules) && found->code == code ? found : nullptr;
}

std::string page_of(const Rule& rule) { return "spec/" + std::string(page_of(rule.clause)); }

std::string explain(std::string_view code) {
  const Rule* const rule = find_rule(code);
  if (rule == nullptr) return {};
  std::string out(rule->code);
  out.append(" (").append(name_of(rule->severity)).append("): ").append(rule->holds).append("\n");
  out.append(consequence_of(*rule)).append("\n");
  out.append("Clause ").append(rule->clause).append(" in ").append(page_of(*rule)).append("\n");
  return out;
}

std::string rules_page(const std::function<std::string(const Rule&)>& example_of) {
  std::string out =
      "# Rules of the validator\n\n"
      "Made from the table in `validators/rules.cpp` by `validators.make_corpus`; a test\n"
      "compares the two. Each file named breaks its rule and no other. Codes are stable: a code "
      "is\n"
      "never given to another rule.\n\n"
      "| code | severity | clause | a valid file satisfies | broken by |\n"
      "|---|---|---|---|---|\n";
  for (const Rule& rule : kRules) {
    out.append("| ").append(rule.code).append(" | ").append(name_of(rule.severity));
    out.append(" | [").append(rule.clause).append("](").append(page_of(rule.clause)).append(") | ");
    out.append(rule.holds).append(" | `").append(example_of(rule)).append("` |\n");
  }
  return out;
}

}  // namespace pstrips::inline validators
