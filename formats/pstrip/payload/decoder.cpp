#include "formats/pstrip/payload/decoder.h"

#include <algorithm>

#include "formats/pstrip/payload/extras.h"
#include "formats/pstrip/payload/index_rows.h"
#include "formats/pstrip/payload/records.h"

namespace pstrips::inline formats {

using namespace layout;

namespace {

/// Counts that PIDX leaves out are as if it were right.
Packet level_of(const IndexRow* row, Index mesh, Index vertices) {
  Packet level{.mesh = mesh, .vertices = vertices};
  if (row == nullptr) return level;
  level.triangles = row->triangles;
  level.strips = row->strips;
  level.error = row->error;
  level.one_sided_error = row->one_sided_error;
  return level;
}

}  // namespace

bool PayloadDecoder::decode(const Chunk& chunk) {
  chunk_ = &chunk;
  mesh_ = kNone;
  ReadIo io(chunk, limits_.string_bytes, faults_);
  return read(chunk, io);
}

bool PayloadDecoder::read(const Chunk& chunk, ReadIo& io) {
  struct Read {
    ChunkType type;
    bool (PayloadDecoder::*read)(ReadIo&);
  };
  constexpr Read kReads[] = {
      {kHeaderChunk, &PayloadDecoder::read_header},
      {kSceneChunk, &PayloadDecoder::read_scene},
      {kMaterialsChunk, &PayloadDecoder::read_materials},
      {kMeshChunk, &PayloadDecoder::read_mesh},
      {kIndexChunk, &PayloadDecoder::read_index},
      {kBaseChunk, &PayloadDecoder::read_base},
      {kPacketChunk, &PayloadDecoder::read_packet},
      {kFineChunk, &PayloadDecoder::read_fine},
      {kImageChunk, &PayloadDecoder::read_image},
      {kForeignChunk, &PayloadDecoder::read_foreign},
      {kEndChunk, &PayloadDecoder::read_end},
  };
  if (chunk.type == kFacesChunk && geometry_->codes_faces()) return read_faces(io);
  const auto* const known = std::ranges::find(kReads, chunk.type, &Read::type);
  if (known != std::end(kReads)) return (this->*known->read)(io);
  bool good = true;
  if (visit_extra(chunk.type, [&](auto extra) { good = read_extra(io, extra); })) return good;
  strips_.unknown.push_back({chunk.type, Bytes(chunk.payload.begin(), chunk.payload.end())});
  return true;
}

bool PayloadDecoder::goes_on(Fault fault, std::string text) {
  return faults_.report(fault, {.field = Field::chunk, .element = chunk_->number}, std::move(text));
}

bool PayloadDecoder::refuse(Fault fault, std::string found) {
  goes_on(fault, std::move(found));
  return false;
}

bool PayloadDecoder::within(std::uint64_t figure, const char* what, std::uint64_t limit,
                            const Where& where) {
  if (figure <= limit) return true;
  faults_.report(Fault::over_limit, where, over_limit_message(figure, what, limit));
  return false;
}

bool PayloadDecoder::names_mesh(Index mesh, Fault otherwise) {
  if (mesh >= strips_.meshes.size()) return refuse(otherwise, std::to_string(mesh));
  mesh_ = mesh;
  return true;
}

// ---- PSHD, sCNE, mTRL ----

bool PayloadDecoder::read_header(ReadIo& io) {
  FileHeader h;
  header_fields(io, h);
  if (!io.finish()) return false;
  const auto at = [](std::uint64_t byte) { return Where{.field = Field::header, .element = byte}; };
  const auto unknown = [&](Fault fault, std::uint64_t byte) {
    faults_.report(fault, at(byte), {});
    return false;
  };
  if (h.version_major != 1) return unknown(Fault::version_unknown, 0);
  const std::optional<Profile> profile = profile_numbered(h.profile);
  if (!profile) return unknown(Fault::profile_unknown, 4);
  if (h.flags != 0) return unknown(Fault::flags_unknown, 6);
  if (!within(h.meshes, "meshes", limits_.meshes, at(8)) ||
      !within(h.vertices, "vertices", limits_.vertices, at(16)) ||
      !within(h.wedges, "wedges", limits_.wedges, at(24)) ||
      !within(h.map_entries, "index-map entries", limits_.corners, at(48)) ||
      !within(h.decoder_memory, "bytes of memory", limits_.memory_bytes, at(64)))
    return false;
  if (checks_model() &&
      (h.file_bytes < chunk_->offset + chunk_->bytes() || h.base_end > h.file_bytes))
    return refuse(Fault::file_bytes);
  strips_.profile = *profile;
  geometry_ = make_reader_ ? make_reader_(*profile, h) : codec_of(*profile).reader(h);
  header_ = h;
  return true;
}

bool PayloadDecoder::read_scene(ReadIo& io) {
  ProgressiveStrips read;
  scene_fields(io, read);
  const Where here{.field = Field::chunk, .element = chunk_->number};
  if (!io.finish() || !within(read.scene.nodes.size(), "nodes", limits_.meshes, here)) return false;
  strips_.generator = std::move(read.generator);
  strips_.scene.nodes = std::move(read.scene.nodes);
  strips_.scene.texture_origin = read.scene.texture_origin;
  return true;
}

bool PayloadDecoder::read_materials(ReadIo& io) {
  Scene read;
  material_fields(io, read, embedded_);
  const Where here{.field = Field::chunk, .element = chunk_->number};
  if (!io.finish() || !within(read.materials.size(), "materials", limits_.meshes, here) ||
      !within(read.images.size(), "images", limits_.meshes, here))
    return false;
  strips_.scene.materials = std::move(read.materials);
  strips_.scene.images = std::move(read.images);
  return true;
}

// ---- MESH ----

bool PayloadDecoder::read_mesh(ReadIo& io) {
  ProgressiveMesh& mesh = strips_.meshes.emplace_back();
  MeshCounts& c = counts_.emplace_back();
  mesh_ = static_cast<Index>(strips_.meshes.size() - 1);
  mesh_fields(io, mesh, c, strips_.profile);
  mesh.vertices = c.vertices;
  mesh.wedges = c.wedges;
  mesh.triangles = c.triangles;
  mesh.strips = c.strips;
  mesh.base_vertices = c.base_vertices;
  mesh.base_wedges = c.base_wedges;
  const bool good = io.finish() && check_mesh(c);
  if (!good && checks_model()) {
    strips_.meshes.pop_back();
    counts_.pop_back();
  }
  return good;
}

bool PayloadDecoder::check_mesh(const MeshCounts& counts) {
  const ProgressiveMesh& mesh = strips_.meshes[mesh_];
  // Everything after needs the size of an element.
  if (!check_components(mesh, mesh_, faults_)) return false;
  if (!checks_model()) return true;
  if (!check_mesh_header(strips_, mesh_, counts.map_entries, faults_)) return false;
  return counts.vsplits == counts.vertices - counts.base_vertices || refuse(Fault::vsplit_count);
}

// ---- PIDX ----

bool PayloadDecoder::read_index(ReadIo& io) {
  if (checks_model() &&
      (!holds(fault_of_totals(*header_, counts_)) || !check_scene(strips_, faults_)))
    return false;
  index_fields(io, rows_, strips_.meshes, chunk_->offset + chunk_->bytes());
  if (!io.finish()) return false;
  if (checks_model() && !holds(fault_of_rows(rows_, *header_, *chunk_, codec_of(strips_.profile))))
    return false;
  if (checks_model())
    reservation_ = Reservation(rows_, strips_.meshes.size(),
                               codec_of(strips_.profile).max_expansion() * file_bytes_);
  for (const ProgressiveMesh& mesh : strips_.meshes) reached_.push_back(first_packet(mesh));
  has_index_ = true;
  return true;
}

const IndexRow* PayloadDecoder::row() const {
  const std::size_t i = strips_.bases.size() + strips_.packets.size();
  return i < rows_.size() ? &rows_[i] : nullptr;
}

// ---- BASE ----

bool PayloadDecoder::read_base(ReadIo& io) {
  BaseHead head;
  geometry_->read_head(io, head);
  if (io.failed()) return io.finish();
  const auto index = static_cast<Index>(strips_.bases.size());
  if (head.mesh != index) return refuse(Fault::base_mesh, std::to_string(head.mesh));
  mesh_ = index;
  ProgressiveMesh& mesh = strips_.meshes[index];
  if (!holds(fault_of_base_head(head, mesh, counts_[index]))) return false;
  const IndexRow* const row = this->row();
  if (checks_model()) {
    const bool is_last = index + 1 == strips_.meshes.size();
    if (!holds(fault_of_base_row(row, *chunk_, is_last, header_->base_end))) return false;
    reservation_.reserve(mesh, index, counts_[index].vsplits, codec_of(strips_.profile));
  }
  if (geometry_->read(io, head, mesh) && (!checks_model() || check_base(strips_, index, faults_))) {
    strips_.bases.push_back(level_of(row, index, head.vertices));
    return true;
  }
  clear_base(mesh);
  return false;
}

// ---- PCKT ----

bool PayloadDecoder::read_packet(ReadIo& io) {
  PacketHead head;
  geometry_->read_head(io, head, strips_.meshes);
  if (io.failed()) return io.finish();
  if (!names_mesh(head.mesh, Fault::packet_mesh)) return false;
  ProgressiveMesh& mesh = strips_.meshes[head.mesh];
  const PacketStart start = reached_[head.mesh];
  const IndexRow* const row = this->row();
  if (head.first_vsplit != start.vsplit) return refuse(Fault::packet_not_next);
  if (mesh.single_wedges && (head.wedges != head.vsplits || head.reassigned != 0))
    return refuse(Fault::packet_single_wedges);
  if (checks_model() && !holds(fault_of_packet_row(row, *chunk_, head, mesh, start))) return false;
  if (geometry_->read(io, head, mesh, start) && holds(complete_records(mesh, head, start))) {
    const PacketStart end = packet_after(mesh, start, head.vsplits);
    if (!checks_model() || check_packet(strips_, head.mesh, start, end, faults_)) {
      Packet packet = level_of(row, head.mesh, start.vertices + head.vsplits);
      packet.first_vsplit = head.first_vsplit;
      packet.vsplits = head.vsplits;
      strips_.packets.push_back(packet);
      reached_[head.mesh] = end;
      const bool is_last = strips_.packets.size() == header_->packets;
      return !checks_model() || !is_last || holds(fault_of_ends(reached_, strips_.meshes));
    }
  }
  cut_back(mesh, start);
  return false;
}

// ---- FINE ----

bool PayloadDecoder::is_in_order(const ChunkType& type, Index mesh) {
  const auto kind = find_kind(type) - std::begin(kChunkKinds);
  const std::int64_t number = std::int64_t{mesh} * std::ssize(kChunkKinds) + kind;
  if (number <= extra_) return refuse(Fault::tail_order);
  extra_ = number;
  return true;
}

bool PayloadDecoder::read_fine(ReadIo& io) {
  Index mesh = 0;
  io.number(mesh);
  if (io.failed()) return io.finish();
  if (!names_mesh(mesh, Fault::fine_mesh) || !is_in_order(kFineChunk, mesh)) return false;
  if (!geometry_->needs_fine(mesh)) return refuse(Fault::fine_needed);
  if (!geometry_->read_fine(io, mesh, strips_.meshes[mesh])) return false;
  fine_.push_back(mesh);
  return true;
}

// ---- What strips cannot say ----

bool PayloadDecoder::read_faces(ReadIo& io) {
  Index number = 0;
  io.varint(number, 32);
  if (io.failed()) return io.finish();
  if (!names_mesh(number, Fault::faces_mesh) || !is_in_order(kFacesChunk, number)) return false;
  ProgressiveMesh& mesh = strips_.meshes[number];
  const Index faces = counts_[number].faces;
  FacesPayload::prepare(mesh);
  const bool good = geometry_->read_faces(io, faces, mesh) &&
                    (!mesh.faces.empty() || goes_on(Fault::faces_empty)) &&
                    (!checks_model() || (check_faces(strips_, number, faults_) &&
                                         (face_count(mesh) == faces || refuse(Fault::face_count))));
  if (!good) FacesPayload::clear(mesh);
  return good;
}

template <class Extra>
bool PayloadDecoder::read_extra(ReadIo& io, Extra extra) {
  typename Extra::Head head;
  Extra::head_fields(io, head);
  if (io.failed()) return io.finish();
  if (!names_mesh(head.mesh, Extra::kNoSuchMesh)) return false;
  if (!is_in_order(Extra::kType, head.mesh)) return false;
  if (auto [fault, found] = Extra::broken_head(head); fault != Fault::none)
    return refuse(fault, std::move(found));
  ProgressiveMesh& mesh = strips_.meshes[head.mesh];
  const MeshCounts& counts = counts_[head.mesh];
  if (checks_model())
    if (const Fault fault = Extra::contradiction(head, mesh, counts); fault != Fault::none)
      return refuse(fault);
  Extra::prepare(mesh);
  const auto take_body = [&] {
    const Fault length = Extra::broken_length(head, mesh, counts, io.payload_bytes());
    if (length != Fault::none) return refuse(length);
    if (!io.expect([&](SizeIo& size) { extra_fields(size, extra, head, counts, mesh); }))
      return false;
    Extra::body_fields(io, head, counts, mesh);
    if (!io.finish()) return false;
    if (auto [fault, found] = Extra::broken_body(head, mesh);
        fault != Fault::none && !goes_on(fault, std::move(found)))
      return false;
    return !checks_model() || Extra::check(strips_, head.mesh, faults_);
  };
  const bool good = take_body();
  if (!good) Extra::clear(mesh);
  return good;
}

// ---- iMGE, fRGN, PEND ----

bool PayloadDecoder::read_image(ReadIo& io) {
  Index image = 0;
  Bytes data;
  image_fields(io, image, data);
  if (!io.finish()) return false;
  if (image >= embedded_.size() || embedded_[image] == 0 || data.empty())
    return refuse(Fault::image_data, std::to_string(image));
  if (image <= image_) return refuse(Fault::tail_order);
  image_ = image;
  strips_.scene.images[image].data = std::move(data);
  return true;
}

bool PayloadDecoder::read_foreign(ReadIo& io) {
  Foreign foreign;
  foreign_fields(io, foreign);
  if (!io.finish()) return false;
  strips_.scene.foreign.push_back(std::move(foreign));
  return true;
}

bool PayloadDecoder::read_end(ReadIo& io) {
  if (io.payload_bytes() != 0 && !goes_on(Fault::end_payload)) return false;
  for (Index m = 0; m < strips_.meshes.size(); ++m)
    if (geometry_->needs_fine(m) && !std::ranges::binary_search(fine_, m))
      return refuse(Fault::fine_needed);
  if (checks_model()) {
    if (!holds(fault_of_ends(reached_, strips_.meshes))) return false;
    if (!holds(fault_of_end(strips_, counts_, embedded_))) return false;
  }
  strips_.complete = true;
  return true;
}

}  // namespace pstrips::inline formats
