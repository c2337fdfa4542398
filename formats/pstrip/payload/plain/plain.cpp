#include "formats/pstrip/payload/plain/plain.h"

#include <concepts>
#include <optional>

#include "formats/pstrip/container/chunk_table.h"

namespace pstrips::inline formats {
namespace {

using namespace layout;

template <class T, class Plain>
concept Is = std::same_as<std::remove_const_t<T>, Plain>;

// Fields in file order, as in layout.h.

constexpr std::uint64_t kBaseHeadBytes = 16;

template <class Io, Is<BaseHead> H>
void head_fields(Io& io, H& h) {
  io.number(h.mesh);
  io.number(h.vertices);
  io.number(h.wedges);
  io.number(h.map_entries);
}

template <class Io, class M>
void base_array_fields(Io& io, const BaseHead& h, M& mesh) {
  io.part(Part::base_positions);
  io.run(mesh.position, 0, h.vertices);
  io.align();
  io.part(Part::base_wedges);
  if (!mesh.single_wedges) io.run(mesh.base_wedge_vertex, 0, h.wedges);
  io.align();
  for (auto& a : mesh.wedge_attributes) {
    io.run(a, 0, h.wedges);
    io.align();
  }
  io.part(Part::base_map);
  io.run(mesh.base_map, 0, h.map_entries);
  io.align();
}

constexpr std::uint64_t kPacketHeadBytes = 24;

template <class Io, Is<PacketHead> H>
void head_fields(Io& io, H& h) {
  io.number(h.mesh);
  io.number(h.first_vsplit);
  io.number(h.vsplits);
  io.number(h.wedges);
  io.number(h.reassigned);
  io.number(h.map_offsets);
}

/// start  where the packet's part of each of the mesh's lists begins
template <class Io, class M>
void packet_array_fields(Io& io, const PacketHead& h, M& mesh, const PacketStart& start) {
  io.part(Part::parents);
  io.column(mesh.vsplits, &Vsplit::parent, start.vsplit, h.vsplits);
  io.align();
  io.part(Part::counts);
  if (!mesh.single_wedges) {
    io.column(mesh.vsplits, &Vsplit::wedges, start.vsplit, h.vsplits);
    io.align();
    io.column(mesh.vsplits, &Vsplit::reassigned, start.vsplit, h.vsplits);
    io.align();
  }
  // With single wedges there is one new wedge a vsplit: the same list serves both forms.
  io.run(mesh.wedge_offset_counts, start.offset_count, h.wedges);
  io.align();
  io.part(Part::positions);
  io.run(mesh.position, start.vertices, h.vsplits);
  io.align();
  io.part(Part::parent_positions);
  if (mesh.placement == Placement::optimal)
    io.run(mesh.parent_position, mesh.position.element_bytes(), start.vsplit, h.vsplits);
  io.align();
  io.part(Part::wedges);
  for (auto& a : mesh.wedge_attributes) {
    io.run(a, start.wedges, h.wedges);
    io.align();
  }
  io.part(Part::reassigned);
  io.run(mesh.reassigned, start.reassigned, h.reassigned);
  io.align();
  io.part(Part::map_offsets);
  io.run(mesh.map_offsets, start.map_offset, h.map_offsets);
  io.align();
}

// ---- Both payloads at a time: a head and the arrays that it counts -------------------------

template <class Io, class M>
void array_fields(Io& io, const BaseHead& head, M& mesh, const PacketStart&) {
  base_array_fields(io, head, mesh);
}
template <class Io, class M>
void array_fields(Io& io, const PacketHead& head, M& mesh, const PacketStart& start) {
  packet_array_fields(io, head, mesh, start);
}

template <class Io, class Head>
void payload_fields(Io& io, const Head& head, const ProgressiveMesh& mesh,
                    const PacketStart& start = {}) {
  head_fields(io, head);
  array_fields(io, head, mesh, start);
}

template <class Head>
std::uint64_t payload_bytes(const Head& head, const ProgressiveMesh& mesh) {
  return size_of_fields([&](SizeIo& io) { payload_fields(io, head, mesh); });
}

/// The head of a chunk; nothing when the payload is shorter.
template <class Head>
std::optional<Head> head_of(const Chunk& chunk) {
  FirstFault ignored;
  ReadIo io(chunk, 0, ignored);
  Head head;
  head_fields(io, head);
  if (io.failed()) return std::nullopt;
  return head;
}

class PlainReader final : public GeometryReader {
 public:
  void read_head(ReadIo& io, BaseHead& head) override { head_fields(io, head); }
  void read_head(ReadIo& io, PacketHead& head) override { head_fields(io, head); }
  bool read(ReadIo& io, const BaseHead& head, ProgressiveMesh& mesh) override {
    return read_arrays(io, head, mesh, {});
  }
  bool read(ReadIo& io, const PacketHead& head, ProgressiveMesh& mesh,
            const PacketStart& start) override {
    return read_arrays(io, head, mesh, start);
  }

