#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codecs/compact/batches.h"
#include "core/result.h"
#include "formats/pstrip/payload/compact/split_state.h"

namespace pstrips::test {

/// Triangles on an integer grid.
struct GridMesh {
  std::vector<GridPoint> positions;
  std::vector<Index> triangles;  ///< 3 vertices each
  friend bool operator==(const GridMesh&, const GridMesh&) = default;
};

/// A mesh as a base and batches of splits, each a run of bytes that builds on those before it.
struct SplitStream {
  Placement placement = Placement::subset;
  GridMesh base;
  std::vector<Bytes> batches;   ///< coarse to fine
  std::uint32_t vertices = 0;   ///< of the whole mesh
  std::uint32_t triangles = 0;  ///< of the whole mesh
};

/// What became of the source's numbers, and what the stream has.
struct SplitStreamMap {
  std::vector<Index> vertex;        ///< of the source, for each decoded vertex
  std::vector<Index> triangle;      ///< of the source, for each decoded triangle
  std::uint32_t without_chord = 0;  ///< splits that took the long form
};

/// Puts a sequence of collapses into batches of splits that are independent of each other, and
/// codes these. Any complex: what is no chord of a fan of faces takes a longer form.
///
/// mesh       triangles of three distinct vertices, in range; coordinates within kMaxGrid
/// collapses  fine to coarse; after each the removed vertex stands for nothing any more. Only
///            `kept` and `removed` count
/// map        optional
/// cost       O(faces + collapses); the same bytes on every machine
/// source     batches of independent splits, each marked by a bit a vertex [Pajarola00]; the faces
///            of the two vertices parted as in [Hoppe96]. Ours: batches are taken from a window of
///            a sequence that somebody else ordered, a chord of the ring is ranked by its geometry,
///            and splits of one batch are sound in any order on any complex
SplitStream encode_splits(const GridMesh& mesh, std::span<const Collapse> collapses,
                          const BatchOptions& options = {}, SplitStreamMap* map = nullptr);

/// Follows a stream batch by batch.
class SplitDecoder {
 public:
  /// The base is checked: indices in range, three distinct vertices each, points on the grid.
  static Result<SplitDecoder> start(Placement placement, const GridMesh& base,
                                    std::uint32_t vertices, std::uint32_t triangles);

  /// cost    O(vertices so far + splits)
  /// errors  corrupt; the mesh is some mesh within the limits then, and takes no more batches
  Result<void> add(ByteView batch);

  /// Vertices and triangles so far, those of the base first.
  GridMesh mesh() const;
  std::uint32_t vertex_count() const { return state_.mesh.vertex_count(); }

 private:
  SplitDecoder(Placement placement, std::uint32_t vertices, std::uint32_t triangles)
      : state_(placement), vertices_(vertices), triangles_(triangles) {}
  SplitState state_;
  std::uint32_t vertices_, triangles_;
  bool broken_ = false;
};

}  // namespace pstrips::test
