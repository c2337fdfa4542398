#include <algorithm>

#include "validators/document.h"
#include "validators/locate.h"
#include "validators/probe.h"

namespace pstrips::inline validators {
namespace {

using namespace layout;

/// Where a chunk may stand. Chunks of one rank may mix; a lower rank never follows a higher one.
/// [spec/container.md §3]
struct Rank {
  ChunkType type;
  int rank;
  bool once;
};
constexpr Rank kRanks[] = {
    {kHeaderChunk, 0, true},  {kSceneChunk, 1, true},  {kMaterialsChunk, 2, true},
    {kMeshChunk, 3, false},   {kIndexChunk, 4, true},  {kBaseChunk, 5, false},
    {kPacketChunk, 6, false}, {kFacesChunk, 7, false}, {kOrderChunk, 7, false},
    {kDigestChunk, 7, false}, {kImageChunk, 8, false}, {kForeignChunk, 9, false},
    {kEndChunk, 10, true},
};
constexpr int kIndexRank = 4, kPacketRank = 6, kTailRank = 7;

Where at_byte(std::uint64_t offset) { return {.field = Field::file, .element = offset}; }
Where at_chunk(std::size_t chunk) { return {.field = Field::chunk, .element = chunk}; }

class Opener {
 public:
  Opener(Document& doc, const Limits& limits) : doc_(doc), limits_(limits) {}

  void open() {
    if (!list_chunks()) return;
    doc_.depth = Depth::payloads;
    if (!read_payloads()) return;
    doc_.depth = Depth::model;
  }

 private:
  void fault(Fault fault, const Where& where, std::string found = {}) {
    doc_.faults.add(fault, where, std::move(found));
  }

  // ---- Frame ----

  /// False when the frame is broken in a way that leaves the payloads without meaning.
  bool list_chunks() {
    doc_.frame = read_chunks(doc_.file);
    const std::vector<Chunk>& chunks = doc_.frame.chunks;
    const auto end = std::ranges::find(chunks, kEndChunk, &Chunk::type);
    bool sound = true;
    if (end != chunks.end()) {
      const std::uint64_t after = end->offset + end->bytes();
      if (after != doc_.file.size()) fault(Fault::bytes_after_end, at_byte(after));
      doc_.frame.chunks.erase(end + 1, chunks.end());
    } else if (doc_.frame.error && doc_.frame.error->code != ErrorCode::truncated) {
      fault(broken_frame(), at_byte(doc_.frame.end));
      sound = false;
    } else {
      doc_.ended_early = true;
      fault(runs_past_file_bytes() ? Fault::past_file_bytes : Fault::truncated,
            at_byte(doc_.frame.end));
    }
    for (const Chunk& chunk : chunks) {
      if (!chunk.crc_ok()) fault(Fault::chunk_crc, at_chunk(number_of(chunk)));
      if (!chunk.padding_is_zero) fault(Fault::chunk_padding, at_chunk(number_of(chunk)));
      if (!is_known(chunk.type) && is_critical(chunk.type)) {
        fault(Fault::critical_chunk_unknown, at_chunk(number_of(chunk)));
        sound = false;
      }
    }
    return sound && order_holds();
  }

  Fault broken_frame() const {
    if (doc_.frame.end < kSignature.size()) return Fault::signature;
    ChunkType type{};
    ByteReader in(doc_.file.subspan(static_cast<std::size_t>(doc_.frame.end)));
    for (char& c : type) c = static_cast<char>(in.u8());
    if (is_chunk_type(type)) return Fault::chunk_length;
    type[2] = static_cast<char>(type[2] & ~0x20);
    return is_chunk_type(type) ? Fault::type_third_letter : Fault::type_not_letters;
  }

  /// The unfinished chunk announces more than the size in PSHD leaves for it.
  bool runs_past_file_bytes() const {
    const std::vector<Chunk>& chunks = doc_.frame.chunks;
    if (chunks.empty() || chunks[0].type != kHeaderChunk ||
        chunks[0].payload.size() != kHeaderBytes)
      return false;
    FileHeader header;
    ReadIo io(chunks[0].payload, chunks[0].payload_offset(), 0);
    header_fields(io, header);
    ByteReader in(doc_.file.subspan(static_cast<std::size_t>(doc_.frame.end)));
    in.u32();
    const std::uint64_t bytes = chunk_bytes(in.u32());
    return !in.error() && doc_.frame.end + bytes > header.file_bytes;
  }

