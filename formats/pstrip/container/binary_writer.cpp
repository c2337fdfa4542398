#include <algorithm>
#include <cassert>
#include <cstring>

#include "formats/pstrip/container/binary.h"
#include "formats/pstrip/container/chunks.h"
#include "formats/pstrip/payload/check.h"
#include "formats/pstrip/payload/layout.h"

namespace pstrips::inline formats {
namespace {

using namespace layout;

struct Extent {
  ChunkType type{};
  std::uint64_t offset = 0, bytes = 0;
};

/// First pass: where each chunk will stand.
class Planner {
 public:
  template <class Fields>
  void chunk(const ChunkType& type, Fields&& fields) {
    const std::uint64_t payload = size_of_fields(fields);
    too_large_ = too_large_ || payload > kMaxPayloadBytes;
    extents_.push_back({type, end_, chunk_bytes(payload)});
    end_ += extents_.back().bytes;
  }

  const std::vector<Extent>& extents() const { return extents_; }
  std::uint64_t end() const { return end_; }
  bool too_large() const { return too_large_; }

 private:
  std::vector<Extent> extents_;
  std::uint64_t end_ = kSignature.size();
  bool too_large_ = false;
};

/// Second pass: fills a buffer of zeros.
class Filler {
 public:
  explicit Filler(std::uint64_t size) : out_(size) { std::ranges::copy(kSignature, out_.begin()); }

  template <class Fields>
  void chunk(const ChunkType& type, Fields&& fields) {
    const std::uint64_t payload = size_of_fields(fields);
    const std::uint64_t bytes = chunk_bytes(payload);
    const std::span<std::byte> whole = std::span(out_).subspan(at_, bytes);
    const auto length = static_cast<std::uint32_t>(payload);
    std::memcpy(whole.data(), type.data(), 4);
    std::memcpy(whole.data() + 4, &length, 4);
    WriteIo io(whole.subspan(kChunkHeaderBytes, payload));
    fields(io);
    const std::uint32_t crc = chunk_crc(whole.first(bytes - 4));
    std::memcpy(whole.data() + bytes - 4, &crc, 4);
    at_ += bytes;
  }

  Bytes take() && { return std::move(out_); }

