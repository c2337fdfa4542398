#include "formats/pstrip/container/chunk_order.h"

namespace pstrips::inline formats {

ChunkOrder::Broken ChunkOrder::add(const ChunkType& type) {
  if (rank_ < 0 && type != kHeaderChunk) return {Fault::first_chunk, {}};
  const ChunkKind* const kind = find_kind(type);
  if (kind == nullptr) return {};
  std::uint32_t& there = counts_[static_cast<std::size_t>(kind - std::begin(kChunkKinds))];
  if (kind->of == ChunkOf::file && there != 0) return {Fault::chunk_twice, {}};
  if (kind->rank < rank_) return {Fault::chunk_order, {}};
  constexpr int kIndexRank = rank_of(kIndexChunk);
  if (kind->rank > kIndexRank && rank_ < kIndexRank) return {Fault::index_missing, {}};
  if (Broken broken = broken_count(*kind); broken.fault != Fault::none) return broken;
  rank_ = kind->rank;
  ++there;
  return {};
}

ChunkOrder::Broken ChunkOrder::broken_count(const ChunkKind& kind) const {
  if (!totals_) return {};
  struct Counted {
    ChunkType type;
    std::uint32_t wanted;
    Fault fault;
  };
  for (const auto& [type, wanted, fault] :
       {Counted{kMeshChunk, totals_->meshes, Fault::mesh_chunks},
        Counted{kBaseChunk, totals_->meshes, Fault::base_chunks},
        Counted{kPacketChunk, totals_->packets, Fault::packet_chunks}}) {
    const std::uint32_t there = count(type);
    if (kind.type == type && there == wanted) return {fault, "more than " + std::to_string(wanted)};
    if (kind.rank > rank_of(type) && there < wanted)
      return {fault, std::to_string(there) + " of " + std::to_string(wanted)};
  }
  return {};
}

}  // namespace pstrips::inline formats