  std::size_t number_of(const Chunk& chunk) const {
    return static_cast<std::size_t>(&chunk - doc_.frame.chunks.data());
  }

  bool order_holds() {
    int rank = -1;
    std::vector<ChunkType> seen;
    for (const Chunk& chunk : doc_.frame.chunks) {
      const Where where = at_chunk(number_of(chunk));
      const auto broken = [&](Fault kind) {
        fault(kind, where);
        return false;
      };
      if (number_of(chunk) == 0 && chunk.type != kHeaderChunk) return broken(Fault::first_chunk);
      const auto* const known = std::ranges::find(kRanks, chunk.type, &Rank::type);
      if (known == std::end(kRanks)) continue;
      if (known->once && std::ranges::find(seen, chunk.type) != seen.end())
        return broken(Fault::chunk_twice);
      if (known->rank < rank) return broken(Fault::chunk_order);
      if (known->rank > kIndexRank && rank < kIndexRank) return broken(Fault::index_missing);
      rank = known->rank;
      seen.push_back(chunk.type);
    }
    return true;
  }

  // ---- Payloads ----

  bool read_payloads() {
    for (std::size_t i = 0; i < doc_.frame.chunks.size(); ++i) {
      chunk_ = static_cast<Index>(i);
      const Chunk& chunk = doc_.frame.chunks[i];
      if (!counts_complete(chunk)) return false;
      ProbeIo io(chunk, limits_, doc_.faults);
      if (!read_payload(chunk, io) || !io.finish()) return false;
    }
    return true;
  }

  /// The chunks of which there is one a mesh or packet are all there before what follows them.
  bool counts_complete(const Chunk& chunk) {
    const auto* const found = std::ranges::find(kRanks, chunk.type, &Rank::type);
    if (found == std::end(kRanks) || !doc_.header) return true;
    const auto fewer = [&](Fault kind, std::size_t there, std::size_t wanted) {
      fault(kind, at_chunk(chunk_), counted(there, wanted));
      return false;
    };
    const std::size_t meshes = doc_.strips.meshes.size(), bases = doc_.strips.bases.size();
    if (found->rank >= kIndexRank && meshes < doc_.header->meshes)
      return fewer(Fault::mesh_chunks, meshes, doc_.header->meshes);
    if (found->rank >= kPacketRank && bases < meshes)
      return fewer(Fault::base_chunks, bases, meshes);
    if (found->rank >= kTailRank && doc_.strips.packets.size() < doc_.header->packets)
      return fewer(Fault::packet_chunks, doc_.strips.packets.size(), doc_.header->packets);
    return true;
  }

  static std::string counted(std::size_t there, std::size_t wanted) {
    return std::to_string(there) + " of " + std::to_string(wanted);
  }

  bool read_payload(const Chunk& chunk, ProbeIo& io) {
    if (chunk.type == kHeaderChunk) return read_header(chunk, io);
    if (chunk.type == kSceneChunk) {
      scene_fields(io, doc_.strips);
    } else if (chunk.type == kMaterialsChunk) {
      std::vector<std::uint8_t> embedded;
      material_fields(io, doc_.strips.scene, embedded);
      doc_.image_embedded.assign(embedded.begin(), embedded.end());
    } else if (chunk.type == kMeshChunk) {
      return read_mesh(io);
    } else if (chunk.type == kIndexChunk) {
      index_fields(io, doc_.index);
    } else if (chunk.type == kBaseChunk) {
      return read_base(io);
    } else if (chunk.type == kPacketChunk) {
      return read_packet(io);
    } else if (chunk.type == kFacesChunk) {
      return read_faces(io);
    } else if (chunk.type == kOrderChunk) {
      return read_order(io);
    } else if (chunk.type == kDigestChunk) {
      return read_digest(io);
    } else if (chunk.type == kImageChunk) {
      return read_image(io);
    } else if (chunk.type == kForeignChunk) {
      foreign_fields(io, doc_.strips.scene.foreign.emplace_back());
    } else if (chunk.type == kEndChunk) {
      if (!chunk.payload.empty()) fault(Fault::end_payload, at_chunk(chunk_));
      io.skip_rest();
    } else {
      doc_.strips.unknown.push_back(
          {chunk.type, Bytes(chunk.payload.begin(), chunk.payload.end())});
      io.skip_rest();
    }
    return true;
  }

