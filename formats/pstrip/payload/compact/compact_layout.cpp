#include <optional>

#include "formats/pstrip/container/chunk_table.h"
#include "formats/pstrip/payload/compact/bit_tally.h"
#include "formats/pstrip/payload/compact/compact.h"
#include "formats/pstrip/payload/compact/compact_fields.h"
#include "formats/pstrip/payload/compact/compact_reader.h"
#include "formats/pstrip/payload/compact/faces.h"
#include "formats/pstrip/payload/compact/packet_code.h"
#include "formats/pstrip/payload/compact/split_finder.h"

namespace pstrips::inline formats {
namespace {

tl::unexpected<Error> cannot(std::string message, std::string path) {
  return fail(ErrorCode::bad_argument, std::move(message), kNoOffset, std::move(path));
}

/// Cells of the numbers of a mesh.
class CellsWriter {
 public:
  CellsWriter(const ProgressiveMesh& mesh, const MeshCells& cells) : mesh_(mesh), cells_(cells) {
    row_.resize(columns_of(cells));
  }

  /// The i-th of a list of positions; nothing when it is not on the grid.
  std::optional<GridPoint> position(ByteView data, std::size_t i) const {
    const std::size_t size = size_of(mesh_.position.type);
    std::array<std::int32_t, 3> at{};
    for (unsigned k = 0; k < 3; ++k) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, data.data() + (3 * i + k) * size, size);
      at[k] = cells_.positions.cell_of(bits, k);
      const bool is_exact = !cells_.positions.cells() || cells_.positions.cells()->exact();
      if (is_exact && cells_.positions.component(at[k], k) != bits) return std::nullopt;
    }
    return GridPoint{at[0], at[1], at[2]};
  }

  const std::int32_t* row(Index wedge) {
    std::size_t column = 0;
    for (std::size_t i = 0; i < mesh_.wedge_attributes.size(); ++i) {
      cells_.attributes[i].cells_of(mesh_.wedge_attributes[i], wedge, row_.data() + column);
      column += cells_.attributes[i].columns();
    }
    return row_.data();
  }

 private:
  const ProgressiveMesh& mesh_;
  const MeshCells& cells_;
  std::vector<std::int32_t> row_;
};

/// Reads records of a mesh as what a packet codes.
class RecordWriter {
 public:
  RecordWriter(const ProgressiveMesh& mesh, MeshState& state)
      : mesh_(mesh), state_(state), finder_(state), numbers_(mesh, state.cells) {}

  /// The packet that is asked for next.
  void start(Index vsplits) { end_ = next_.vsplit + vsplits; }
  /// All of it was taken, and it was what can be coded.
  bool complete() const { return !failed_ && next_.vsplit == end_; }
  std::size_t at() const { return next_.vsplit; }

  const GridSplit* split_of(Index vertex) {
    if (failed_ || next_.vsplit == end_ || mesh_.vsplits[next_.vsplit].parent != vertex)
      return nullptr;
    const Index new_wedges = mesh_.vsplits[next_.vsplit].wedges;
    failed_ = !finder_.find(record_at(mesh_, next_), new_wedges, split_, record_) ||
              !find_step(vertex) || !find_groups();
    return failed_ ? nullptr : &split_;
  }

  GridPoint isolated(std::size_t) {
    const Vsplit& split = mesh_.vsplits[next_.vsplit];
    const auto vertex = static_cast<Index>(mesh_.base_vertices + next_.vsplit);
    const auto at = numbers_.position(mesh_.position.data, vertex);
    failed_ |= split.parent != vertex || split.map_offsets != 0 || split.triangles != 0 || !at;
    record_ = {};
    record_.new_wedges = split.wedges;
    return at.value_or(GridPoint{});
  }

  SplitRecord& record() { return record_; }
  const std::int32_t* cells_of(Index wedge) { return numbers_.row(wedge); }
  void take(Index, Index) { next_.skip(mesh_.vsplits[next_.vsplit]); }

 private:
  bool find_step(Index parent) {
    const std::size_t i = next_.vsplit;
    const auto at = numbers_.position(mesh_.position.data, mesh_.base_vertices + i);
    if (!at) return false;
    const GridPoint before = state_.splits.position[parent];
    if (mesh_.placement == Placement::subset) {
      split_.step = *at - before;
      return true;
    }
    const auto after = numbers_.position(mesh_.parent_position, i);
    if (!after) return false;
    split_.step = *at - *after;
    return before == *after + halved(split_.step);
  }