 private:
  template <class Head>
  static bool read_arrays(ReadIo& io, const Head& head, ProgressiveMesh& mesh,
                          const PacketStart& start) {
    if (!io.expect([&](SizeIo& size) { payload_fields(size, head, mesh); })) return false;
    array_fields(io, head, mesh, start);
    return io.finish();
  }
};

class PlainWriter final : public GeometryWriter {
 public:
  explicit PlainWriter(const ProgressiveStrips& strips) : strips_(strips) {
    std::vector<PacketStart> reached;
    for (const ProgressiveMesh& mesh : strips.meshes) reached.push_back(first_packet(mesh));
    for (const Packet& packet : strips.packets) {
      PacketStart& start = reached[packet.mesh];
      const PacketStart end = packet_after(strips.meshes[packet.mesh], start, packet.vsplits);
      packets_.push_back({head_of_packet(packet, start, end), start});
      start = end;
    }
  }

  std::uint64_t base_bytes(Index mesh) override {
    return payload_bytes(head_of_base(mesh), strips_.meshes[mesh]);
  }
  std::uint64_t packet_bytes(std::size_t packet) override {
    const PacketHead& head = packets_[packet].head;
    return payload_bytes(head, strips_.meshes[head.mesh]);
  }
  void write_base(Index mesh, std::span<std::byte> payload) override {
    WriteIo io(payload);
    payload_fields(io, head_of_base(mesh), strips_.meshes[mesh]);
  }
  void write_packet(std::size_t packet, std::span<std::byte> payload) override {
    WriteIo io(payload);
    const auto& [head, start] = packets_[packet];
    payload_fields(io, head, strips_.meshes[head.mesh], start);
  }

 private:
  struct PlannedPacket {
    PacketHead head;
    PacketStart start;
  };

  BaseHead head_of_base(Index index) const {
    const ProgressiveMesh& mesh = strips_.meshes[index];
    return {index, mesh.base_vertices, mesh.base_wedges, static_cast<Index>(mesh.base_map.size())};
  }
  static PacketHead head_of_packet(const Packet& packet, const PacketStart& start,
                                   const PacketStart& end) {
    return {packet.mesh,
            packet.first_vsplit,
            packet.vsplits,
            end.wedges - start.wedges,
            static_cast<Index>(end.reassigned - start.reassigned),
            static_cast<Index>(end.map_offset - start.map_offset)};
  }

  const ProgressiveStrips& strips_;
  std::vector<PlannedPacket> packets_;
};

class PlainCodec final : public GeometryCodec {
 public:
  std::unique_ptr<GeometryReader> reader() const override {
    return std::make_unique<PlainReader>();
  }
  std::unique_ptr<GeometryWriter> writer(const ProgressiveStrips& strips) const override {
    return std::make_unique<PlainWriter>(strips);
  }

  std::uint64_t min_packet_bytes() const override { return kPacketHeadBytes; }
  std::uint64_t min_base_bytes() const override { return kBaseHeadBytes; }
  // A vsplit takes more room in memory than its fields in the file.
  std::uint64_t max_expansion() const override { return 2; }

  std::uint64_t estimate_map_offsets(const ProgressiveMesh& mesh, std::uint64_t vsplits,
                                     std::uint64_t packets, std::uint64_t bytes) const override {
    const std::uint64_t wedges = mesh.wedges - mesh.base_wedges;
    const std::uint64_t positions = mesh.placement == Placement::optimal ? 2 : 1;
    std::uint64_t wedge_bytes = sizeof(Index);
    for (const Attribute& a : mesh.wedge_attributes) wedge_bytes += a.element_bytes();
    const std::uint64_t columns = mesh.single_wedges ? 1 : 3;
    // What is left of the packets is reassigned wedges, few, and map offsets.
    const std::uint64_t fixed =
        packets * kPacketHeadBytes + wedges * wedge_bytes +
        vsplits * (columns * sizeof(Index) + positions * mesh.position.element_bytes());
    return bytes > fixed ? (bytes - fixed) / sizeof(Index) : 0;
  }

  std::vector<PartMark> parts(const Chunk& chunk,
                              std::span<const ProgressiveMesh> meshes) const override {
    return chunk.type == kBaseChunk ? parts_of<BaseHead>(chunk, meshes)
                                    : parts_of<PacketHead>(chunk, meshes);
  }
  std::uint64_t position_of(const Chunk& chunk, const ProgressiveMesh& mesh, const void* list,
                            std::uint64_t element) const override {
    return chunk.type == kBaseChunk ? position_in<BaseHead>(chunk, mesh, list, element)
                                    : position_in<PacketHead>(chunk, mesh, list, element);
  }

 private:
  template <class Head>
  static std::vector<PartMark> parts_of(const Chunk& chunk,
                                        std::span<const ProgressiveMesh> meshes) {
    const std::optional<Head> head = head_of<Head>(chunk);
    if (!head || head->mesh >= meshes.size()) return {};
    PartIo io;
    payload_fields(io, *head, meshes[head->mesh]);
    if (io.size() != chunk.payload.size()) return {};
    std::vector<PartMark> marks{{Part::container, 0}};
    for (const auto& [part, position] : io.marks()) marks.push_back({part, position});
    return marks;
  }
  // All lists that are looked for have elements of 32 bits.
  template <class Head>
  static std::uint64_t position_in(const Chunk& chunk, const ProgressiveMesh& mesh,
                                   const void* list, std::uint64_t element) {
    const std::optional<Head> head = head_of<Head>(chunk);
    if (!head) return 0;
    LocateIo io(list);
    payload_fields(io, *head, mesh);
    return io.position() + sizeof(Index) * element;
  }
};

}  // namespace

const GeometryCodec& plain_codec() {
  static const PlainCodec codec;
  return codec;
}

}  // namespace pstrips::inline formats