  bool read_header(const Chunk& chunk, ProbeIo& io) {
    FileHeader h;
    header_fields(io, h);
    if (io.failed() || chunk.payload.size() != kHeaderBytes) return io.finish();
    doc_.header = h;
    const auto at = [](std::uint64_t byte) {
      return Where{.field = Field::header, .element = byte};
    };
    const auto answer = [&](Fault kind, std::uint64_t byte, const char* what) {
      fault(kind, at(byte), what);
      return false;
    };
    if (h.version_major != 1) return answer(Fault::version_unknown, 0, "");
    if (h.profile != 0) return answer(Fault::profile_unknown, 4, "");
    if (h.flags != 0) return answer(Fault::flags_unknown, 6, "");
    if (h.meshes > limits_.meshes) return answer(Fault::over_limit, 8, "meshes");
    if (h.vertices > limits_.vertices) return answer(Fault::over_limit, 16, "vertices");
    if (h.wedges > limits_.wedges) return answer(Fault::over_limit, 24, "wedges");
    if (h.map_entries > limits_.corners) return answer(Fault::over_limit, 48, "index-map entries");
    if (h.decoder_memory > limits_.memory_bytes) return answer(Fault::over_limit, 64, "memory");
    return true;
  }

  bool read_mesh(ProbeIo& io) {
    const auto m = static_cast<Index>(doc_.strips.meshes.size());
    if (m == doc_.header->meshes) {
      fault(Fault::mesh_chunks, at_chunk(chunk_), "more than " + std::to_string(m));
      return false;
    }
    ProgressiveMesh& mesh = doc_.strips.meshes.emplace_back();
    MeshCounts& counts = doc_.declared.emplace_back();
    doc_.packets_of.emplace_back();
    doc_.mesh_chunks.emplace_back().mesh = chunk_;
    mesh_fields(io, mesh, counts);
    if (io.failed()) return io.finish();
    mesh.vertices = counts.vertices;
    mesh.wedges = counts.wedges;
    mesh.triangles = counts.triangles;
    mesh.strips = counts.strips;
    mesh.base_vertices = counts.base_vertices;
    mesh.base_wedges = counts.base_wedges;
    mesh.faces.attributes = mesh.face_attribute_formats;
    // Everything after needs the size of an element.
    const auto empty = [](const Attribute& a) { return a.count == 0; };
    const auto undefined = [&](Field field, std::size_t element) {
      fault(Fault::no_components, {.field = field, .mesh = m, .element = element});
      return false;
    };
    if (empty(mesh.position)) return undefined(Field::position_format, 0);
    for (std::size_t i = 0; i < mesh.wedge_attributes.size(); ++i)
      if (empty(mesh.wedge_attributes[i])) return undefined(Field::wedge_format, i);
    for (std::size_t i = 0; i < mesh.face_attribute_formats.size(); ++i)
      if (empty(mesh.face_attribute_formats[i])) return undefined(Field::face_format, i);
    return true;
  }

  bool read_base(ProbeIo& io) {
    BaseHead head;
    base_head_fields(io, head);
    if (io.failed()) return io.finish();
    const auto m = static_cast<Index>(doc_.strips.bases.size());
    if (m >= doc_.strips.meshes.size()) {
      fault(Fault::base_chunks, at_chunk(chunk_), "more than " + std::to_string(m));
      return false;
    }
    if (head.mesh != m) {
      fault(Fault::base_mesh, at_chunk(chunk_), std::to_string(head.mesh));
      return false;
    }
    ProgressiveMesh& mesh = doc_.strips.meshes[m];
    doc_.mesh_chunks[m].base = chunk_;
    if (head.vertices != mesh.base_vertices || head.wedges != mesh.base_wedges ||
        head.map_entries != doc_.declared[m].map_entries) {
      fault(Fault::base_counts, {.field = Field::base, .mesh = m});
      return false;
    }
    if (!io.expect([&](auto& size) {
          base_head_fields(size, head);
          base_array_fields(size, head, mesh);
        }))
      return io.finish();
    base_array_fields(io, head, mesh);
    doc_.strips.bases.push_back(reached_of(m, doc_.strips.bases.size(), head.vertices));
    starts_.push_back(first_packet(mesh));
    return true;
  }

