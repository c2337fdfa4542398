#pragma once

#include <algorithm>
#include <iterator>

#include "formats/pstrip/container/chunks.h"
#include "formats/pstrip/container/part.h"

namespace pstrips::inline formats {

inline constexpr ChunkType kHeaderChunk = chunk_type("PSHD");
inline constexpr ChunkType kSceneChunk = chunk_type("sCNE");
inline constexpr ChunkType kMaterialsChunk = chunk_type("mTRL");
inline constexpr ChunkType kMeshChunk = chunk_type("MESH");
inline constexpr ChunkType kIndexChunk = chunk_type("PIDX");
inline constexpr ChunkType kBaseChunk = chunk_type("BASE");
inline constexpr ChunkType kPacketChunk = chunk_type("PCKT");
inline constexpr ChunkType kFineChunk = chunk_type("FINE");
inline constexpr ChunkType kFacesChunk = chunk_type("fACE");
inline constexpr ChunkType kWeldingChunk = chunk_type("wELD");
inline constexpr ChunkType kOrderChunk = chunk_type("oRDP");
inline constexpr ChunkType kDigestChunk = chunk_type("dGST");
inline constexpr ChunkType kImageChunk = chunk_type("iMGE");
inline constexpr ChunkType kForeignChunk = chunk_type("fRGN");
inline constexpr ChunkType kEndChunk = chunk_type("PEND");

/// What there is at most one chunk of a type for.
enum class ChunkOf : std::uint8_t { file, mesh, packet, image, entry };

/// What is known of a type of chunk.
struct ChunkKind {
  ChunkType type{};
  /// Where it may stand: a lower rank never follows a higher one. Chunks of one rank stand mesh by
  /// mesh, of one mesh in the order of the table.
  std::uint8_t rank = 0;
  ChunkOf of = ChunkOf::file;
  Part part = Part::unknown;  ///< that its payload counts to; BASE and PCKT have parts inside
};

/// All types of chunks in file order: the order of reading and of writing. [spec/container.md §4]
inline constexpr ChunkKind kChunkKinds[] = {
    {kHeaderChunk, 0, ChunkOf::file, Part::container},
    {kSceneChunk, 1, ChunkOf::file, Part::scene},
    {kMaterialsChunk, 2, ChunkOf::file, Part::scene},
    {kMeshChunk, 3, ChunkOf::mesh, Part::mesh_header},
    {kIndexChunk, 4, ChunkOf::file, Part::packet_index},
    {kBaseChunk, 5, ChunkOf::mesh, Part::container},
    {kPacketChunk, 6, ChunkOf::packet, Part::container},
    {kFineChunk, 7, ChunkOf::mesh, Part::fine},
    {kFacesChunk, 7, ChunkOf::mesh, Part::faces},
    {kWeldingChunk, 7, ChunkOf::mesh, Part::welding},
    {kOrderChunk, 7, ChunkOf::mesh, Part::order},
    {kDigestChunk, 7, ChunkOf::mesh, Part::digest},
    {kImageChunk, 8, ChunkOf::image, Part::images},
    {kForeignChunk, 9, ChunkOf::entry, Part::foreign},
    {kEndChunk, 10, ChunkOf::file, Part::container},
};
static_assert(std::ranges::is_sorted(kChunkKinds, {}, &ChunkKind::rank));

/// The kind of that type, or null: the type is not known.
constexpr const ChunkKind* find_kind(const ChunkType& type) {
  const auto* const found = std::ranges::find(kChunkKinds, type, &ChunkKind::type);
  return found == std::end(kChunkKinds) ? nullptr : found;
}
constexpr std::uint8_t rank_of(const ChunkType& known) { return find_kind(known)->rank; }
constexpr Part part_of(const ChunkType& type) {
  const ChunkKind* const kind = find_kind(type);
  return kind == nullptr ? Part::unknown : kind->part;
}

}  // namespace pstrips::inline formats