 private:
  Bytes out_;
  std::size_t at_ = kSignature.size();
};

MeshCounts counts_of(const ProgressiveMesh& mesh) {
  return {mesh.vertices,
          mesh.wedges,
          mesh.triangles,
          mesh.strips,
          static_cast<Index>(mesh.base_map.size()),
          static_cast<Index>(mesh.vsplits.size()),
          face_count(mesh),
          mesh.base_vertices,
          mesh.base_wedges};
}

template <class Out>
void write_tail(Out& out, const ProgressiveMesh& mesh, Index index) {
  if (!mesh.faces.empty())
    out.chunk(kFacesChunk, [&](auto& io) {
      const FacesHead head{index, mesh.faces.count(), static_cast<Index>(mesh.faces.corners.size()),
                           static_cast<Index>(mesh.faces.replaced.size())};
      faces_head_fields(io, head);
      faces_array_fields(io, head, mesh.faces, face_count(mesh));
    });
  if (mesh.order != OriginalOrder{})
    out.chunk(kOrderChunk, [&](auto& io) {
      const OrderHead head{index, rotation_bits(mesh.order.rotation)};
      order_head_fields(io, head);
      order_array_fields(io, head, counts_of(mesh), mesh.single_wedges, mesh.order);
    });
  if (!mesh.digest.empty())
    out.chunk(kDigestChunk, [&](auto& io) {
      io.number(index);
      io.number(kSha256);
      io.rest(mesh.digest);
    });
}

/// All chunks in file order. `out` is a Planner or a Filler.
template <class Out>
void write_chunks(Out& out, const ProgressiveStrips& strips, const FileHeader& header,
                  const std::vector<IndexRow>& rows) {
  const Scene& scene = strips.scene;
  const auto meshes = static_cast<Index>(strips.meshes.size());
  out.chunk(kHeaderChunk, [&](auto& io) { header_fields(io, header); });
  if (!strips.generator.empty() || !scene.nodes.empty())
    out.chunk(kSceneChunk, [&](auto& io) { scene_fields(io, strips); });
  if (!scene.materials.empty() || !scene.images.empty()) {
    std::vector<std::uint8_t> embedded;
    for (const Image& image : scene.images) embedded.push_back(image.data.empty() ? 0 : 1);
    out.chunk(kMaterialsChunk, [&](auto& io) { material_fields(io, scene, embedded); });
  }
  for (const ProgressiveMesh& mesh : strips.meshes) {
    const MeshCounts counts = counts_of(mesh);
    out.chunk(kMeshChunk, [&](auto& io) { mesh_fields(io, mesh, counts); });
  }
  out.chunk(kIndexChunk, [&](auto& io) { index_fields(io, rows); });

  std::vector<PacketStart> reached;
  for (Index m = 0; m < meshes; ++m) {
    const ProgressiveMesh& mesh = strips.meshes[m];
    reached.push_back(first_packet(mesh));
    out.chunk(kBaseChunk, [&](auto& io) {
      const BaseHead head{m, mesh.base_vertices, mesh.base_wedges,
                          static_cast<Index>(mesh.base_map.size())};
      base_head_fields(io, head);
      base_array_fields(io, head, mesh);
    });
  }
  for (const Packet& packet : strips.packets) {
    const ProgressiveMesh& mesh = strips.meshes[packet.mesh];
    PacketStart& start = reached[packet.mesh];
    const PacketStart end = packet_after(mesh, start, packet.vsplits);
    out.chunk(kPacketChunk, [&](auto& io) {
      const PacketHead head{packet.mesh,
                            packet.first_vsplit,
                            packet.vsplits,
                            end.wedges - start.wedges,
                            static_cast<Index>(end.reassigned - start.reassigned),
                            static_cast<Index>(end.map_offset - start.map_offset)};
      packet_head_fields(io, head);
      packet_array_fields(io, head, mesh, start);
    });
    start = end;
  }

  for (Index m = 0; m < meshes; ++m) write_tail(out, strips.meshes[m], m);
  for (Index i = 0; i < scene.images.size(); ++i)
    if (!scene.images[i].data.empty())
      out.chunk(kImageChunk, [&](auto& io) { image_fields(io, i, scene.images[i].data); });
  for (const Foreign& foreign : scene.foreign)
    out.chunk(kForeignChunk, [&](auto& io) { foreign_fields(io, foreign); });
  for (const UnknownChunk& chunk : strips.unknown)
    out.chunk(chunk.type, [&](auto& io) { io.rest(chunk.payload); });
  out.chunk(kEndChunk, [](auto&) {});
}

IndexRow row_of(const Packet& packet) {
  return {.mesh = packet.mesh,
          .vsplits = packet.vsplits,
          .vertices = packet.vertices,
          .triangles = packet.triangles,
          .strips = packet.strips,
          .error = packet.error,
          .one_sided_error = packet.one_sided_error};
}

FileHeader totals_of(const ProgressiveStrips& strips) {
  FileHeader header;
  header.meshes = static_cast<std::uint32_t>(strips.meshes.size());
  header.packets = static_cast<std::uint32_t>(strips.packets.size());
  for (const ProgressiveMesh& mesh : strips.meshes) {
    if (mesh.order != OriginalOrder{}) header.version_minor = 1;  // that has oRDP
    header.vertices += mesh.vertices;
    header.wedges += mesh.wedges;
    header.triangles += mesh.triangles;
    header.strips += mesh.strips;
    header.map_entries += mesh.base_map.size();
    header.faces += face_count(mesh);
    header.vsplits += mesh.vsplits.size();
  }
  return header;
}

}  // namespace

Result<Bytes> write_binary(const ProgressiveStrips& strips) {
  assert(strips.complete && check(strips));
  return write_binary_unchecked(strips);
}

Result<Bytes> write_binary_unchecked(const ProgressiveStrips& strips) {
  FileHeader header = totals_of(strips);
  std::vector<IndexRow> rows;
  for (const BaseLevel& base : strips.bases) rows.push_back(row_of(base));
  for (const Packet& packet : strips.packets) rows.push_back(row_of(packet));

  Planner plan;
  write_chunks(plan, strips, header, rows);
  if (plan.too_large()) return fail(ErrorCode::over_limit, "a chunk would exceed 2^31 - 1 bytes");
  std::uint64_t largest = 0;
  std::size_t row = 0;
  header.base_end = plan.end();
  for (const Extent& extent : plan.extents()) {
    if (extent.type == kIndexChunk) header.base_end = extent.offset + extent.bytes;
    if (extent.type != kBaseChunk && extent.type != kPacketChunk) continue;
    if (extent.type == kBaseChunk) header.base_end = extent.offset + extent.bytes;
    rows[row].offset = extent.offset;
    rows[row++].bytes = static_cast<std::uint32_t>(extent.bytes);
    largest = std::max(largest, extent.bytes);
  }
  header.file_bytes = plan.end();
  header.decoder_memory = decoder_memory(strips.meshes, largest);
  header.level = conformance_level(header);

  Filler out(plan.end());
  write_chunks(out, strips, header, rows);
  return std::move(out).take();
}

std::uint64_t decoder_memory(std::span<const ProgressiveMesh> meshes, std::uint64_t largest_chunk) {
  std::uint64_t bytes = largest_chunk;
  for (const ProgressiveMesh& mesh : meshes) {
    std::uint64_t wedge_bytes = mesh.single_wedges ? 0 : sizeof(Index);
    for (const Attribute& a : mesh.wedge_attributes) wedge_bytes += a.element_bytes();
    std::uint64_t entries = 0;
    for (const Index n : mesh.group_entries) entries += n;
    // The index map twice: as stored and resolved.
    bytes += mesh.vertices * mesh.position.element_bytes() + mesh.wedges * wedge_bytes +
             entries * 2 * sizeof(Index);
  }
  return bytes;
}

std::uint8_t conformance_level(const FileHeader& header) {
  struct Bounds {
    std::uint64_t vertices, wedges, map_entries, memory;
  };
  constexpr Bounds kLevels[] = {{1u << 16, 1u << 17, 1u << 19, 1u << 24},
                                {1u << 20, 1u << 21, 1u << 23, 1u << 28},
                                {1u << 24, 1u << 25, 1u << 27, 1ull << 32}};
  const auto admits = [&](const Bounds& b) {
    return header.vertices <= b.vertices && header.wedges <= b.wedges &&
           header.map_entries <= b.map_entries && header.decoder_memory <= b.memory;
  };
  return static_cast<std::uint8_t>(std::ranges::find_if(kLevels, admits) - std::begin(kLevels));
}

}  // namespace pstrips::inline formats
