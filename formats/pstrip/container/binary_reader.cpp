#include <algorithm>
#include <cassert>
#include <cmath>

#include "formats/pstrip/container/binary.h"
#include "formats/pstrip/container/chunks.h"
#include "formats/pstrip/payload/check.h"
#include "formats/pstrip/payload/layout.h"

namespace pstrips::inline formats {

using namespace layout;

struct BinaryParser::State {
  /// reservable  twice the file: a vsplit takes more room in memory than its fields in the file
  State(const Limits& l, std::uint64_t file_bytes) : limits(l), reservable(2 * file_bytes) {
    strips.complete = false;
  }

  /// What may come next; chunks of an earlier stage are out of order.
  enum class Stage : std::uint8_t { header, scene, materials, meshes, bases, packets, tail, end };

  Limits limits;
  std::uint64_t reservable;  ///< bytes that may still be allocated ahead of what is there

  ProgressiveStrips strips;
  std::optional<FileHeader> header;
  std::vector<IndexRow> rows;
  std::vector<MeshCounts> counts;
  std::vector<std::uint64_t> packet_array_bytes;  ///< per mesh, in all its packets, as PIDX says
  std::vector<PacketStart> reached;               ///< per mesh, what its packets brought
  std::vector<std::uint8_t> embedded;
  std::optional<Error> error;

  Stage stage = Stage::header;
  std::size_t row = 0;           ///< rows whose chunk is there
  std::uint64_t tail_rank = 0;   ///< of the last tail chunk, see tail()
  std::uint64_t kept_bytes = 0;  ///< payload bytes of the chunks so far
  std::uint64_t taken = 0;       ///< bytes fed
  Bytes pending;                 ///< the start of a chunk that is not whole yet
  std::uint64_t offset = 0;      ///< of the first byte not parsed

  Result<void> feed(ByteView bytes);
  /// How many bytes `pending` lacks to the end of its chunk, or of the chunk's header. At least 1.
  std::size_t bytes_to_whole() const;
  /// Parses whole chunks off the front of `bytes`; says how many bytes that were.
  Result<std::size_t> parse(ByteView bytes);
  Result<void> chunk(const ChunkType& type, ByteView payload);
  Result<void> known_chunk(const ChunkType& type, ReadIo& io);

  Result<void> read_header(ReadIo& io);
  Result<void> read_scene(ReadIo& io);
  Result<void> read_materials(ReadIo& io);
  Result<void> read_mesh(ReadIo& io);
  Result<void> read_index(ReadIo& io);
  Result<void> read_base(ReadIo& io);
  Result<void> read_packet(ReadIo& io);
  Result<void> read_faces(ReadIo& io);
  Result<void> read_order(ReadIo& io);
  Result<void> read_digest(ReadIo& io);
  Result<void> read_image(ReadIo& io);
  Result<void> read_foreign(ReadIo& io);
  Result<void> read_end();

  /// The row that announced the current chunk, or nothing when it is not the one that is next.
  const IndexRow* next_row(Index mesh) const;
  /// Tail chunks ascend: by mesh, then kind; images by index; then foreign entries.
  bool ascends(std::uint64_t rank);
  void reserve(Index mesh);
  void cut_back(Index mesh);