  bool find_groups() {
    if (state_.groups < 2) return true;
    const std::size_t triangles = record_.corners.size() / 3;
    const auto first = mesh_.triangle_group.begin() + state_.faces;
    record_.groups.assign(first, first + static_cast<std::ptrdiff_t>(triangles));
    return true;
  }

  const ProgressiveMesh& mesh_;
  MeshState& state_;
  SplitFinder finder_;
  CellsWriter numbers_;
  RecordStart next_;
  std::size_t end_ = 0;
  bool failed_ = false;
  GridSplit split_;
  SplitRecord record_;
};

/// Codes one mesh: its base, then its packets.
class MeshWriter {
 public:
  MeshWriter(const ProgressiveMesh& mesh, Index index)
      : mesh_(mesh), index_(index), state_(mesh, cells_of(mesh)), records_(mesh, state_) {}

  static bool fits(const ProgressiveMesh& mesh) {
    return mesh.encoding == MapEncoding::triangles && mesh.position.count == 3 &&
           components_of(mesh) <= kMaxComponents &&
           PositionCells::is_valid(mesh.grid, mesh.position.type);
  }

  const MeshCells& cells() const { return state_.cells; }
  Result<Bytes> write_base();
  Result<Bytes> write_packet(const Packet& packet);

 private:
  std::string path(std::string_view list, std::size_t i) const {
    return "/meshes/" + std::to_string(index_) + std::string(list) + std::to_string(i);
  }

  const ProgressiveMesh& mesh_;
  Index index_;
  MeshState state_;
  RecordWriter records_;
  RansWriter coder_;
  std::uint64_t visited_ = 0;  // vertices, by packets
};

Result<Bytes> MeshWriter::write_base() {
  const BaseCounts counts =
      base_counts_of(mesh_, state_.cells, static_cast<Index>(mesh_.base_map.size()));
  CellsWriter numbers(mesh_, state_.cells);
  BaseMesh base;
  base.columns = counts.columns;
  for (Index v = 0; v < counts.vertices; ++v) {
    const auto at = numbers.position(mesh_.position.data, v);
    if (!at) return cannot("position is not on the grid", path("/position/", v));
    base.positions.push_back(*at);
  }
  for (Index w = 0; w < counts.wedges; ++w) {
    base.wedge_vertex.push_back(counts.single_wedges ? w : mesh_.base_wedge_vertex[w]);
    const std::int32_t* const row = numbers.row(w);
    base.wedge_cells.insert(base.wedge_cells.end(), row, row + counts.columns);
  }
  base.corners = mesh_.base_map;
  base.group.resize(counts.triangles);
  if (counts.groups > 1)
    std::copy_n(mesh_.triangle_group.begin(), counts.triangles, base.group.begin());
  Bytes out;
  for (const Index number : {index_, counts.vertices, counts.wedges, 3 * counts.triangles})
    put_varint(out, number);
  for (const AttributeCells& cells : state_.cells.attributes) put_varint(out, packed(cells));
  if (const auto ok =
          BaseCode<RansWriter>(coder_, counts, state_.cells, state_.attributes, base).run();
      !ok)
    return cannot(ok.error().message, path("/base_map/", 0));
  const Bytes run = coder_.finish();
  out.insert(out.end(), run.begin(), run.end());
  state_.start(base);
  return out;
}

Result<Bytes> MeshWriter::write_packet(const Packet& packet) {
  const std::size_t first = records_.at();
  const bool is_isolated =
      packet.vsplits > 0 && mesh_.vsplits[first].parent == state_.mesh().vertex_count();
  visited_ += state_.mesh().vertex_count();
  if (is_too_much_work(visited_, mesh_.vertices))
    return cannot("too many packets for the vertices", path("/vsplits/", first));
  Bytes out;
  put_varint(out, index_);
  put_varint(out, first);
  put_varint(out, std::uint64_t{packet.vsplits} << 1 | (is_isolated ? 1u : 0u));
  records_.start(packet.vsplits);
  PacketCode<RansWriter, RecordWriter> code(coder_, state_, records_);
  const Result<void> ok = is_isolated ? code.run_isolated(packet.vsplits) : code.run_batch();
  if (!ok || !records_.complete())
    return cannot("record is none of a batch of splits", path("/vsplits/", records_.at()));
  const Bytes run = coder_.finish();
  out.insert(out.end(), run.begin(), run.end());
  return out;
}

