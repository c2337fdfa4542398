#include "formats/pstrip/container/binary.h"
#include "formats/pstrip/container/chunk_table.h"
#include "formats/pstrip/container/container_parser.h"
#include "formats/pstrip/payload/decoder.h"

namespace pstrips::inline formats {

struct BinaryParser::State final : ChunkSink {
  State(const Limits& limits, std::uint64_t file_bytes)
      : container(limits.memory_bytes), decoder(limits, PayloadChecks::model, *this, file_bytes) {}

  bool report(Fault fault, const Where& where, std::string found) override {
    return faults.report(fault, where, std::move(found));
  }

  bool take(const Chunk& chunk) override {
    if (!decoder.decode(chunk)) return false;
    if (chunk.type == kHeaderChunk) {
      const FileHeader& header = *decoder.header();
      container.declare_size(header.file_bytes);
      container.declare_chunks(header.meshes, header.packets);
    }
    return true;
  }

  FirstFault faults;
  ContainerParser container;
  PayloadDecoder decoder;
  std::optional<Error> error;
};

BinaryParser::BinaryParser(const Limits& limits, std::uint64_t file_bytes)
    : state_(std::make_unique<State>(limits, file_bytes)) {}
BinaryParser::~BinaryParser() = default;
BinaryParser::BinaryParser(BinaryParser&&) noexcept = default;
BinaryParser& BinaryParser::operator=(BinaryParser&&) noexcept = default;

Result<void> BinaryParser::feed(ByteView bytes) {
  State& s = *state_;
  if (!s.error && !s.container.feed(bytes, s))
    s.error = error_of(*s.faults.first(), s.container.offset());
  if (s.error) return tl::unexpected<Error>(*s.error);
  return {};
}

const ProgressiveStrips& BinaryParser::strips() const { return state_->decoder.strips(); }
ProgressiveStrips BinaryParser::take() && { return std::move(state_->decoder.strips()); }
bool BinaryParser::has_base() const { return state_->decoder.has_base(); }
std::span<const Index> BinaryParser::completed_meshes() const {
  return state_->decoder.completed_meshes();
}
bool BinaryParser::complete() const { return state_->container.complete() && !state_->error; }
const std::optional<Error>& BinaryParser::error() const { return state_->error; }

std::optional<Error> BinaryParser::end() const {
  if (state_->error || complete()) return state_->error;
  return error_of({Fault::truncated, {.field = Field::file, .element = bytes_taken()}, {}});
}

const std::optional<FileHeader>& BinaryParser::header() const { return state_->decoder.header(); }
std::span<const IndexRow> BinaryParser::index() const { return state_->decoder.index(); }
std::uint64_t BinaryParser::bytes_taken() const { return state_->container.bytes_taken(); }

Result<ProgressiveStrips> read_binary(ByteView file, const Limits& limits, ReadMode mode) {
  BinaryParser parser(limits, file.size());
  if (const Result<void> ok = parser.feed(file); !ok) return tl::unexpected<Error>(ok.error());
  if (!parser.complete() && (mode == ReadMode::whole || !parser.has_base()))
    return tl::unexpected<Error>(*parser.end());
  return std::move(parser).take();
}

}  // namespace pstrips::inline formats
