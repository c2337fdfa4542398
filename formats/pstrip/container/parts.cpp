#include "formats/pstrip/container/parts.h"

#include <array>

#include "formats/pstrip/payload/layout.h"

namespace pstrips::inline formats {
namespace {

using namespace layout;

class Lister {
 public:
  explicit Lister(const Limits& limits) : limits_(limits) {}

  void add(Part part, std::uint64_t offset, std::uint64_t bytes) {
    if (bytes == 0) return;
    if (!spans_.empty() && spans_.back().part == part && spans_.back().chunk == chunk_)
      spans_.back().bytes += bytes;
    else
      spans_.push_back({part, chunk_, offset, bytes});
  }

  void chunk(const Chunk& chunk, std::uint32_t index) {
    chunk_ = index;
    const std::uint64_t payload = chunk.payload_offset();
    add(Part::container, chunk.offset, kChunkHeaderBytes);
    if (chunk.type == kBaseChunk)
      arrays(
          chunk, BaseHead{}, [](auto& io, auto& head) { base_head_fields(io, head); },
          [](auto& io, const auto& head, const auto& mesh) { base_array_fields(io, head, mesh); });
    else if (chunk.type == kPacketChunk)
      arrays(
          chunk, PacketHead{}, [](auto& io, auto& head) { packet_head_fields(io, head); },
          [](auto& io, const auto& head, const auto& mesh) {
            packet_array_fields(io, head, mesh, PacketStart{});
          });
    else
      add(part_of(chunk.type), payload, chunk.payload.size());
    if (chunk.type == kMeshChunk) remember(chunk);
    const std::uint64_t end = payload + chunk.payload.size();
    add(Part::container, end, chunk.offset + chunk.bytes() - end);
  }

  std::vector<PartSpan> take() { return std::move(spans_); }

 private:
  static Part part_of(const ChunkType& type) {
    if (type == kHeaderChunk || type == kEndChunk) return Part::container;
    if (type == kMeshChunk) return Part::mesh_header;
    if (type == kIndexChunk) return Part::packet_index;
    if (type == kSceneChunk || type == kMaterialsChunk) return Part::scene;
    if (type == kFacesChunk) return Part::faces;
    if (type == kOrderChunk) return Part::order;
    if (type == kDigestChunk) return Part::digest;
    if (type == kImageChunk) return Part::images;
    if (type == kForeignChunk) return Part::foreign;
    return Part::unknown;
  }

  void remember(const Chunk& chunk) {
    ReadIo io(chunk.payload, chunk.payload_offset(), limits_.string_bytes);
    ProgressiveMesh mesh;
    MeshCounts counts;
    mesh_fields(io, mesh, counts);
    meshes_.push_back(std::move(mesh));
  }

  /// A payload of a head and aligned arrays whose sizes follow from the head and the mesh.
  template <class Head, class HeadFields, class ArrayFields>
  void arrays(const Chunk& chunk, Head head, HeadFields&& head_fields, ArrayFields&& array_fields) {
    const std::uint64_t payload = chunk.payload_offset();
    ReadIo in(chunk.payload, payload, limits_.string_bytes);
    head_fields(in, head);
    if (in.in().error() || head.mesh >= meshes_.size())
      return add(Part::container, payload, chunk.payload.size());
    PartIo io;
    head_fields(io, std::as_const(head));
    array_fields(io, head, meshes_[head.mesh]);
    if (io.size() != chunk.payload.size())
      return add(Part::container, payload, chunk.payload.size());
    add(Part::container, payload, io.marks().front().position);
    for (std::size_t i = 0; i < io.marks().size(); ++i) {
      const std::uint64_t begin = io.marks()[i].position;
      const std::uint64_t end = i + 1 < io.marks().size() ? io.marks()[i + 1].position : io.size();
      add(io.marks()[i].part, payload + begin, end - begin);
    }
  }

  Limits limits_;
  std::vector<ProgressiveMesh> meshes_;  ///< as far as MESH describes them
  std::vector<PartSpan> spans_;
  std::uint32_t chunk_ = 0;
};

}  // namespace

std::string_view name_of(Part part) {
  constexpr std::array<std::string_view, 20> kNames = {
      "container", "mesh_header", "packet_index", "base_positions", "base_wedges",
      "base_map",  "parents",     "counts",       "positions",      "parent_positions",
      "wedges",    "reassigned",  "map_offsets",  "faces",          "order",
      "digest",    "scene",       "images",       "foreign",        "unknown"};
  return kNames[static_cast<std::size_t>(part)];
}

std::vector<PartSpan> list_parts(const ChunkList& chunks, const Limits& limits) {
  Lister lister(limits);
  if (chunks.end >= kSignature.size()) lister.add(Part::container, 0, kSignature.size());
  for (std::size_t i = 0; i < chunks.chunks.size(); ++i)
    lister.chunk(chunks.chunks[i], static_cast<std::uint32_t>(i));
  return lister.take();
}

}  // namespace pstrips::inline formats
