#pragma once

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include "formats/pstrip/payload/compact/mesh_state.h"
#include "formats/pstrip/payload/compact/split_code.h"
#include "formats/pstrip/payload/compact/wedge_code.h"

// For formats/pstrip/payload/compact: what a packet brings, appended to the lists of a mesh.

namespace pstrips::inline formats {

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
        cells_.attributes[i].store(&cells[e * columns + column], a, first + e);
      column += cells_.attributes[i].columns();
    }
  }

 private:
  const MeshCells& cells_;
};

}  // namespace pstrips::inline formats
