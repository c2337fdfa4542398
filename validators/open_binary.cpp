#include <algorithm>

#include "formats/pstrip/container/container_parser.h"
#include "formats/pstrip/payload/decoder.h"
#include "validators/document.h"
#include "validators/locate.h"

namespace pstrips::inline validators {
namespace {

/// Lists the chunks of a file and notes what is wrong with its frame.
class FrameLister final : public ChunkSink {
 public:
  explicit FrameLister(Document& doc) : doc_(doc) {}

  /// False when the frame is broken in a way that leaves the payloads without meaning.
  bool list() {
    const bool parsed = parser_.feed(doc_.file, *this);
    doc_.frame.end = parser_.offset();
    if (!parsed && !parser_.complete()) return false;
    if (!parser_.complete()) {
      doc_.ended_early = true;
      const bool is_past = past_file_bytes_ == parser_.offset();
      doc_.faults.add(is_past ? Fault::past_file_bytes : Fault::truncated,
                      {.field = Field::file, .element = parser_.offset()});
    }
    return payloads_have_meaning_;
  }

  bool report(Fault fault, const Where& where, std::string found) override {
    // The chunk may yet turn out to be whole: then it is the size in PSHD that is wrong.
    if (fault == Fault::past_file_bytes) {
      past_file_bytes_ = where.element;
      return true;
    }
    const bool only_damaged = fault == Fault::chunk_crc || fault == Fault::chunk_padding ||
                              fault == Fault::bytes_after_end || fault == Fault::file_bytes;
    payloads_have_meaning_ = payloads_have_meaning_ && only_damaged;
    return doc_.faults.report(fault, where, std::move(found));
  }

  bool take(const Chunk& chunk) override {
    Chunk& kept = doc_.frame.chunks.emplace_back(chunk);
    kept.payload =
        doc_.file.subspan(static_cast<std::size_t>(chunk.payload_offset()), chunk.payload.size());
    if (chunk.type == kHeaderChunk && chunk.number == 0) {
      FileHeader header;
      FirstFault ignored;
      layout::ReadIo io(chunk, 0, ignored);
      layout::header_fields(io, header);
      parser_.declare_size(header.file_bytes);
    }
    return true;
  }

 private:
  Document& doc_;
  ContainerParser parser_;
  std::uint64_t past_file_bytes_ = kNoOffset;
  bool payloads_have_meaning_ = true;
};

/// Reads the payloads of the chunks listed.
class PayloadLister {
 public:
  PayloadLister(Document& doc, const Limits& limits)
      : doc_(doc), decoder_(limits, PayloadChecks::fields, doc.faults) {}

  bool list() {
    bool good = true;
    for (const Chunk& chunk : doc_.frame.chunks) {
      good = is_counted(chunk);
      if (!good) break;
      good = decoder_.decode(chunk);
      keep_number(chunk);
      if (!good) break;
      if (chunk.type == kHeaderChunk)
        order_.declare(decoder_.header()->meshes, decoder_.header()->packets);
    }
    hand_over();
    return good;
  }

 private:
  bool is_counted(const Chunk& chunk) {
    ChunkOrder::Broken broken = order_.add(chunk.type);
    if (broken.fault == Fault::none) return true;
    doc_.faults.add(broken.fault, {.field = Field::chunk, .element = chunk.number},
                    std::move(broken.found));
    return false;
  }

  void keep_number(const Chunk& chunk) {
    const Index mesh = decoder_.mesh();
    const auto number = static_cast<Index>(chunk.number);
    doc_.mesh_chunks.resize(decoder_.strips().meshes.size());
    if (mesh >= doc_.mesh_chunks.size()) return;
    if (chunk.type == kPacketChunk)
      doc_.mesh_chunks[mesh].packets.push_back(number);
    else
      doc_.mesh_chunks[mesh].of_type.emplace(chunk.type, number);
  }

  void hand_over() {
    doc_.header = decoder_.header();
    doc_.index = decoder_.index();
    doc_.declared = decoder_.counts();
    doc_.image_embedded.assign(decoder_.embedded().begin(), decoder_.embedded().end());
    doc_.strips = std::move(decoder_.strips());
    doc_.packets_of.resize(doc_.strips.meshes.size());
    for (Index k = 0; k < doc_.strips.packets.size(); ++k)
      doc_.packets_of[doc_.strips.packets[k].mesh].push_back(k);
    // The rules look at face attributes whether there is a fACE or not.
    for (ProgressiveMesh& mesh : doc_.strips.meshes)
      if (mesh.faces.attributes.empty()) mesh.faces.attributes = mesh.face_attribute_formats;
  }

  Document& doc_;
  PayloadDecoder decoder_;
  ChunkOrder order_;
};

}  // namespace

Document open_binary(ByteView file, const Limits& limits) {
  Document doc;
  doc.file = file;
  doc.locate = [](const Document& d, const Where& where) { return locate_binary(d, where); };
  if (FrameLister(doc).list()) {
    doc.depth = Depth::payloads;
    if (PayloadLister(doc, limits).list()) doc.depth = Depth::model;
  }
  doc.strips.complete = !doc.ended_early;
  return doc;
}

}  // namespace pstrips::inline validators
