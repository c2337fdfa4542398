#include "formats/pstrip/payload/compact/compact.h"

#include <optional>

#include "formats/pstrip/payload/compact/compact_fields.h"
#include "formats/pstrip/payload/compact/packet_code.h"
#include "formats/pstrip/payload/predicates.h"

namespace pstrips::inline formats {
namespace {

using layout::ReadIo;

/// Appends the records of a packet to a mesh.
class RecordReader {
 public:
  /// wedges  there before the packet
  RecordReader(ProgressiveMesh& mesh, Index wedges) : mesh_(mesh), wedges_(wedges) {}

  static const GridSplit* split_of(Index) { return nullptr; }
  static GridPoint isolated(std::size_t) { return {}; }
  SplitRecord& record() { return record_; }
  static const std::int32_t* cells_of(Index) { return nullptr; }

  void take(Index parent, Index added) {
    const std::size_t offsets = mesh_.map_offsets.size();
    if (parent == added) {
      mesh_.wedge_offset_counts.insert(mesh_.wedge_offset_counts.end(), record_.new_wedges, 0);
    } else if (mesh_.single_wedges) {
      mesh_.wedge_offset_counts.push_back(static_cast<Index>(record_.moved.size()));
      mesh_.map_offsets.insert(mesh_.map_offsets.end(), record_.moved.begin(), record_.moved.end());
      sort_from(offsets);
    } else {
      take_offsets();
    }
    const bool splits = parent != added;
    mesh_.vsplits.push_back({parent, record_.new_wedges,
                             splits ? static_cast<Index>(record_.reassigned.size()) : 0,
                             static_cast<Index>(mesh_.map_offsets.size() - offsets),
                             splits ? static_cast<Index>(record_.corners.size() / 3) : 0});
    wedges_ += record_.new_wedges;
    if (!splits) return;
    mesh_.reassigned.insert(mesh_.reassigned.end(), record_.reassigned.begin(),
                            record_.reassigned.end());
    mesh_.new_corners.insert(mesh_.new_corners.end(), record_.corners.begin(),
                             record_.corners.end());
    mesh_.triangle_group.insert(mesh_.triangle_group.end(), record_.groups.begin(),
                                record_.groups.end());
  }

 private:
  void sort_from(std::size_t first) {
    std::sort(mesh_.map_offsets.begin() + static_cast<std::ptrdiff_t>(first),
              mesh_.map_offsets.end());
  }

  /// By wedge, then by offset.
  void take_offsets() {
    rewritten_.clear();
    for (std::size_t i = 0; i < record_.moved.size(); ++i)
      if (record_.shown[i] >= wedges_) rewritten_.emplace_back(record_.shown[i], record_.moved[i]);
    std::ranges::sort(rewritten_);
    const std::size_t first = mesh_.wedge_offset_counts.size();
    mesh_.wedge_offset_counts.resize(first + record_.new_wedges);
    for (const auto& [wedge, corner] : rewritten_) {
      ++mesh_.wedge_offset_counts[first + wedge - wedges_];
      mesh_.map_offsets.push_back(corner);
    }
  }

  ProgressiveMesh& mesh_;
  SplitRecord record_;
  std::vector<std::pair<Index, Index>> rewritten_;  // wedge and corner
  Index wedges_;
};

/// Makes numbers of cells.
class CellsReader {
 public:
  explicit CellsReader(const MeshCells& cells) : cells_(cells) {}

  void append(Bytes& data, ComponentType type, GridPoint at) const {
    const std::size_t size = size_of(type), start = data.size();
    data.resize(start + 3 * size);
    const std::int32_t cell[] = {at.x, at.y, at.z};
    for (unsigned k = 0; k < 3; ++k) {
      const std::uint64_t bits = cells_.positions.component(cell[k], k);
      std::memcpy(data.data() + start + k * size, &bits, size);
    }
  }

  /// cells  all attributes of the wedges from the first one on that the mesh lacks
  void append(ProgressiveMesh& mesh, std::span<const std::int32_t> cells, unsigned columns) const {
    if (columns == 0) return;
    std::size_t column = 0;
    for (std::size_t i = 0; i < mesh.wedge_attributes.size(); ++i) {
      Attribute& a = mesh.wedge_attributes[i];
      const std::size_t first = a.elements(), n = cells.size() / columns;
      a.data.resize(a.data.size() + n * a.element_bytes());
      for (std::size_t e = 0; e < n; ++e)
        for (std::size_t k = 0; k < a.count; ++k)
          set_bits(a, first + e, k, cells_.attributes[i].middle(cells[e * columns + column + k]));
      column += a.count;
    }
  }

