#include "formats/pstrip/payload/encoder.h"

#include <algorithm>

#include "formats/pstrip/payload/extras.h"
#include "formats/pstrip/payload/index_rows.h"

namespace pstrips::inline formats {

using namespace layout;

namespace {

IndexRow row_of(const Packet& packet) {
  return {.mesh = packet.mesh,
          .vsplits = packet.vsplits,
          .vertices = packet.vertices,
          .triangles = packet.triangles,
          .strips = packet.strips,
          .error = packet.error,
          .one_sided_error = packet.one_sided_error};
}

}  // namespace

Result<PayloadEncoder> PayloadEncoder::start(const ProgressiveStrips& strips) {
  auto geometry = layout_of(strips.profile).writer(strips);
  if (!geometry) return tl::unexpected<Error>(geometry.error());
  return PayloadEncoder(strips, std::move(*geometry));
}

PayloadEncoder::PayloadEncoder(const ProgressiveStrips& strips,
                               std::unique_ptr<GeometryWriter> geometry)
    : strips_(strips), geometry_(std::move(geometry)) {
  for (const Image& image : strips.scene.images) embedded_.push_back(image.data.empty() ? 0 : 1);
  for (const BaseLevel& base : strips.bases) rows_.push_back(row_of(base));
  for (const Packet& packet : strips.packets) rows_.push_back(row_of(packet));
  size_rows();
  plan_chunks();
  sum_totals();
  fill_index();
}

// As if the first chunk of a row stood at 0.
void PayloadEncoder::size_rows() {
  std::uint64_t offset = 0;
  const std::size_t bases = strips_.bases.size();
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const std::uint64_t payload = i < bases ? geometry_->base_bytes(static_cast<Index>(i))
                                            : geometry_->packet_bytes(i - bases);
    rows_[i].offset = offset;
    rows_[i].bytes = static_cast<std::uint32_t>(chunk_bytes(payload));
    offset += rows_[i].bytes;
  }
}

void PayloadEncoder::plan_chunks() {
  for (const auto* kind = std::begin(kChunkKinds); kind != std::end(kChunkKinds);) {
    if (kind->type == kEndChunk)
      for (std::size_t i = 0; i < strips_.unknown.size(); ++i) plan(strips_.unknown[i].type, i);
    // Those of one rank stand element by element.
    const auto* const end = std::find_if(kind, std::end(kChunkKinds),
                                         [&](const ChunkKind& k) { return k.rank != kind->rank; });
    for (std::size_t element = 0; element < elements(kind->of); ++element)
      for (const auto* k = kind; k != end; ++k)
        if (is_needed(k->type, element)) plan(k->type, element);
    kind = end;
  }
}

void PayloadEncoder::plan(const ChunkType& type, std::size_t element) {
  const std::uint64_t offset =
      chunks_.empty() ? kSignature.size() : chunks_.back().offset + chunks_.back().bytes();
  PlannedChunk chunk{type, element, offset};
  if (type == kBaseChunk) {
    chunk.payload = geometry_->base_bytes(static_cast<Index>(element));
  } else if (type == kPacketChunk) {
    chunk.payload = geometry_->packet_bytes(element);
  } else if (type == kFineChunk) {
    chunk.payload = geometry_->fine_bytes(static_cast<Index>(element));
  } else if (const Bytes* const faces = coded_faces(type, element)) {
    chunk.payload = faces->size();
  } else {
    SizeIo size;
    fields(size, chunk);
    chunk.payload = size.size();
  }
  chunks_.push_back(chunk);
}

const Bytes* PayloadEncoder::coded_faces(const ChunkType& type, std::size_t element) const {
  return type == kFacesChunk ? geometry_->coded_faces(static_cast<Index>(element)) : nullptr;
}

std::size_t PayloadEncoder::elements(ChunkOf of) const {
  switch (of) {
    case ChunkOf::file:
      return 1;
    case ChunkOf::mesh:
      return strips_.meshes.size();
    case ChunkOf::packet:
      return strips_.packets.size();
    case ChunkOf::image:
      return strips_.scene.images.size();
    case ChunkOf::entry:
      return strips_.scene.foreign.size();
  }
  return 0;
}

