#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/fault_list.h"
#include "core/limits.h"
#include "core/progressive_strips.h"
#include "formats/pstrip/container/binary.h"
#include "formats/pstrip/container/chunk_table.h"
#include "formats/pstrip/container/chunks.h"
#include "formats/pstrip/payload/layout.h"
#include "formats/pstrip/xml/xml.h"
#include "validators/replay.h"

namespace pstrips::inline validators {

/// Where a value stands in the file.
struct Location {
  std::uint64_t offset = kNoOffset;
  std::string path;
};

/// How far a file could be taken apart. Each step is only taken when the one before found nothing
/// that would make it meaningless.
enum class Depth : std::uint8_t {
  frame,     ///< chunks or markup
  payloads,  ///< the fields of each chunk or element, one by one
  model,     ///< ProgressiveStrips, with lists of matching lengths
  replayed,  ///< every level of every mesh
};

/// The chunks of one mesh, as numbers into ChunkList::chunks.
struct MeshChunks {
  std::map<ChunkType, Index> of_type;  ///< those of which a mesh has one
  std::vector<Index> packets;

  /// kNone: not there.
  Index find(const ChunkType& type) const {
    const auto found = of_type.find(type);
    return found == of_type.end() ? kNone : found->second;
  }
};

/// A file as the rules look at it: what its bytes say, unjudged, and the faults noticed on the way.
struct Document {
  ByteView file;
  bool xml = false;
  Depth depth = Depth::frame;
  bool ended_early = false;  ///< truncated; what is there can still be judged
  Faults faults;

  // The binary variant's frame; empty for XML.
  ChunkList frame;
  std::vector<MeshChunks> mesh_chunks;
  std::optional<FileHeader> header;
  std::vector<IndexRow> index;
  std::vector<bool> image_embedded;

  // Both variants. Counts that a MESH chunk declares are in `declared`, those of its lists in
  // `strips`; rules compare the two.
  ProgressiveStrips strips;
  std::vector<layout::MeshCounts> declared;
  std::vector<std::vector<Index>> packets_of;  ///< of each mesh, as numbers into strips.packets
  std::vector<Replay> replays;                 ///< one a mesh, once `depth` is replayed

  // The XML variant's lines.
  XmlLocations lines;
  std::string stopped_at;  ///< path of the element where reading stopped; empty: nowhere

  std::function<Location(const Document&, const Where&)> locate;
};

/// Takes a binary file apart. Never fails: what cannot be read is a fault.
///
/// cost  O(file); memory O(file)
Document open_binary(ByteView file, const Limits& limits);

/// The same for the XML variant.
Document open_xml(ByteView file, const Limits& limits);

/// Replays each mesh of which the base is there; `depth` becomes replayed.
/// Precondition: the rules of Stage::base hold.
void replay_all(Document& doc);

}  // namespace pstrips::inline validators