  /// What PIDX says of the chunk; counts it leaves out are as if it were right.
  Packet reached_of(Index mesh, std::size_t row, Index vertices) const {
    Packet packet{.mesh = mesh, .vertices = vertices};
    if (row >= doc_.index.size()) return packet;
    const IndexRow& r = doc_.index[row];
    packet.vertices = r.vertices;
    packet.triangles = r.triangles;
    packet.strips = r.strips;
    packet.error = r.error;
    packet.one_sided_error = r.one_sided_error;
    return packet;
  }

  bool read_packet(ProbeIo& io) {
    PacketHead head;
    packet_head_fields(io, head);
    if (io.failed()) return io.finish();
    if (doc_.strips.packets.size() == doc_.header->packets) {
      fault(Fault::packet_chunks, at_chunk(chunk_),
            "more than " + std::to_string(doc_.header->packets));
      return false;
    }
    if (!names_mesh(head.mesh, Fault::packet_mesh)) return false;
    ProgressiveMesh& mesh = doc_.strips.meshes[head.mesh];
    PacketStart& start = starts_[head.mesh];
    const auto number = static_cast<Index>(doc_.packets_of[head.mesh].size());
    const Where where{.field = Field::packet, .mesh = head.mesh, .packet = number};
    doc_.mesh_chunks[head.mesh].packets.push_back(chunk_);
    doc_.packets_of[head.mesh].push_back(static_cast<Index>(doc_.strips.packets.size()));
    if (head.first_vsplit != start.vsplit) {
      fault(Fault::packet_not_next, where);
      return false;
    }
    if (mesh.single_wedges && (head.wedges != head.vsplits || head.reassigned != 0)) {
      fault(Fault::packet_single_wedges, where);
      return false;
    }
    if (!io.expect([&](auto& size) {
          packet_head_fields(size, head);
          packet_array_fields(size, head, mesh, start);
        }))
      return io.finish();
    packet_array_fields(io, head, mesh, start);
    if (io.failed()) return io.finish();
    if (!add_up(mesh, head, start, where)) return false;
    const std::size_t row = doc_.strips.bases.size() + doc_.strips.packets.size();
    Packet packet = reached_of(head.mesh, row, static_cast<Index>(start.vertices) + head.vsplits);
    packet.first_vsplit = head.first_vsplit;
    packet.vsplits = head.vsplits;
    doc_.strips.packets.push_back(packet);
    start = packet_after(mesh, start, head.vsplits);
    return true;
  }

  /// Completes the records from the packet's columns and compares their sums with its head.
  bool add_up(ProgressiveMesh& mesh, const PacketHead& head, const PacketStart& start,
              const Where& where) {
    std::uint64_t wedges = 0, reassigned = 0, map_offsets = 0;
    std::size_t list = start.offset_count;
    for (std::size_t i = start.vsplit; i < mesh.vsplits.size() && wedges <= head.wedges; ++i) {
      Vsplit& split = mesh.vsplits[i];
      if (mesh.single_wedges) split.wedges = 1;
      wedges += split.wedges;
      reassigned += split.reassigned;
      if (wedges > head.wedges) break;
      std::uint64_t of_record = 0;
      for (const std::size_t end = list + split.wedges; list < end; ++list)
        of_record += mesh.wedge_offset_counts[list];
      map_offsets += of_record;
      split.map_offsets = static_cast<Index>(std::min<std::uint64_t>(of_record, kNone));
    }
    if (wedges != head.wedges || reassigned != head.reassigned) {
      fault(Fault::packet_wedges, where);
      return false;
    }
    if (map_offsets != head.map_offsets) fault(Fault::packet_offsets, where);
    return map_offsets == head.map_offsets;
  }

  bool names_mesh(Index mesh, Fault otherwise) {
    if (mesh < doc_.strips.meshes.size()) return true;
    fault(otherwise, at_chunk(chunk_), std::to_string(mesh));
    return false;
  }

  /// Tail chunks ascend by mesh, then in the order fACE, oRDP, dGST.
  bool takes_tail(Index MeshChunks::*kind, Index mesh, int rank) {
    const std::int64_t now = std::int64_t{mesh} * 3 + rank;
    if (now <= tail_) {
      fault(Fault::tail_order, at_chunk(chunk_));
      return false;
    }
    tail_ = now;
    doc_.mesh_chunks[mesh].*kind = chunk_;
    return true;
  }

