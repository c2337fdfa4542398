#include "tests/validators/edits.h"
#include "tests/validators/samples.h"

namespace pstrips::test {
namespace {

// Where the fields of roof()'s MESH stand; its name takes eight bytes.
constexpr std::size_t kEncodingByte = 8, kReservedByte = 11, kPositionType = 24,
                      kPositionCount = 25;
constexpr std::size_t kPacketHead = 24;

ChunkFile::Item chunk(const char (&type)[5], Bytes payload = {}) {
  return {chunk_type(type), std::move(payload)};
}

void insert_before(ChunkFile& file, std::string_view type, ChunkFile::Item item) {
  file.items().insert(file.items().begin() + static_cast<std::ptrdiff_t>(file.find(type)),
                      std::move(item));
}
void erase(ChunkFile& file, std::string_view type) {
  file.items().erase(file.items().begin() + static_cast<std::ptrdiff_t>(file.find(type)));
}
void swap(ChunkFile& file, std::size_t a, std::size_t b) {
  std::swap(file.items()[a], file.items()[b]);
}

constexpr Case kCases[] = {
    {"PS0001_cut_short.pstrip",
     [] { return edited_bytes(roof(), [](Bytes& b) { b.resize(b.size() - 40); }); }},
    {"PS0001_cut_after_a_packet.pstrip",
     [] { return recut(roof(), [](ChunkFile& f) { f.items().pop_back(); }); }},
    {"PS0001_cut_short.pstripx",
     [] {
       Bytes bytes = write_xml(roof());
       bytes.resize(bytes.size() / 2);
       return bytes;
     }},
    {"PS0002_more_vertices_than_granted.pstrip",
     [] { return recut(roof(), [](ChunkFile& f) { f.put("PSHD", 16, std::uint64_t{1} << 40); }); }},
    {"PS0003_symbols_made_to_cost.pstrip", [] { return written(chained(300, 150)); }},

    {"PS1001_signature.pstrip",
     [] { return edited_bytes(roof(), [](Bytes& b) { b[4] = std::byte{0x0a}; }); }},
    {"PS1002_type_with_a_digit.pstrip",
     [] { return settled(roof(), [](ChunkFile& f) { insert_before(f, "PEND", chunk("xY1a")); }); }},
    {"PS1003_third_letter.pstrip",
     [] { return settled(roof(), [](ChunkFile& f) { insert_before(f, "PEND", chunk("xYza")); }); }},
    {"PS1004_length_past_2_31.pstrip",
     [] { return edited_bytes(roof(), [](Bytes& b) { b[b.size() - 9] = std::byte{0x80}; }); }},
    {"PS1005_chunk_padding.pstrip",
     [] {
       // PEND has no payload: four bytes of padding, then the CRC.
       return edited_bytes(roof(), [](Bytes& b) {
         b[b.size() - 5] = std::byte{1};
         const std::uint32_t crc = chunk_crc(ByteView(b).last(16).first(12));
         std::memcpy(b.data() + b.size() - 4, &crc, 4);
       });
     }},
    {"PS1006_crc.pstrip",
     [] { return edited_bytes(roof(), [](Bytes& b) { b.back() ^= std::byte{1}; }); }},
    {"PS1007_unknown_critical.pstrip",
     [] { return settled(roof(), [](ChunkFile& f) { insert_before(f, "PEND", chunk("XYZA")); }); }},
    {"PS1007_unknown_critical.pstripx",
     [] { return reworded(scene(), "type=\"xYZa\"", "type=\"XYZa\""); }},
    {"PS1008_name_not_utf8.pstrip",
     [] { return edited_mesh(roof(), [](ProgressiveMesh& m) { m.name = "\xff"; }); }},
    {"PS1010_not_first.pstrip",
     [] { return settled(roof(), [](ChunkFile& f) { insert_before(f, "PSHD", chunk("xYZa")); }); }},
    {"PS1011_materials_before_nodes.pstrip",
     [] {
       return settled(scene(), [](ChunkFile& f) { swap(f, f.find("sCNE"), f.find("mTRL")); });
     }},
    {"PS1012_scene_twice.pstrip",
     [] {
       return settled(roof(),
                      [](ChunkFile& f) { insert_before(f, "MESH", f.items()[f.find("sCNE")]); });
     }},
    {"PS1013_one_mesh_of_two.pstrip",
     [] { return recut(roof(), [](ChunkFile& f) { f.put("PSHD", 8, 2u); }); }},
    {"PS1014_no_base.pstrip",
     [] { return settled(roof(), [](ChunkFile& f) { erase(f, "BASE"); }); }},
    {"PS1015_two_packets_of_three.pstrip",
     [] { return recut(roof(), [](ChunkFile& f) { f.put("PSHD", 12, 3u); }); }},
    {"PS1016_digest_before_faces.pstrip",
     [] { return settled(seam(), [](ChunkFile& f) { swap(f, f.find("fACE"), f.find("dGST")); }); }},
    {"PS1016_images_descend.pstrip",
     [] {
       return settled(scene(), [](ChunkFile& f) { swap(f, f.find("iMGE"), f.find("iMGE", 1)); });
     }},
    {"PS1017_bytes_after_the_end.pstrip",
     [] { return edited_bytes(roof(), [](Bytes& b) { b.push_back(std::byte{0}); }); }},
    {"PS1018_end_with_payload.pstrip",
     [] { return settled(roof(), [](ChunkFile& f) { f.payload("PEND").resize(8); }); }},
    {"PS1020_bytes_after_the_counts.pstrip",
     [] {
       return settled(roof(),
                      [](ChunkFile& f) { f.payload("MESH").resize(f.payload("MESH").size() + 8); });
     }},
    {"PS1020_count_without_bytes.pstrip",
     [] { return recut(roof(), [](ChunkFile& f) { f.put("MESH", 28, 0xffffffffu); }); }},
    {"PS1021_reserved_byte.pstrip",
     [] {
       return recut(roof(), [](ChunkFile& f) { f.put("MESH", kReservedByte, std::uint8_t{1}); });
     }},
    {"PS1022_array_padding.pstrip",
     [] {
       // The one parent of the first packet is followed by four bytes.
       return recut(roof(), [](ChunkFile& f) { f.put("PCKT", kPacketHead + 4, 1u); });
     }},
    {"PS1023_encoding_7.pstrip",
     [] {
       return recut(roof(), [](ChunkFile& f) { f.put("MESH", kEncodingByte, std::uint8_t{7}); });
     }},
    {"PS1023_encoding_unheard_of.pstripx",
     [] { return reworded(roof(), "encoding=\"naive\"", "encoding=\"native\""); }},
    {"PS1030_version_2.pstrip",
     [] { return recut(roof(), [](ChunkFile& f) { f.put("PSHD", 0, std::uint16_t{2}); }); }},
    {"PS1030_version_1.pstripx",
     [] { return reworded(roof(), "<pstrips version=\"2.2\"", "<pstrips version=\"1.0\""); }},
    {"PS1031_profile_2.pstrip",
     [] { return recut(roof(), [](ChunkFile& f) { f.put("PSHD", 4, std::uint8_t{2}); }); }},
    {"PS1031_profile_unheard_of.pstripx",
     [] { return reworded(roof(), "profile=\"plain\"", "profile=\"compressed\""); }},
    {"PS1032_flags.pstrip",
     [] { return recut(roof(), [](ChunkFile& f) { f.put("PSHD", 6, std::uint16_t{1}); }); }},
    {"PS1033_level_1.pstrip",
     [] { return recut(roof(), [](ChunkFile& f) { f.put("PSHD", 5, std::uint8_t{1}); }); }},
    {"PS1034_total_of_strips.pstrip",
     [] { return recut(roof(), [](ChunkFile& f) { f.put("PSHD", 40, std::uint64_t{3}); }); }},
    {"PS1035_decoder_memory.pstrip",
     [] { return recut(roof(), [](ChunkFile& f) { f.put("PSHD", 64, std::uint64_t{1}); }); }},
    {"PS1036_base_end.pstrip",
     [] { return recut(roof(), [](ChunkFile& f) { f.put("PSHD", 80, std::uint64_t{8}); }); }},
    {"PS1037_file_bytes.pstrip",
     [] {
       return recut(roof(),
                    [](ChunkFile& f) { f.put("PSHD", 88, f.get<std::uint64_t>("PSHD", 88) + 8); });
     }},
    {"PS1037_length_past_the_file.pstrip",
     [] { return edited_bytes(roof(), [](Bytes& b) { b[b.size() - 11] = std::byte{1}; }); }},
    {"PS1040_a_row_too_few.pstrip",
     [] { return settled(roof(), [](ChunkFile& f) { f.rows().pop_back(); }); }},
    {"PS1040_no_index.pstrip",
     [] { return recut(roof(), [](ChunkFile& f) { erase(f, "PIDX"); }); }},
    {"PS1041_bytes_of_a_row.pstrip",
     [] {
       return recut(roof(), [](ChunkFile& f) {
         f.rows().back().bytes += 8;
         f.write_rows();
       });
     }},
    {"PS1041_offset_of_a_row.pstrip",
     [] {
       // The row says that another chunk stands before the packet. It makes PIDX longer by a byte.
       ChunkFile file(written(roof()));
       file.rows().back().offset += 8;
       return file.write_rows().bytes();
     }},
    {"PS1042_vsplits_of_a_row.pstrip",
     [] {
       return recut(roof(), [](ChunkFile& f) {
         f.rows()[1].vsplits = 9;
         f.write_rows();
       });
     }},
    {"PS1050_base_of_another_mesh.pstrip",
     [] { return recut(roof(), [](ChunkFile& f) { f.put("BASE", 0, 1u); }); }},
    {"PS1051_base_vertices.pstrip",
     [] { return recut(roof(), [](ChunkFile& f) { f.put("BASE", 4, 5u); }); }},
    {"PS1051_more_entries_than_all.pstrip",
     [] { return recut(growing(), [](ChunkFile& f) { f.put("BASE", 12, 18u); }); }},
    {"PS1052_map_of_strips_in_a_compact_file.pstripx",
     [] {
       ProgressiveStrips strips = roof();
       strips.profile = Profile::compact;
       strips.meshes[0].grid.step = 0.125f;
       return write_xml(strips);
     }},
    {"PS1055_packet_of_no_mesh.pstrip",
     [] { return recut(roof(), [](ChunkFile& f) { f.put("PCKT", 0, 1u); }); }},
    {"PS1055_packet_of_no_mesh.pstripx",
     [] { return reworded(roof(), "<packet mesh=\"0\"", "<packet mesh=\"7\""); }},
    {"PS1056_wedges_of_a_record.pstrip",
     [] {
       // Two parents, then the wedges of the two records.
       return recut(bare_seam(), [](ChunkFile& f) { f.put("PCKT", kPacketHead + 8, 2u); });
     }},
    {"PS1057_offsets_of_a_wedge.pstrip",
     [] { return recut(roof(), [](ChunkFile& f) { f.put("PCKT", kPacketHead + 8, 1u); }); }},
    {"PS1058_two_wedges_for_a_record.pstrip",
     [] { return recut(roof(), [](ChunkFile& f) { f.put("PCKT", 12, 2u); }); }},
    {"PS1059_triangles_of_a_record.pstrip",
     [] {
       // The head of 32 bytes, then parent, wedges, reassigned and offset count of the one record.
       return recut(growing(), [](ChunkFile& f) { f.put("PCKT", kPacketHead + 8 + 4 * 8, 3u); });
     }},
    {"PS1060_faces_of_no_mesh.pstrip",
     [] { return recut(seam(), [](ChunkFile& f) { f.put("fACE", 0, 1u); }); }},
    {"PS1061_faces_for_nothing.pstrip",
     [] {
       return settled(roof(),
                      [](ChunkFile& f) { insert_before(f, "PEND", chunk("fACE", Bytes(16))); });
     }},
    {"PS1061_faces_missing.pstrip",
     [] { return settled(numbered_faces(), [](ChunkFile& f) { erase(f, "fACE"); }); }},
    {"PS1062_order_of_no_mesh.pstrip",
     [] { return recut(seam(), [](ChunkFile& f) { f.put("oRDP", 0, 1u); }); }},
    {"PS1063_digest_of_no_mesh.pstrip",
     [] { return recut(seam(), [](ChunkFile& f) { f.put("dGST", 0, 1u); }); }},
    {"PS1064_algorithm_2.pstrip",
     [] { return recut(seam(), [](ChunkFile& f) { f.put("dGST", 4, 2u); }); }},
    {"PS1064_algorithm_md5.pstripx", [] { return reworded(seam(), "SHA-256", "MD5"); }},
    {"PS1065_a_bit_too_many.pstrip",
     [] {
       return recut(seam(), [](ChunkFile& f) {
         f.put("oRDP", 4, std::uint8_t{3});
         f.put("oRDP", 32, std::uint8_t{2 + (3 << 3)});  // the same rotations
       });
     }},
    {"PS1065_nine_bits.pstrip",
     [] { return recut(seam(), [](ChunkFile& f) { f.put("oRDP", 4, std::uint8_t{9}); }); }},
    {"PS1066_bits_after_the_faces.pstrip",
     [] { return recut(seam(), [](ChunkFile& f) { f.put("oRDP", 24, std::uint8_t{0xc9}); }); }},
    {"PS1070_image_not_embedded.pstrip",
     [] { return recut(scene(), [](ChunkFile& f) { f.put("iMGE", 0, 0u); }); }},
    {"PS1071_image_missing.pstrip",
     [] { return settled(scene(), [](ChunkFile& f) { erase(f, "iMGE"); }); }},
    {"PS1072_welding_of_no_mesh.pstrip",
     [] { return recut(welded(), [](ChunkFile& f) { f.put("wELD", 0, 1u); }); }},
    {"PS1073_a_bit_too_many.pstrip",
     [] {
       return recut(welded(), [](ChunkFile& f) {
         f.put("wELD", 31, std::uint8_t{2});
         f.put("wELD", 40, std::uint8_t{1 << 6});  // the same numbers
       });
     }},
    {"PS1073_33_bits.pstrip",
     [] { return recut(welded(), [](ChunkFile& f) { f.put("wELD", 28, std::uint8_t{33}); }); }},
};

}  // namespace

const std::span<const Case> kContainerCases = kCases;

}  // namespace pstrips::test