  tl::unexpected<Error> corrupt(const char* message) const {
    return fail(ErrorCode::corrupt, message, offset);
  }
};

namespace {

/// The reader's error, or that the payload goes on after its last field.
Result<void> finish(ReadIo& io) {
  io.in().expect_end();
  if (!io.in().error()) return {};
  Error error = *io.in().error();
  // The chunk is whole: its own counts are wrong.
  if (error.code == ErrorCode::truncated) {
    error.code = ErrorCode::corrupt;
    error.message = "payload ends inside a field";
  }
  return tl::unexpected<Error>(std::move(error));
}

/// A check's error, at the chunk that brought the data.
Result<void> at_offset(Result<void> result, std::uint64_t offset) {
  if (!result && result.error().offset == kNoOffset) result.error().offset = offset;
  return result;
}

}  // namespace

Result<void> BinaryParser::State::feed(ByteView bytes) {
  taken += bytes.size();
  while (!pending.empty() && !bytes.empty()) {
    const std::size_t more = std::min(bytes.size(), bytes_to_whole());
    pending.insert(pending.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(more));
    bytes = bytes.subspan(more);
    const Result<std::size_t> used = parse(pending);
    if (!used) return tl::unexpected<Error>(used.error());
    if (*used != 0) pending.clear();  // never filled past the end of a chunk
  }
  if (bytes.empty()) return {};
  const Result<std::size_t> used = parse(bytes);
  if (!used) return tl::unexpected<Error>(used.error());
  const ByteView rest = bytes.subspan(*used);
  pending.assign(rest.begin(), rest.end());
  return {};
}

std::size_t BinaryParser::State::bytes_to_whole() const {
  std::uint64_t whole = kChunkHeaderBytes;  // the signature is as long as a chunk header
  if (pending.size() >= kChunkHeaderBytes) {
    ByteReader head(ByteView(pending).subspan(4));
    whole = chunk_bytes(head.u32());
  }
  return static_cast<std::size_t>(whole - pending.size());
}

Result<std::size_t> BinaryParser::State::parse(ByteView bytes) {
  std::size_t used = 0;
  if (offset == 0) {
    const std::size_t present = std::min(bytes.size(), kSignature.size());
    if (!std::equal(kSignature.begin(), kSignature.begin() + present, bytes.begin()))
      return corrupt("signature is not that of a progressive-strips file");
    if (present < kSignature.size()) return used;
    used = offset = kSignature.size();
  }
  while (used < bytes.size()) {
    if (stage == Stage::end) return corrupt("has bytes after PEND");
    const ByteView left = bytes.subspan(used);
    if (left.size() < kChunkHeaderBytes) break;
    ByteReader head(left, offset);
    ChunkType type{};
    for (char& c : type) c = static_cast<char>(head.u8());
    const std::uint32_t length = head.u32();
    if (!is_chunk_type(type)) return corrupt("chunk type is not four letters");
    if (length > kMaxPayloadBytes) return corrupt("chunk length exceeds 2^31 - 1");
    if (stage == Stage::header && type != kHeaderChunk) return corrupt("first chunk is not PSHD");
    if (stage == Stage::header && length != kHeaderBytes) return corrupt("PSHD is not of 96 bytes");
    const std::uint64_t whole = chunk_bytes(length);
    if (header && whole > header->file_bytes - offset)
      return corrupt("chunk runs past the file size that PSHD declares");
    if (kept_bytes + length > limits.memory_bytes)
      return fail(ErrorCode::over_limit,
                  over_limit_message(kept_bytes + length, "bytes of chunks", limits.memory_bytes),
                  offset);
    if (whole > left.size()) break;

    const ByteView covered = left.first(static_cast<std::size_t>(whole) - 4);
    ByteReader tail(left.subspan(covered.size()));
    if (tail.u32() != chunk_crc(covered)) return corrupt("CRC does not match the chunk");
    if (std::ranges::any_of(covered.subspan(kChunkHeaderBytes + length),
                            [](std::byte b) { return b != std::byte{0}; }))
      return corrupt("padding is not zero");
    if (Result<void> ok = chunk(type, left.subspan(kChunkHeaderBytes, length)); !ok)
      return tl::unexpected<Error>(ok.error());
    kept_bytes += length;
    used += static_cast<std::size_t>(whole);
    offset += whole;
    if (stage == Stage::end && offset != header->file_bytes)
      return corrupt("file is not as long as PSHD declares");
  }
  return used;
}

Result<void> BinaryParser::State::chunk(const ChunkType& type, ByteView payload) {
  if (is_known(type)) {
    ReadIo io(payload, offset + kChunkHeaderBytes, limits.string_bytes);
    return at_offset(known_chunk(type, io), offset);
  }
  if (is_critical(type)) return fail(ErrorCode::unsupported, "critical chunk is not known", offset);
  strips.unknown.push_back({type, Bytes(payload.begin(), payload.end())});
  return {};
}

Result<void> BinaryParser::State::known_chunk(const ChunkType& type, ReadIo& io) {
  const auto in_order = [&](Stage now, Stage after) {
    if (stage > now) return false;
    stage = after;
    return true;
  };
  if (type == kHeaderChunk) {
    if (!in_order(Stage::header, Stage::scene)) return corrupt("PSHD stands twice");
    return read_header(io);
  }
  if (type == kSceneChunk) {
    if (!in_order(Stage::scene, Stage::materials)) return corrupt("chunk is out of order");
    return read_scene(io);
  }
  if (type == kMaterialsChunk) {
    if (!in_order(Stage::materials, Stage::meshes)) return corrupt("chunk is out of order");
    return read_materials(io);
  }
  if (type == kMeshChunk) {
    if (!in_order(Stage::meshes, Stage::meshes)) return corrupt("chunk is out of order");
    return read_mesh(io);
  }
  if (type == kIndexChunk) {
    if (!in_order(Stage::meshes, Stage::bases)) return corrupt("chunk is out of order");
    return read_index(io);
  }
  if (stage < Stage::bases) return corrupt("chunk stands before PIDX");
  if (type == kBaseChunk) {
    if (stage != Stage::bases) return corrupt("chunk is out of order");
    return read_base(io);
  }
  if (stage < Stage::packets) return corrupt("chunk stands before the last BASE");
  if (type == kPacketChunk) {
    if (stage != Stage::packets) return corrupt("chunk is out of order");
    return read_packet(io);
  }
  if (stage < Stage::tail) return corrupt("chunk stands before the last PCKT");
  if (type == kFacesChunk) return read_faces(io);
  if (type == kOrderChunk) return read_order(io);
  if (type == kDigestChunk) return read_digest(io);
  if (type == kImageChunk) return read_image(io);
  if (type == kForeignChunk) return read_foreign(io);
  if (Result<void> ok = finish(io); !ok) return ok;
  return read_end();
}

Result<void> BinaryParser::State::read_header(ReadIo& io) {
  FileHeader h;
  header_fields(io, h);
  if (Result<void> ok = finish(io); !ok) return ok;
  if (h.version_major != 1)
    return fail(ErrorCode::unsupported, "version of the format is not known", offset);
  if (h.profile != 0) return fail(ErrorCode::unsupported, "profile is not known", offset);
  if (h.flags != 0) return fail(ErrorCode::unsupported, "flags are not known", offset);
  struct Claim {
    std::uint64_t figure;
    const char* what;
    std::uint64_t limit;
  };
  for (const auto& [figure, what, limit] :
       {Claim{h.meshes, "meshes", limits.meshes}, Claim{h.vertices, "vertices", limits.vertices},
        Claim{h.wedges, "wedges", limits.wedges},
        Claim{h.map_entries, "index-map entries", limits.corners},
        Claim{h.decoder_memory, "bytes of memory", limits.memory_bytes}})
    if (figure > limit)
      return fail(ErrorCode::over_limit, over_limit_message(figure, what, limit), offset);
  if (h.file_bytes < kSignature.size() + chunk_bytes(kHeaderBytes) || h.base_end > h.file_bytes)
    return corrupt("PSHD contradicts itself on the file's size");
  header = h;
  return {};
}

Result<void> BinaryParser::State::read_scene(ReadIo& io) {
  ProgressiveStrips read;
  scene_fields(io, read);
  if (Result<void> ok = finish(io); !ok) return ok;
  if (read.scene.nodes.size() > limits.meshes)
    return fail(ErrorCode::over_limit, "more nodes than the limit", offset);
  strips.generator = std::move(read.generator);
  strips.scene.nodes = std::move(read.scene.nodes);
  return {};
}

Result<void> BinaryParser::State::read_materials(ReadIo& io) {
  Scene read;
  material_fields(io, read, embedded);
  if (Result<void> ok = finish(io); !ok) return ok;
  if (std::max(read.materials.size(), read.images.size()) > limits.meshes)
    return fail(ErrorCode::over_limit, "more materials or images than the limit", offset);
  strips.scene.materials = std::move(read.materials);
  strips.scene.images = std::move(read.images);
  return {};
}

Result<void> BinaryParser::State::read_mesh(ReadIo& io) {
  if (strips.meshes.size() == header->meshes) return corrupt("more MESH chunks than PSHD declares");
  MeshCounts c;
  ProgressiveMesh mesh;
  mesh_fields(io, mesh, c);
  if (Result<void> ok = finish(io); !ok) return ok;
  mesh.vertices = c.vertices;
  mesh.wedges = c.wedges;
  mesh.triangles = c.triangles;
  mesh.strips = c.strips;
  mesh.base_vertices = c.base_vertices;
  mesh.base_wedges = c.base_wedges;
  strips.meshes.push_back(std::move(mesh));
  counts.push_back(c);
  const auto index = static_cast<Index>(strips.meshes.size() - 1);
  Result<void> ok = check_mesh_header(strips, index, c.map_entries);
  if (ok && c.vsplits != c.vertices - c.base_vertices)
    ok = corrupt("vsplits do not bring the vertices that the base lacks");
  if (!ok) strips.meshes.pop_back();
  return ok;
}

Result<void> BinaryParser::State::read_index(ReadIo& io) {
  const FileHeader& h = *header;
  if (strips.meshes.size() != h.meshes) return corrupt("fewer MESH chunks than PSHD declares");
  FileHeader sums;
  for (const MeshCounts& c : counts) {
    sums.vertices += c.vertices;
    sums.wedges += c.wedges;
    sums.triangles += c.triangles;
    sums.strips += c.strips;
    sums.map_entries += c.map_entries;
    sums.faces += c.faces;
    sums.vsplits += c.vsplits;
  }
  if (sums.vertices != h.vertices || sums.wedges != h.wedges || sums.triangles != h.triangles ||
      sums.strips != h.strips || sums.map_entries != h.map_entries || sums.faces != h.faces ||
      sums.vsplits != h.vsplits)
    return corrupt("totals in PSHD are not the sums over the meshes");
  if (Result<void> ok = check_scene(strips); !ok) return ok;
  index_fields(io, rows);
  if (Result<void> ok = finish(io); !ok) return ok;
  if (rows.size() != std::uint64_t{h.meshes} + h.packets)
    return corrupt("not one index row for each base and packet");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].mesh >= h.meshes || (i < h.meshes && (rows[i].mesh != i || rows[i].vsplits != 0)))
      return corrupt("index row names the wrong mesh");
    const std::uint64_t head = i < h.meshes ? kBaseHeadBytes : kPacketHeadBytes;
    if (rows[i].bytes < chunk_bytes(head) || rows[i].bytes > h.file_bytes ||
        rows[i].offset > h.file_bytes - rows[i].bytes)
      return corrupt("index row points outside the file");
    if (i < h.meshes && rows[i].vertices != counts[i].base_vertices)
      return corrupt("index row contradicts the base it points to");
  }
  packet_array_bytes.resize(h.meshes);
  for (std::size_t i = h.meshes; i < rows.size(); ++i)
    packet_array_bytes[rows[i].mesh] += rows[i].bytes - chunk_bytes(kPacketHeadBytes);
  for (const ProgressiveMesh& mesh : strips.meshes) reached.push_back(first_packet(mesh));
  if (h.meshes == 0) {
    stage = Stage::tail;
    if (offset + chunk_bytes(8) != h.base_end)
      return corrupt("PSHD has the wrong end of the bases");
  }
  return {};
}