Bytes faces_payload(const ProgressiveMesh& mesh, Index index) {
  Bytes out;
  if (mesh.faces.empty()) return out;
  const CodedFaces coded = code_faces(mesh);
  put_varint(out, index);
  put_varint(out, coded.listed);
  for (const Attribute& a : mesh.faces.attributes)
    out.insert(out.end(), a.data.begin(), a.data.end());
  out.insert(out.end(), coded.run.begin(), coded.run.end());
  return out;
}

class CompactWriter final : public GeometryWriter {
 public:
  explicit CompactWriter(const ProgressiveStrips& strips) : strips_(strips) {}
  static Result<std::unique_ptr<GeometryWriter>> make(const ProgressiveStrips& strips);

  std::uint64_t base_bytes(Index mesh) override { return bases_[mesh].size(); }
  std::uint64_t packet_bytes(std::size_t packet) override { return packets_[packet].size(); }
  void write_base(Index mesh, std::span<std::byte> payload) override {
    std::ranges::copy(bases_[mesh], payload.begin());
  }
  void write_packet(std::size_t packet, std::span<std::byte> payload) override {
    std::ranges::copy(packets_[packet], payload.begin());
  }

  std::uint64_t fine_bytes(Index mesh) override {
    return is_exact(cells_[mesh])
               ? 0
               : sizeof(Index) + formats::fine_bytes(strips_.meshes[mesh], cells_[mesh]);
  }
  void write_fine(Index mesh, std::span<std::byte> payload) override {
    std::memcpy(payload.data(), &mesh, sizeof mesh);
    formats::write_fine(strips_.meshes[mesh], cells_[mesh], payload.subspan(sizeof mesh));
  }

  const Bytes* coded_faces(Index mesh) const override { return &faces_[mesh]; }

 private:
  const ProgressiveStrips& strips_;
  std::vector<MeshCells> cells_;  // of each mesh
  std::vector<Bytes> faces_;      // likewise; empty where there is no table
  std::vector<Bytes> bases_, packets_;
};

Result<std::unique_ptr<GeometryWriter>> CompactWriter::make(const ProgressiveStrips& strips) {
  auto out = std::make_unique<CompactWriter>(strips);
  std::vector<std::unique_ptr<MeshWriter>> writers;
  for (Index m = 0; m < strips.meshes.size(); ++m) {
    if (!MeshWriter::fits(strips.meshes[m]))
      return cannot("mesh does not fit the compact profile", "/meshes/" + std::to_string(m));
    writers.push_back(std::make_unique<MeshWriter>(strips.meshes[m], m));
    Result<Bytes> base = writers.back()->write_base();
    if (!base) return tl::unexpected<Error>(base.error());
    out->bases_.push_back(std::move(*base));
    out->cells_.push_back(writers.back()->cells());
  }
  for (const Packet& packet : strips.packets) {
    Result<Bytes> bytes = writers[packet.mesh]->write_packet(packet);
    if (!bytes) return tl::unexpected<Error>(bytes.error());
    out->packets_.push_back(std::move(*bytes));
  }
  for (Index m = 0; m < strips.meshes.size(); ++m)
    out->faces_.push_back(faces_payload(strips.meshes[m], m));
  return out;
}

class CompactLayout final : public GeometryLayout {
 public:
  Result<std::unique_ptr<GeometryWriter>> writer(const ProgressiveStrips& strips) const override {
    return CompactWriter::make(strips);
  }

  std::unique_ptr<GeometryReader> counting_reader(const FileHeader& header,
                                                  PartBits& bits) const override {
    return std::make_unique<CompactReader<BitTally>>(header, BitTally(bits));
  }

  std::vector<PartMark> parts(const Chunk& chunk, std::span<const ProgressiveMesh>) const override {
    return {{chunk.type == kBaseChunk ? Part::base_positions : Part::positions, 0}};
  }
  // No element has bytes of its own.
  std::uint64_t position_of(const Chunk&, const ProgressiveMesh&, const void*,
                            std::uint64_t) const override {
    return 0;
  }
};

}  // namespace

const GeometryLayout& compact_layout() {
  static const CompactLayout layout;
  return layout;
}

}  // namespace pstrips::inline formats
