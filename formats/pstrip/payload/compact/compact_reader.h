#pragma once

#include <algorithm>
#include <cstring>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "formats/pstrip/payload/compact/compact_fields.h"
#include "formats/pstrip/payload/compact/faces.h"
#include "formats/pstrip/payload/compact/packet_code.h"
#include "formats/pstrip/payload/compact/record_reader.h"
#include "formats/pstrip/payload/geometry.h"
#include "formats/pstrip/payload/predicates.h"

// For formats/pstrip/payload/compact: BASE, PCKT and FINE of a file, read into the mesh.

namespace pstrips::inline formats {

/// One mesh of a file.
struct CompactMesh {
  MeshCells cells;
  BaseMesh base;                     ///< until the first packet
  AttributeModels attributes;        ///< likewise
  std::unique_ptr<MeshState> state;  ///< from then on until all vertices are there
  std::uint64_t visited = 0;         ///< vertices, by packets
};

/// Tally: see TallyingReader
template <class Tally = NoTally>
class CompactReader final : public GeometryReader {
  using Coder = TallyingReader<Tally>;
  using ReadIo = layout::ReadIo;

 public:
  explicit CompactReader(const FileHeader& header, Tally tally = {})
      : tally_(tally),
        vertices_left_(header.vertices),
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

  bool codes_faces() const override { return true; }
  bool read_faces(ReadIo& io, Index faces, ProgressiveMesh& mesh) override {
    Index listed = 0;
    io.varint(listed, 32);
    for (Attribute& a : mesh.faces.attributes) io.run(a, 0, faces);
    if (io.failed()) return io.finish();
    const ByteView run = io.in().take(io.in().remaining());
    if (auto ok = formats::read_faces(run, listed, mesh); !ok) return io.refuse(ok.error().fault);
    return io.finish();
  }

 private:
  Result<void> read_base(ReadIo& io, const BaseHead& head, ProgressiveMesh& mesh);
  Result<MeshCells> read_cells(ReadIo& io, const ProgressiveMesh& mesh);
  Result<void> grant(const ProgressiveMesh& mesh);
  Result<void> read_packet(ReadIo& io, PacketHead& head, ProgressiveMesh& mesh,
                           const PacketStart& start);
  static MeshState& state_of(CompactMesh& reading, const ProgressiveMesh& mesh);
  Result<void> read_records(ReadIo& io, Index vsplits, MeshState& state, ProgressiveMesh& mesh);

  [[no_unique_address]] Tally tally_;
  std::vector<CompactMesh> meshes_;
  PacketKind kind_{};  // of the head that was read last
  // What the header announces and no mesh has taken.
  std::uint64_t vertices_left_, wedges_left_, entries_left_;
};

/// A mesh cannot be larger than the file.
template <class Tally>
Result<void> CompactReader<Tally>::grant(const ProgressiveMesh& mesh) {
  const std::uint64_t entries = full_map_entries(mesh);
  if (mesh.vertices > vertices_left_ || mesh.wedges > wedges_left_ || entries > entries_left_ ||
      mesh.base_vertices > mesh.vertices || mesh.base_wedges > mesh.wedges)
    return broken(Fault::compact_counts);
  vertices_left_ -= mesh.vertices;
  wedges_left_ -= mesh.wedges;
  entries_left_ -= entries;
  return {};
}

template <class Tally>
Result<MeshCells> CompactReader<Tally>::read_cells(ReadIo& io, const ProgressiveMesh& mesh) {
  if (mesh.groups.empty()) return broken(Fault::group_missing);
  if (mesh.encoding != MapEncoding::triangles || mesh.position.count != 3 ||
      components_of(mesh) > kMaxComponents ||
      !PositionCells::is_valid(mesh.grid, mesh.position.type))
    return broken(Fault::compact_mesh);
  MeshCells cells{PositionCells(mesh.grid, mesh.position.type), {}};
  for (const Attribute& a : mesh.wedge_attributes) {
    const std::uint64_t packed = take_varint(io, kPackedCellsBits);
    const std::optional<AttributeCells> of_attribute = unpacked(packed, a);
    if (!of_attribute) return broken(Fault::compact_cells);
    cells.attributes.push_back(*of_attribute);
  }
  return cells;
}

template <class Tally>
Result<void> CompactReader<Tally>::read_base(ReadIo& io, const BaseHead& head,
                                             ProgressiveMesh& mesh) {
  if (auto ok = grant(mesh); !ok) return ok;
  Result<MeshCells> cells = read_cells(io, mesh);
  if (!cells) return tl::unexpected<Error>(cells.error());
  if (head.map_entries % 3 != 0 || head.map_entries > full_map_entries(mesh))
    return broken(Fault::base_counts);
  Coder coder(io.in().take(io.in().remaining()), tally_);
  BaseMesh base;
  AttributeModels attributes(*cells);
  const BaseCounts counts = base_counts_of(mesh, *cells, head.map_entries);
  if (auto ok = BaseCode<Coder>(coder, counts, *cells, attributes, base).run(); !ok) return ok;
  if (!coder.complete()) return broken(Fault::compact_run);

  const CellsReader numbers(*cells);
  for (const GridPoint at : base.positions)
    numbers.append(mesh.position.data, mesh.position.type, at);
  numbers.append(mesh, base.wedge_cells, counts.columns);
  if (!mesh.single_wedges) mesh.base_wedge_vertex = base.wedge_vertex;
  mesh.base_map = base.corners;
  if (has_triangle_groups(mesh)) mesh.triangle_group = base.group;
  meshes_.push_back({std::move(*cells), std::move(base), std::move(attributes), nullptr, 0});
  return {};
}

template <class Tally>
MeshState& CompactReader<Tally>::state_of(CompactMesh& reading, const ProgressiveMesh& mesh) {
  if (reading.state == nullptr) {
    reading.state = std::make_unique<MeshState>(mesh, reading.cells, std::move(reading.attributes));
    reading.state->start(reading.base);
    reading.base = {};
  }
  return *reading.state;
}

template <class Tally>
Result<void> CompactReader<Tally>::read_records(ReadIo& io, Index vsplits, MeshState& state,
                                                ProgressiveMesh& mesh) {
  Coder coder(io.in().take(io.in().remaining()), tally_);
  RecordReader records(mesh, state.wedges);
  PacketCode<Coder, RecordReader> code(coder, state, records);
  const std::size_t before = mesh.vsplits.size();
  if (auto ok = kind_ == PacketKind::batch ? code.run_batch() : code.run_isolated(vsplits); !ok)
    return ok;
  if (!coder.complete()) return broken(Fault::compact_run);
  if (mesh.vsplits.size() - before != vsplits) return broken(Fault::compact_counts);
  return {};
}

template <class Tally>
Result<void> CompactReader<Tally>::read_packet(ReadIo& io, PacketHead& head, ProgressiveMesh& mesh,
                                               const PacketStart& start) {
  if (head.mesh >= meshes_.size()) return broken(Fault::packet_mesh);
  CompactMesh& reading = meshes_[head.mesh];
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

}  // namespace pstrips::inline formats