const IndexRow* BinaryParser::State::next_row(Index mesh) const {
  const IndexRow& next = rows[row];
  return next.mesh == mesh && next.offset == offset ? &next : nullptr;
}

void BinaryParser::State::reserve(Index index) {
  ProgressiveMesh& mesh = strips.meshes[index];
  // Only what the file's own size can justify, all meshes together.
  const auto reserve_within_budget = [&](auto& list, std::uint64_t n) {
    const std::uint64_t bytes = n * sizeof(list[0]);
    if (bytes > reservable) return;
    reservable -= bytes;
    list.reserve(n);
  };
  const std::uint64_t vsplits = counts[index].vsplits, wedges = mesh.wedges - mesh.base_wedges;
  const std::uint64_t position_bytes = mesh.position.element_bytes();
  reserve_within_budget(mesh.position.data, mesh.vertices * position_bytes);
  std::uint64_t wedge_bytes = sizeof(Index);
  for (Attribute& a : mesh.wedge_attributes) {
    reserve_within_budget(a.data, mesh.wedges * a.element_bytes());
    wedge_bytes += a.element_bytes();
  }
  reserve_within_budget(mesh.vsplits, vsplits);
  reserve_within_budget(mesh.wedge_offset_counts, wedges);
  const bool moves = mesh.placement == Placement::optimal;
  if (moves) reserve_within_budget(mesh.parent_position, vsplits * position_bytes);
  // What is left of the packets is reassigned wedges, few, and map offsets.
  const std::uint64_t fixed =
      vsplits * ((mesh.single_wedges ? 1 : 3) * sizeof(Index) + position_bytes * (moves ? 2 : 1)) +
      wedges * wedge_bytes;
  if (packet_array_bytes[index] > fixed)
    reserve_within_budget(mesh.map_offsets, (packet_array_bytes[index] - fixed) / sizeof(Index));
}

