// Files of the compact profile that break one clause each: heads that are edited, and runs of codes
// that say what no writer would.

#include "formats/pstrip/payload/compact/compact_fields.h"
#include "formats/pstrip/payload/compact/packet_code.h"
#include "tests/validators/edits.h"
#include "tests/validators/samples.h"

namespace pstrips::test {
namespace {

// The heads of batches(): four numbers and the cells of an attribute, three numbers.
constexpr std::size_t kBaseHead = 5, kPacketHead = 3;
// Where fields of its MESH, which has no name, and of PSHD stand.
constexpr std::size_t kAttributeCount = 24, kMemory = 64;

template <class Edit>
Bytes with_base(Edit edit) {
  return settled(batches(), [&](ChunkFile& f) { edit(f.payload("BASE")); });
}
template <class Edit>
Bytes with_fine(Edit edit) {
  return settled(batches(), [&](ChunkFile& f) { edit(f.payload("FINE")); });
}

void replace(Bytes& bytes, std::size_t at, std::size_t count, std::initializer_list<int> by) {
  const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(at);
  bytes.erase(first, first + static_cast<std::ptrdiff_t>(count));
  Bytes inserted;
  for (const int byte : by) inserted.push_back(static_cast<std::byte>(byte));
  bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at), inserted.begin(), inserted.end());
}

/// The first packet with another run.
template <class Write>
Bytes with_first_run(Write write) {
  const ProgressiveStrips strips = batches();
  return settled(strips, [&](ChunkFile& f) {
    const Bytes& payload = f.payload("BASE");
    const ProgressiveMesh& mesh = strips.meshes[0];
    const MeshCells cells{PositionCells(mesh.grid, ComponentType::f32),
                          {*unpacked(std::to_integer<std::uint64_t>(payload[kBaseHead - 1]),
                                     mesh.wedge_attributes[0])}};
    AttributeModels attributes(cells);
    RansReader reader(ByteView(payload).subspan(kBaseHead));
    BaseMesh base;
    const auto entries = static_cast<Index>(mesh.base_map.size());
    static_cast<void>(
        BaseCode(reader, base_counts_of(mesh, cells, entries), cells, attributes, base).run());
    MeshState state(mesh, cells, std::move(attributes));
    state.start(base);
    RansWriter writer;
    write(writer, state);
    Bytes& packet = f.payload("PCKT");
    packet.resize(kPacketHead);
    const Bytes run = writer.finish();
    packet.insert(packet.end(), run.begin(), run.end());
  });
}

/// A batch whose first vertex splits so.
///
/// then  called with the writer and the state after the split; nothing else follows
template <class Then>
Bytes with_split(const GridSplit& split, Then then) {
  return with_first_run([&](RansWriter& writer, MeshState& state) {
    bool first = true;
    static_cast<void>(code_batch(
        writer, state.splits, BatchLimits{100, 100},
        [&](Index) { return std::exchange(first, false) ? &split : nullptr; },
        [&](Index, Index) {
          then(writer, state);
          return Result<void>();
        }));
  });
}

/// The long form, with all corners left where they are.
GridSplit long_form() {
  GridSplit split;
  split.chord = false;
  split.moves.assign(1, false);
  return split;
}

constexpr Case kCases[] = {
    {"PS1067_fine_of_no_mesh.pstrip",
     [] { return with_fine([](Bytes& b) { b[0] = std::byte{1}; }); }},
    {"PS1068_fine_missing.pstrip",
     [] {
       return settled(batches(), [](ChunkFile& f) {
         f.items().erase(f.items().begin() + static_cast<std::ptrdiff_t>(f.find("FINE")));
       });
     }},
    {"PS1069_fine_too_long.pstrip",
     [] { return with_fine([](Bytes& b) { b.push_back(std::byte{0}); }); }},
    {"PS6001_too_many_components.pstrip",
     [] {
       return settled(batches(), [](ChunkFile& f) {
         // Five attributes more, named by one letter each.
         constexpr std::uint8_t kMore = 5, kComponents = 255;
         f.put("MESH", kAttributeCount, std::uint32_t{1 + kMore});
         for (char name = 'a'; name < 'a' + kMore; ++name)
           replace(f.payload("MESH"), kAttributeCount + 4, 0,
                   {1, 0, 0, 0, name, static_cast<int>(ComponentType::u8), kComponents, 0, 0});
         const std::uint64_t wedges = batches().meshes[0].wedges;
         f.put("PSHD", kMemory,
               f.get<std::uint64_t>("PSHD", kMemory) + kMore * kComponents * wedges);
       });
     }},
    {"PS6002_exponent_of_cells.pstrip",
     [] { return with_base([](Bytes& b) {
            replace(b, kBaseHead - 1, 1, {0xd4, 0x08});
          }); }},
    {"PS6002_direction_of_two_components.pstrip",
     [] { return with_base([](Bytes& b) {
            replace(b, kBaseHead - 1, 1, {0x88, 0x40});
          }); }},
    {"PS6003_number_longer_than_needed.pstrip",
     [] { return with_base([](Bytes& b) {
            replace(b, 0, 1, {0x80, 0x00});
          }); }},
    {"PS6004_bytes_behind_a_base.pstrip",
     [] { return with_base([](Bytes& b) {
            replace(b, b.size(), 0, {0, 0});
          }); }},
    {"PS6004_packet_ends_early.pstrip",
     [] {
       return settled(batches(), [](ChunkFile& f) { f.payload("PCKT").resize(kPacketHead + 6); });
     }},
    {"PS6005_no_gate.pstrip",
     [] {
       return with_base([](Bytes& b) {
         RansWriter writer;
         SymbolModel place;
         writer.symbol(place, 0);
         const Bytes run = writer.finish();
         b.resize(kBaseHead);
         b.insert(b.end(), run.begin(), run.end());
       });
     }},
    {"PS6006_batch_without_splits.pstrip",
     [] {
       return with_first_run([](RansWriter& writer, MeshState& state) {
         static_cast<void>(code_batch(
             writer, state.splits, BatchLimits{100, 100},
             [](Index) -> const GridSplit* { return nullptr; },
             [](Index, Index) { return Result<void>(); }));
       });
     }},
    {"PS6007_vertex_leaves_the_cells.pstrip",
     [] {
       GridSplit split = long_form();
       split.step = {1 << 25, 0, 0};
       return with_split(split, [](auto&, auto&) {});
     }},
    {"PS6008_wedge_not_there.pstrip",
     [] {
       return with_split(long_form(), [](RansWriter& writer, MeshState& state) {
         writer.bit(state.models.regular[0], false);
         code_count(writer, state.models.new_wedges, 1);
         code_count(writer, state.models.taken, 1);
         writer.raw(state.wedges, static_cast<unsigned>(std::bit_width(state.wedges)));
       });
     }},
    {"PS6009_face_of_two_vertices.pstrip",
     [] {
       GridSplit split = long_form();
       split.third = {0};  // the vertex that splits
       split.new_first = {true};
       return with_split(split, [](auto&, auto&) {});
     }},
};

}  // namespace

const std::span<const Case> kCompactCases = kCases;

}  // namespace pstrips::test
