#pragma once

#include <bit>
#include <span>
#include <vector>

#include "formats/pstrip/payload/layout.h"

// For formats/pstrip and validators: the rows of PIDX, once for reading, writing and sizing. A row
// leaves out what follows from the rows before it. [spec/container.md §6]

namespace pstrips::inline formats::layout {

/// Goes over the rows one after the other.
class IndexRows {
 public:
  /// meshes  as MESH describes them: encoding and base_vertices are used
  /// start   the end of the PIDX chunk in the file; a writer that sizes rows may say 0
  IndexRows(std::span<const ProgressiveMesh> meshes, std::uint64_t start)
      : meshes_(meshes), end_(start), reached_(meshes.size()) {}

  /// The next row.
  template <class Io, class Row>
  void fields(Io& io, Row& row) {
    const bool is_base = number_ < meshes_.size();
    place_fields(io, row);
    Index mesh = is_base ? static_cast<Index>(number_) : row.mesh, vsplits = row.vsplits;
    if (!is_base) {
      if (meshes_.size() == 1) mesh = 0;
      if (meshes_.size() != 1) io.varint(mesh, kBits);
      io.varint(vsplits, kBits);
    }
    // What names no mesh is refused later; until then it starts from nothing.
    Reached nothing;
    Reached& reached = mesh < reached_.size() ? reached_[mesh] : nothing;
    if (is_base)
      reached.vertices = meshes_[mesh].base_vertices;
    else
      reached.vertices += vsplits;
    const Index triangles = reached.triangles(io, row.triangles);
    const bool counts_strips =
        mesh >= meshes_.size() || meshes_[mesh].encoding != MapEncoding::triangles;
    const Index strips = counts_strips ? reached.strips(io, row.strips) : triangles;
    if constexpr (Io::kReads) {
      row.mesh = mesh;
      row.vsplits = is_base ? 0 : vsplits;
      row.vertices = reached.vertices;
      row.triangles = triangles;
      row.strips = strips;
    }
    error_fields(io, row);
    ++number_;
  }

 private:
  static constexpr unsigned kBits = 32;

  /// A difference, small ones either way as small numbers. Modulo 2^32, so that all come back.
  static Index folded(Index difference) {
    return difference << 1 ^ (difference >> 31 != 0 ? ~Index{0} : 0);
  }
  static Index unfolded(Index coded) { return coded >> 1 ^ ((coded & 1) != 0 ? ~Index{0} : 0); }

  /// What the rows of a mesh have come to.
  struct Reached {
    Index vertices = 0;
    Index surplus = 0;  // triangles - 2 * vertices: of a closed surface it stays the same
    Index last_strips = 0;

    template <class Io>
    Index triangles(Io& io, Index value) {
      surplus = next(io, surplus, value - 2 * vertices);
      return surplus + 2 * vertices;
    }
    template <class Io>
    Index strips(Io& io, Index value) {
      return last_strips = next(io, last_strips, value);
    }

   private:
    template <class Io>
    static Index next(Io& io, Index before, Index value) {
      Index coded = Io::kReads ? 0 : folded(value - before);
      io.varint(coded, kBits);
      return before + unfolded(coded);
    }
  };

  template <class Io, class Row>
  void place_fields(Io& io, Row& row) {
    std::uint64_t skipped = Io::kReads ? 0 : row.offset - end_;
    std::uint64_t size = std::uint64_t{row.bytes} << 1 | (skipped != 0 ? 1u : 0u);
    io.varint(size, kBits + 1);
    if ((size & 1) != 0) {
      --skipped;
      io.varint(skipped, 63);
      ++skipped;
    }
    if constexpr (Io::kReads) {
      row.bytes = static_cast<Index>(size >> 1);
      row.offset = end_ + skipped;
    }
    end_ = row.offset + row.bytes;
  }

  template <class Io, class Row>
  void error_fields(Io& io, Row& row) {
    io.number(row.error);
    const auto bits = std::bit_cast<std::uint32_t>(row.error);
    std::uint32_t less = Io::kReads ? 0 : bits - std::bit_cast<std::uint32_t>(row.one_sided_error);
    io.varint(less, kBits);
    if constexpr (Io::kReads) row.one_sided_error = std::bit_cast<float>(bits - less);
  }

  std::span<const ProgressiveMesh> meshes_;
  std::uint64_t end_;  // of the chunk of the row before
  std::size_t number_ = 0;
  std::vector<Reached> reached_;  // a mesh each
};

/// All rows; a reader takes as many as there are.
template <class Io, class Rows>
void index_fields(Io& io, Rows& rows, std::span<const ProgressiveMesh> meshes,
                  std::uint64_t start) {
  IndexRows all(meshes, start);
  if constexpr (Io::kReads)
    while (!io.failed() && io.in().remaining() > 0) all.fields(io, rows.emplace_back());
  else
    for (const auto& row : rows) all.fields(io, row);
}

}  // namespace pstrips::inline formats::layout