Result<void> BinaryParser::State::read_base(ReadIo& io) {
  BaseHead head;
  base_head_fields(io, head);
  if (io.in().error()) return finish(io);
  const auto index = static_cast<Index>(row);
  if (head.mesh != index) return corrupt("BASE names the wrong mesh");
  ProgressiveMesh& mesh = strips.meshes[index];
  if (head.vertices != mesh.base_vertices || head.wedges != mesh.base_wedges ||
      head.map_entries != counts[index].map_entries)
    return corrupt("BASE contradicts MESH");
  const IndexRow* const announced = next_row(index);
  const std::uint64_t payload = io.in().position() + io.in().remaining();
  if (!announced || announced->bytes != chunk_bytes(payload))
    return corrupt("BASE is not where PIDX says");
  if (row + 1 == strips.meshes.size() && offset + announced->bytes != header->base_end)
    return corrupt("last BASE does not end where PSHD says");
  const std::uint64_t needed = size_of_fields([&](auto& size) {
    base_head_fields(size, head);
    base_array_fields(size, head, mesh);
  });
  if (needed != payload) return corrupt("BASE is not as long as its counts say");

  reserve(index);
  base_array_fields(io, head, mesh);
  Result<void> ok = finish(io);
  if (ok) ok = check_base(strips, index);
  if (!ok) {
    mesh.position.data.clear();
    mesh.base_wedge_vertex.clear();
    for (Attribute& a : mesh.wedge_attributes) a.data.clear();
    mesh.base_map.clear();
    return ok;
  }
  strips.bases.push_back({index, 0, 0, announced->vertices, announced->triangles, announced->strips,
                          announced->error, announced->one_sided_error});
  if (++row < strips.meshes.size()) return {};
  stage = row == rows.size() ? Stage::tail : Stage::packets;
  return {};
}