  bool read_faces(ProbeIo& io) {
    FacesHead head;
    faces_head_fields(io, head);
    if (io.failed()) return io.finish();
    if (!names_mesh(head.mesh, Fault::faces_mesh)) return false;
    if (!takes_tail(&MeshChunks::faces, head.mesh, 0)) return false;
    FaceTable& table = doc_.strips.meshes[head.mesh].faces;
    const Index faces = doc_.declared[head.mesh].faces;
    const auto fields = [&](auto& size, const FaceTable& t) {
      faces_head_fields(size, head);
      faces_array_fields(size, head, t, faces);
    };
    const auto bytes_with = [&](const FaceTable& t) {
      return size_of_fields([&](auto& size) { fields(size, t); });
    };
    // The lists are all there: it is the attributes that do not fit the faces.
    if (!table.attributes.empty() && io.payload_bytes() >= bytes_with(FaceTable{}) &&
        io.payload_bytes() != bytes_with(table)) {
      fault(Fault::face_elements, at_chunk(chunk_));
      return false;
    }
    if (!io.expect([&](auto& size) { fields(size, table); })) return io.finish();
    faces_array_fields(io, head, table, faces);
    if (table.empty()) fault(Fault::faces_empty, at_chunk(chunk_));
    return true;
  }

  bool read_order(ProbeIo& io) {
    OrderHead head;
    order_head_fields(io, head);
    if (io.failed()) return io.finish();
    const Index m = head.mesh;
    if (!names_mesh(m, Fault::order_mesh)) return false;
    if (!takes_tail(&MeshChunks::order, m, 1)) return false;
    ProgressiveMesh& mesh = doc_.strips.meshes[m];
    const MeshCounts& counts = doc_.declared[m];
    const auto fault_in_bits = [&] {
      fault(Fault::order_rotation_bits, at_chunk(chunk_), std::to_string(head.rotation_bits));
    };
    if (head.rotation_bits > kMaxRotationBits) {
      fault_in_bits();
      return false;
    }
    if (!io.expect([&](auto& size) {
          order_head_fields(size, head);
          order_array_fields(size, head, counts, mesh.single_wedges, std::as_const(mesh.order));
        }))
      return io.finish();
    order_array_fields(io, head, counts, mesh.single_wedges, mesh.order);
    if (head.rotation_bits != rotation_bits(mesh.order.rotation)) fault_in_bits();
    return true;
  }

  bool read_digest(ProbeIo& io) {
    Index m = 0, algorithm = 0;
    io.number(m);
    io.number(algorithm);
    if (io.failed()) return io.finish();
    if (!names_mesh(m, Fault::digest_mesh)) return false;
    if (!takes_tail(&MeshChunks::digest, m, 2)) return false;
    if (algorithm != kSha256) {
      fault(Fault::digest_unknown, at_chunk(chunk_), std::to_string(algorithm));
      return false;
    }
    io.run(doc_.strips.meshes[m].digest, 1, 0, kDigestBytes);
    return true;
  }

  bool read_image(ProbeIo& io) {
    Index number = 0;
    Bytes data;
    image_fields(io, number, data);
    if (io.failed()) return io.finish();
    const std::vector<bool>& embedded = doc_.image_embedded;
    if (number >= embedded.size() || !embedded[number] || data.empty()) {
      fault(Fault::image_data, at_chunk(chunk_), std::to_string(number));
      return false;
    }
    if (number <= image_) {
      fault(Fault::tail_order, at_chunk(chunk_));
      return false;
    }
    image_ = number;
    doc_.strips.scene.images[number].data = std::move(data);
    return true;
  }

  Document& doc_;
  const Limits& limits_;
  Index chunk_ = 0;                  // the one being read
  std::vector<PacketStart> starts_;  // of each mesh, where its next packet starts
  std::int64_t tail_ = -1, image_ = -1;
};

}  // namespace

Document open_binary(ByteView file, const Limits& limits) {
  Document doc;
  doc.file = file;
  Opener(doc, limits).open();
  doc.strips.complete = !doc.ended_early;
  doc.locate = [](const Document& d, const Where& where) { return locate_binary(d, where); };
  return doc;
}

}  // namespace pstrips::inline validators