 private:
  const MeshCells& cells_;
};

/// One mesh of a file.
struct Reading {
  MeshCells cells;
  BaseMesh base;                     ///< until the first packet
  std::unique_ptr<MeshState> state;  ///< from then on until all vertices are there
  std::uint64_t visited = 0;         ///< vertices, by packets
};

class CompactReader final : public GeometryReader {
 public:
  explicit CompactReader(const FileHeader& header)
      : vertices_left_(header.vertices),
        wedges_left_(header.wedges),
        entries_left_(header.map_entries) {}

  void read_head(ReadIo& io, BaseHead& head) override {
    for (Index* const number : {&head.mesh, &head.vertices, &head.wedges, &head.map_entries})
      *number = take_index(io);
  }

  void read_head(ReadIo& io, PacketHead& head, std::span<const ProgressiveMesh> meshes) override {
    head.mesh = take_index(io);
    head.first_vsplit = take_index(io);
    const std::uint64_t vsplits = take_varint(io, 33);
    head.vsplits = static_cast<Index>(vsplits >> 1);
    kind_ = static_cast<PacketKind>(vsplits & 1);
    if (head.mesh < meshes.size() && meshes[head.mesh].single_wedges) head.wedges = head.vsplits;
  }

  bool read(ReadIo& io, const BaseHead& head, ProgressiveMesh& mesh) override {
    if (auto ok = read_base(io, head, mesh); !ok) return io.refuse(ok.error().fault);
    return io.finish();
  }

  bool read(ReadIo& io, PacketHead& head, ProgressiveMesh& mesh,
            const PacketStart& start) override {
    if (auto ok = read_packet(io, head, mesh, start); !ok) return io.refuse(ok.error().fault);
    return io.finish();
  }

  bool needs_fine(Index mesh) const override {
    return mesh < meshes_.size() && !is_exact(meshes_[mesh].cells);
  }
  bool read_fine(ReadIo& io, Index index, ProgressiveMesh& mesh) override {
    const ByteView bytes = io.in().take(io.in().remaining());
    const auto is_whole = [](const Attribute& a, Index n) { return a.elements() == n; };
    const bool good =
        is_whole(mesh.position, mesh.vertices) &&
        std::ranges::all_of(mesh.wedge_attributes,
                            [&](const Attribute& a) { return is_whole(a, mesh.wedges); }) &&
        formats::read_fine(bytes, meshes_[index].cells, mesh);
    return good || io.refuse(Fault::fine_length);
  }

 private:
  Result<void> read_base(ReadIo& io, const BaseHead& head, ProgressiveMesh& mesh);
  Result<MeshCells> read_cells(ReadIo& io, const ProgressiveMesh& mesh);
  Result<void> grant(const ProgressiveMesh& mesh);
  Result<void> read_packet(ReadIo& io, PacketHead& head, ProgressiveMesh& mesh,
                           const PacketStart& start);
  static MeshState& state_of(Reading& reading, const ProgressiveMesh& mesh);
  Result<void> read_records(ReadIo& io, Index vsplits, MeshState& state, ProgressiveMesh& mesh);