/// Takes back what a refused packet brought.
void BinaryParser::State::cut_back(Index index) {
  ProgressiveMesh& mesh = strips.meshes[index];
  const PacketStart& to = reached[index];
  mesh.vsplits.resize(to.vsplit);
  mesh.wedge_offset_counts.resize(to.offset_count);
  mesh.reassigned.resize(to.reassigned);
  mesh.map_offsets.resize(to.map_offset);
  mesh.position.data.resize(to.vertices * mesh.position.element_bytes());
  if (mesh.placement == Placement::optimal)
    mesh.parent_position.resize(to.vsplit * mesh.position.element_bytes());
  for (Attribute& a : mesh.wedge_attributes) a.data.resize(to.wedges * a.element_bytes());
}

Result<void> BinaryParser::State::read_packet(ReadIo& io) {
  PacketHead head;
  packet_head_fields(io, head);
  if (io.in().error()) return finish(io);
  if (head.mesh >= strips.meshes.size()) return corrupt("PCKT names a mesh past the end");
  ProgressiveMesh& mesh = strips.meshes[head.mesh];
  const PacketStart start = reached[head.mesh];
  const IndexRow* const announced = next_row(head.mesh);
  const std::uint64_t payload = io.in().position() + io.in().remaining();
  if (!announced || announced->bytes != chunk_bytes(payload))
    return corrupt("PCKT is not where PIDX says");
  if (head.first_vsplit != start.vsplit)
    return corrupt("PCKT does not continue where the one before ends");
  if (head.vsplits != announced->vsplits || head.vsplits > mesh.vertices - start.vertices ||
      head.wedges > mesh.wedges - start.wedges ||
      announced->vertices != start.vertices + head.vsplits)
    return corrupt("PCKT contradicts PIDX or MESH");
  if (mesh.single_wedges && (head.wedges != head.vsplits || head.reassigned != 0))
    return corrupt("single wedges, yet the packet has not one wedge a vsplit");
  const std::uint64_t needed = size_of_fields([&](auto& size) {
    packet_head_fields(size, head);
    packet_array_fields(size, head, mesh, start);
  });
  if (needed != payload) return corrupt("PCKT is not as long as its counts say");

  packet_array_fields(io, head, mesh, start);
  Result<void> ok = finish(io);
  if (ok) {
    std::uint64_t wedges = 0, reassigned = 0;
    std::size_t wedge = start.offset_count;
    for (std::size_t i = start.vsplit; i < mesh.vsplits.size(); ++i) {
      Vsplit& v = mesh.vsplits[i];
      if (mesh.single_wedges) v.wedges = 1;
      wedges += v.wedges;
      reassigned += v.reassigned;
      if (wedges > head.wedges) break;
      std::uint64_t map_offsets = 0;
      for (const std::size_t end = wedge + v.wedges; wedge < end; ++wedge)
        map_offsets += mesh.wedge_offset_counts[wedge];
      v.map_offsets = static_cast<Index>(std::min<std::uint64_t>(map_offsets, kNone));
    }
    if (wedges != head.wedges || reassigned != head.reassigned)
      ok = corrupt("records do not add up to the packet's counts");
  }
  if (ok) {
    const PacketStart end = packet_after(mesh, start, head.vsplits);
    if (end.map_offset - start.map_offset != head.map_offsets)
      ok = corrupt("records do not add up to the packet's counts");
    else
      ok = check_packet(strips, head.mesh, start, end);
    if (ok) reached[head.mesh] = end;
  }
  if (!ok) {
    cut_back(head.mesh);
    return ok;
  }
  strips.packets.push_back({head.mesh, head.first_vsplit, head.vsplits, announced->vertices,
                            announced->triangles, announced->strips, announced->error,
                            announced->one_sided_error});
  if (++row == rows.size()) {
    for (std::size_t m = 0; m < reached.size(); ++m)
      if (reached[m].vertices != strips.meshes[m].vertices ||
          reached[m].wedges != strips.meshes[m].wedges)
        return corrupt("packets do not bring all vertices and wedges");
    stage = Stage::tail;
  }
  return {};
}

