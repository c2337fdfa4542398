#include "formats/pstrip/container/parts.h"

#include <optional>

#include "formats/pstrip/payload/geometry_layout.h"
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

  void add(const Chunk& chunk) {
    chunk_ = static_cast<std::uint32_t>(chunk.number);
    const std::uint64_t payload = chunk.payload_offset();
    add(Part::container, chunk.offset, kChunkHeaderBytes);
    if (chunk.type == kBaseChunk || chunk.type == kPacketChunk)
      add_geometry(chunk);
    else
      add(part_of(chunk.type), payload, chunk.payload.size());
    if (chunk.type == kHeaderChunk) profile_ = profile_of(chunk);
    if (chunk.type == kMeshChunk) meshes_.push_back(mesh_of(chunk));
    const std::uint64_t end = payload + chunk.payload.size();
    add(Part::container, end, chunk.offset + chunk.bytes() - end);
  }

  std::vector<PartSpan> take() { return std::move(spans_); }

 private:
  std::optional<Profile> profile_of(const Chunk& chunk) const {
    FirstFault ignored;
    ReadIo io(chunk, limits_.string_bytes, ignored);
    FileHeader header;
    header_fields(io, header);
    return profile_numbered(header.profile);
  }

  ProgressiveMesh mesh_of(const Chunk& chunk) const {
    FirstFault ignored;
    ReadIo io(chunk, limits_.string_bytes, ignored);
    ProgressiveMesh mesh;
    MeshCounts counts;
    mesh_fields(io, mesh, counts, profile_.value_or(Profile::plain));
    return mesh;
  }

  void add_geometry(const Chunk& chunk) {
    std::vector<PartMark> marks;
    if (profile_) marks = layout_of(*profile_).parts(chunk, meshes_);
    if (marks.empty()) marks.push_back({});
    for (std::size_t i = 0; i < marks.size(); ++i) {
      const std::uint64_t begin = marks[i].position;
      const std::uint64_t end = i + 1 < marks.size() ? marks[i + 1].position : chunk.payload.size();
      add(marks[i].part, chunk.payload_offset() + begin, end - begin);
    }
  }

  Limits limits_;
  std::optional<Profile> profile_;
  std::vector<ProgressiveMesh> meshes_;  ///< as far as MESH describes them
  std::vector<PartSpan> spans_;
  std::uint32_t chunk_ = 0;
};

}  // namespace

std::vector<PartSpan> list_parts(const ChunkList& chunks, const Limits& limits) {
  Lister lister(limits);
  if (chunks.end >= kSignature.size()) lister.add(Part::container, 0, kSignature.size());
  for (const Chunk& chunk : chunks.chunks) lister.add(chunk);
  return lister.take();
}

}  // namespace pstrips::inline formats