  std::vector<Reading> meshes_;
  PacketKind kind_{};  // of the head that was read last
  // What the header announces and no mesh has taken.
  std::uint64_t vertices_left_, wedges_left_, entries_left_;
};

/// A mesh cannot be larger than the file.
Result<void> CompactReader::grant(const ProgressiveMesh& mesh) {
  const std::uint64_t entries = full_map_entries(mesh);
  if (mesh.vertices > vertices_left_ || mesh.wedges > wedges_left_ || entries > entries_left_ ||
      mesh.base_vertices > mesh.vertices || mesh.base_wedges > mesh.wedges)
    return broken(Fault::compact_counts);
  vertices_left_ -= mesh.vertices;
  wedges_left_ -= mesh.wedges;
  entries_left_ -= entries;
  return {};
}

Result<MeshCells> CompactReader::read_cells(ReadIo& io, const ProgressiveMesh& mesh) {
  if (mesh.groups.empty()) return broken(Fault::group_missing);
  if (mesh.encoding != MapEncoding::triangles || mesh.position.count != 3 ||
      columns_of(mesh) > kMaxColumns || !PositionCells::is_valid(mesh.grid, mesh.position.type))
    return broken(Fault::compact_mesh);
  MeshCells cells{PositionCells(mesh.grid, mesh.position.type), {}};
  for (const Attribute& a : mesh.wedge_attributes) {
    const std::uint64_t packed = take_varint(io, kPackedCellsBits);
    const int exponent = exponent_of_packed(packed);
    if (!Cells::is_valid(a.type, exponent)) return broken(Fault::compact_cells);
    cells.attributes.emplace_back(a.type, exponent, (packed & 1) != 0);
  }
  return cells;
}

Result<void> CompactReader::read_base(ReadIo& io, const BaseHead& head, ProgressiveMesh& mesh) {
  if (auto ok = grant(mesh); !ok) return ok;
  Result<MeshCells> cells = read_cells(io, mesh);
  if (!cells) return tl::unexpected<Error>(cells.error());
  if (head.map_entries % 3 != 0 || head.map_entries > full_map_entries(mesh))
    return broken(Fault::base_counts);
  RansReader coder(io.in().take(io.in().remaining()));
  BaseMesh base;
  const BaseCounts counts = base_counts_of(mesh, head.map_entries);
  if (auto ok = BaseCode<RansReader>(coder, counts, base).run(); !ok) return ok;
  if (!coder.complete()) return broken(Fault::compact_run);

  const CellsReader numbers(*cells);
  for (const GridPoint at : base.positions)
    numbers.append(mesh.position.data, mesh.position.type, at);
  numbers.append(mesh, base.wedge_cells, counts.columns);
  if (!mesh.single_wedges) mesh.base_wedge_vertex = base.wedge_vertex;
  mesh.base_map = base.corners;
  if (has_triangle_groups(mesh)) mesh.triangle_group = base.group;
  meshes_.push_back({std::move(*cells), std::move(base), nullptr, 0});
  return {};
}

MeshState& CompactReader::state_of(Reading& reading, const ProgressiveMesh& mesh) {
  if (reading.state == nullptr) {
    reading.state = std::make_unique<MeshState>(mesh, reading.cells);
    reading.state->start(reading.base);
    reading.base = {};
  }
  return *reading.state;
}

Result<void> CompactReader::read_records(ReadIo& io, Index vsplits, MeshState& state,
                                         ProgressiveMesh& mesh) {
  RansReader coder(io.in().take(io.in().remaining()));
  RecordReader records(mesh, state.wedges);
  PacketCode<RansReader, RecordReader> code(coder, state, records);
  const std::size_t before = mesh.vsplits.size();
  if (auto ok = kind_ == PacketKind::batch ? code.run_batch() : code.run_isolated(vsplits); !ok)
    return ok;
  if (!coder.complete()) return broken(Fault::compact_run);
  if (mesh.vsplits.size() - before != vsplits) return broken(Fault::compact_counts);
  return {};
}

Result<void> CompactReader::read_packet(ReadIo& io, PacketHead& head, ProgressiveMesh& mesh,
                                        const PacketStart& start) {
  if (head.mesh >= meshes_.size()) return broken(Fault::packet_mesh);
  Reading& reading = meshes_[head.mesh];
  reading.visited += start.vertices;
  if (is_too_much_work(reading.visited, mesh.vertices)) return broken(Fault::too_much_work);
  if (head.vsplits > mesh.vertices - start.vertices) return broken(Fault::compact_counts);
  MeshState& state = state_of(reading, mesh);
  const std::size_t first_cell = state.wedge_cells.size();
  if (auto ok = read_records(io, head.vsplits, state, mesh); !ok) return ok;

  const CellsReader numbers(state.cells);
  const std::vector<GridPoint>& positions = state.splits.position;
  for (std::size_t v = start.vertices; v < positions.size(); ++v)
    numbers.append(mesh.position.data, mesh.position.type, positions[v]);
  if (mesh.placement == Placement::optimal)
    for (std::size_t i = start.vsplit; i < mesh.vsplits.size(); ++i)
      numbers.append(mesh.parent_position, mesh.position.type, positions[mesh.vsplits[i].parent]);
  numbers.append(mesh, std::span(state.wedge_cells).subspan(first_cell), state.columns);
  head.wedges = state.wedges - start.wedges;
  head.reassigned = static_cast<Index>(mesh.reassigned.size() - start.reassigned);
  head.map_offsets = static_cast<Index>(mesh.map_offsets.size() - start.map_offset);
  head.triangles = static_cast<Index>((mesh.new_corners.size() - start.new_corner) / 3);
  if (positions.size() == mesh.vertices) reading.state.reset();
  return {};
}

class CompactCodec final : public GeometryCodec {
 public:
  std::unique_ptr<GeometryReader> reader(const FileHeader& header) const override {
    return std::make_unique<CompactReader>(header);
  }
  // Three numbers of a head, the least of a run of codes.
  std::uint64_t min_packet_bytes() const override { return 3 + 4; }
  std::uint64_t min_base_bytes() const override { return 4 + 4; }
  // About two bytes a vsplit; in memory, a position, a record, six corners and six offsets.
  std::uint64_t max_expansion() const override { return 64; }

  std::uint64_t estimate_map_offsets(const ProgressiveMesh&, std::uint64_t vsplits, std::uint64_t,
                                     std::uint64_t) const override {
    // Six faces meet in a vertex; a new one gets those of one side, the two that are new aside.
    return 2 * vsplits;
  }
};

}  // namespace

const GeometryCodec& compact_codec() {
  static const CompactCodec codec;
  return codec;
}

}  // namespace pstrips::inline formats