bool BinaryParser::State::ascends(std::uint64_t rank) {
  if (rank < tail_rank) return false;
  tail_rank = rank + 1;
  return true;
}

namespace {

// Ranks of tail chunks: three kinds a mesh, then images, then foreign entries.
constexpr std::uint64_t kFirstImageRank = std::uint64_t{1} << 40;
constexpr std::uint64_t kForeignRank = std::uint64_t{1} << 41;
constexpr std::uint64_t mesh_rank(Index mesh, unsigned kind) {
  return std::uint64_t{3} * mesh + kind;
}

}  // namespace

Result<void> BinaryParser::State::read_faces(ReadIo& io) {
  FacesHead head;
  faces_head_fields(io, head);
  if (io.in().error()) return finish(io);
  if (head.mesh >= strips.meshes.size()) return corrupt("fACE names a mesh past the end");
  if (!ascends(mesh_rank(head.mesh, 0))) return corrupt("chunk is out of order");
  ProgressiveMesh& mesh = strips.meshes[head.mesh];
  const MeshCounts& c = counts[head.mesh];
  if (head.replaced > mesh.triangles ||
      std::uint64_t{mesh.triangles} - head.replaced + head.faces != c.faces)
    return corrupt("fACE contradicts the number of faces in MESH");
  FaceTable table;
  table.attributes = mesh.face_attribute_formats;
  const std::uint64_t needed = size_of_fields([&](auto& size) {
    faces_head_fields(size, head);
    faces_array_fields(size, head, std::as_const(table), c.faces);
  });
  if (needed != io.in().position() + io.in().remaining())
    return corrupt("fACE is not as long as its counts say");
  faces_array_fields(io, head, table, c.faces);
  Result<void> ok = finish(io);
  if (!ok) return ok;
  if (table.empty()) return corrupt("fACE says nothing");
  mesh.faces = std::move(table);
  ok = check_faces(strips, head.mesh);
  if (!ok) mesh.faces = {};
  return ok;
}

