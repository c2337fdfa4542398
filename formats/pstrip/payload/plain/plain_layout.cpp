#include <optional>

#include "formats/pstrip/container/chunk_table.h"
#include "formats/pstrip/payload/plain/plain.h"
#include "formats/pstrip/payload/plain/plain_fields.h"

namespace pstrips::inline formats {
namespace {

using namespace plain;

/// The head of a chunk; nothing when the payload is shorter or the mesh is not there.
///
/// mesh_of  mesh_of(i): mesh i, or null
template <class Head, class MeshOf>
std::optional<Head> head_of(const Chunk& chunk, MeshOf&& mesh_of) {
  FirstFault ignored;
  ReadIo io(chunk, 0, ignored);
  Head head;
  head_fields(io, head);
  const ProgressiveMesh* const mesh = io.failed() ? nullptr : mesh_of(head.mesh);
  if (mesh == nullptr) return std::nullopt;
  growth_fields(io, head, *mesh);
  if (io.failed()) return std::nullopt;
  return head;
}

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
            static_cast<Index>(end.map_offset - start.map_offset),
            static_cast<Index>((end.new_corner - start.new_corner) / 3)};
  }

  const ProgressiveStrips& strips_;
  std::vector<PlannedPacket> packets_;
};

class PlainLayout final : public GeometryLayout {
 public:
  Result<std::unique_ptr<GeometryWriter>> writer(const ProgressiveStrips& strips) const override {
    return std::make_unique<PlainWriter>(strips);
  }
  std::unique_ptr<GeometryReader> counting_reader(const FileHeader& header,
                                                  PartBits&) const override {
    return plain_codec().reader(header);
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
    const std::optional<Head> head =
        head_of<Head>(chunk, [&](Index m) { return m < meshes.size() ? &meshes[m] : nullptr; });
    if (!head) return {};
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
    const std::optional<Head> head = head_of<Head>(chunk, [&](Index) { return &mesh; });
    if (!head) return 0;
    LocateIo io(list);
    payload_fields(io, *head, mesh);
    return io.position() + sizeof(Index) * element;
  }
};

}  // namespace

const GeometryLayout& plain_layout() {
  static const PlainLayout layout;
  return layout;
}

}  // namespace pstrips::inline formats