bool PayloadEncoder::is_needed(const ChunkType& type, std::size_t element) const {
  if (type == kSceneChunk) return has_scene_fields(strips_);
  if (type == kMaterialsChunk) return has_materials(strips_.scene);
  if (type == kImageChunk) return embedded_[element] != 0;
  if (type == kFineChunk) return geometry_->fine_bytes(static_cast<Index>(element)) != 0;
  bool needed = true;
  visit_extra(type, [&](auto extra) { needed = extra.is_needed(strips_.meshes[element]); });
  return needed;
}

void PayloadEncoder::sum_totals() {
  header_.profile = static_cast<std::uint8_t>(strips_.profile);
  header_.meshes = static_cast<std::uint32_t>(strips_.meshes.size());
  header_.packets = static_cast<std::uint32_t>(strips_.packets.size());
  std::vector<MeshCounts> counts;
  for (const ProgressiveMesh& mesh : strips_.meshes) counts.push_back(counts_of(mesh));
  for (const Total& total : kTotals) header_.*total.total = sum_of(total, counts);
}

void PayloadEncoder::fill_index() {
  std::uint64_t largest = 0;
  std::size_t row = 0;
  for (const PlannedChunk& chunk : chunks_) {
    const std::uint64_t end = chunk.offset + chunk.bytes();
    if (chunk.type == kIndexChunk || chunk.type == kBaseChunk) header_.base_end = end;
    if (chunk.type != kBaseChunk && chunk.type != kPacketChunk) continue;
    largest = std::max(largest, chunk.bytes());
    rows_[row++].offset = chunk.offset;
  }
  header_.file_bytes = chunks_.back().offset + chunks_.back().bytes();
  header_.decoder_memory = decoder_memory(strips_.meshes, largest);
  header_.conformance = conformance_level(header_);
}

template <class Io>
void PayloadEncoder::fields(Io& io, const PlannedChunk& chunk) const {
  const std::size_t i = chunk.element;
  const Scene& scene = strips_.scene;
  if (chunk.type == kHeaderChunk) return header_fields(io, header_);
  if (chunk.type == kSceneChunk) return scene_fields(io, strips_);
  if (chunk.type == kMaterialsChunk) return material_fields(io, scene, embedded_);
  if (chunk.type == kMeshChunk) {
    const MeshCounts counts = counts_of(strips_.meshes[i]);
    return mesh_fields(io, strips_.meshes[i], counts, strips_.profile);
  }
  if (chunk.type == kIndexChunk)
    return index_fields(io, rows_, strips_.meshes, rows_.empty() ? 0 : rows_.front().offset);
  if (chunk.type == kImageChunk) {
    const auto image = static_cast<Index>(i);
    return image_fields(io, image, scene.images[i].data);
  }
  if (chunk.type == kForeignChunk) return foreign_fields(io, scene.foreign[i]);
  if (chunk.type == kEndChunk) return;
  const bool is_extra = visit_extra(chunk.type, [&](auto extra) {
    const ProgressiveMesh& mesh = strips_.meshes[i];
    const auto head = extra.head_of(mesh, static_cast<Index>(i));
    extra_fields(io, extra, head, counts_of(mesh), mesh);
  });
  if (!is_extra) io.rest(strips_.unknown[i].payload);
}

void PayloadEncoder::write(const PlannedChunk& chunk, std::span<std::byte> payload) const {
  if (chunk.type == kBaseChunk)
    return geometry_->write_base(static_cast<Index>(chunk.element), payload);
  if (chunk.type == kPacketChunk) return geometry_->write_packet(chunk.element, payload);
  if (chunk.type == kFineChunk)
    return geometry_->write_fine(static_cast<Index>(chunk.element), payload);
  WriteIo io(payload);
  if (const Bytes* const faces = coded_faces(chunk.type, chunk.element))
    io.rest(*faces);
  else
    fields(io, chunk);
}

}  // namespace pstrips::inline formats