Result<void> BinaryParser::State::read_order(ReadIo& io) {
  OrderHead head;
  order_head_fields(io, head);
  if (io.in().error()) return finish(io);
  const Index index = head.mesh;
  if (index >= strips.meshes.size()) return corrupt("oRDP names a mesh past the end");
  if (!ascends(mesh_rank(index, 1))) return corrupt("chunk is out of order");
  ProgressiveMesh& mesh = strips.meshes[index];
  if (head.rotation_bits > kMaxRotationBits)
    return corrupt("rotations of an oRDP have more than 8 bits");
  const std::uint64_t needed = size_of_fields([&](auto& size) {
    order_head_fields(size, head);
    order_array_fields(size, head, counts[index], mesh.single_wedges, std::as_const(mesh.order));
  });
  if (needed != io.in().position() + io.in().remaining())
    return corrupt("oRDP is not as long as the counts in MESH say");
  if (face_count(mesh) != counts[index].faces)
    return corrupt("number of faces in MESH needs a fACE chunk");
  order_array_fields(io, head, counts[index], mesh.single_wedges, mesh.order);
  Result<void> ok = finish(io);
  if (ok && head.rotation_bits != rotation_bits(mesh.order.rotation))
    ok = corrupt("rotation_bits of an oRDP is not the least");
  if (ok) ok = check_order(strips, index);
  if (!ok) mesh.order = {};
  return ok;
}

Result<void> BinaryParser::State::read_digest(ReadIo& io) {
  Index index = 0, algorithm = 0;
  io.number(index);
  io.number(algorithm);
  if (io.in().error()) return finish(io);
  if (index >= strips.meshes.size()) return corrupt("dGST names a mesh past the end");
  if (!ascends(mesh_rank(index, 2))) return corrupt("chunk is out of order");
  if (algorithm != kSha256)
    return fail(ErrorCode::unsupported, "digest algorithm is not known", offset);
  if (io.in().remaining() != kDigestBytes) return corrupt("digest is not of 32 bytes");
  io.rest(strips.meshes[index].digest);
  return {};
}

Result<void> BinaryParser::State::read_image(ReadIo& io) {
  Index index = 0;
  Bytes data;
  image_fields(io, index, data);
  if (Result<void> ok = finish(io); !ok) return ok;
  if (index >= embedded.size() || embedded[index] == 0 || data.empty())
    return corrupt("iMGE brings an image that mTRL does not announce");
  if (!ascends(kFirstImageRank + index)) return corrupt("chunk is out of order");
  strips.scene.images[index].data = std::move(data);
  return {};
}

Result<void> BinaryParser::State::read_foreign(ReadIo& io) {
  Foreign foreign;
  foreign_fields(io, foreign);
  if (Result<void> ok = finish(io); !ok) return ok;
  // Foreign entries keep the order of the file: the rank does not rise.
  if (tail_rank > kForeignRank) return corrupt("chunk is out of order");
  tail_rank = kForeignRank;
  strips.scene.foreign.push_back(std::move(foreign));
  return {};
}

Result<void> BinaryParser::State::read_end() {
  for (std::size_t m = 0; m < strips.meshes.size(); ++m) {
    const ProgressiveMesh& mesh = strips.meshes[m];
    if (face_count(mesh) != counts[m].faces ||
        mesh.faces.attributes.size() != mesh.face_attribute_formats.size())
      return corrupt("faces that MESH announces are missing");
  }
  for (std::size_t i = 0; i < embedded.size(); ++i)
    if (embedded[i] != 0 && strips.scene.images[i].data.empty())
      return corrupt("image that mTRL announces is missing");
  stage = Stage::end;
  strips.complete = true;
  return {};
}

BinaryParser::BinaryParser(const Limits& limits, std::uint64_t file_bytes)
    : state_(std::make_unique<State>(limits, file_bytes)) {}
BinaryParser::~BinaryParser() = default;
BinaryParser::BinaryParser(BinaryParser&&) noexcept = default;
BinaryParser& BinaryParser::operator=(BinaryParser&&) noexcept = default;

Result<void> BinaryParser::feed(ByteView bytes) {
  if (!state_->error)
    if (Result<void> ok = state_->feed(bytes); !ok) state_->error = ok.error();
  if (state_->error) return tl::unexpected<Error>(*state_->error);
  return {};
}

const ProgressiveStrips& BinaryParser::strips() const { return state_->strips; }
ProgressiveStrips BinaryParser::take() && { return std::move(state_->strips); }
bool BinaryParser::has_base() const { return state_->stage >= State::Stage::packets; }
bool BinaryParser::complete() const { return state_->stage == State::Stage::end && !state_->error; }
const std::optional<Error>& BinaryParser::error() const { return state_->error; }

std::optional<Error> BinaryParser::end() const {
  if (state_->error || complete()) return state_->error;
  return Error{ErrorCode::truncated, "file ends before PEND", state_->taken};
}

const std::optional<FileHeader>& BinaryParser::header() const { return state_->header; }
std::span<const IndexRow> BinaryParser::index() const { return state_->rows; }
std::uint64_t BinaryParser::bytes_taken() const { return state_->taken; }

Result<ProgressiveStrips> read_binary(ByteView file, const Limits& limits, ReadMode mode) {
  BinaryParser parser(limits, file.size());
  if (const Result<void> ok = parser.feed(file); !ok) return tl::unexpected<Error>(ok.error());
  if (!parser.complete() && (mode == ReadMode::whole || !parser.has_base()))
    return tl::unexpected<Error>(*parser.end());
  return std::move(parser).take();
}

}  // namespace pstrips::inline formats
