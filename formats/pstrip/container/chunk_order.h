#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "core/fault.h"
#include "formats/pstrip/container/chunk_table.h"

namespace pstrips::inline formats {

/// Follows the chunks of a file and says which may not stand where it stands. [spec/container.md
/// §4]
class ChunkOrder {
 public:
  /// What PSHD declares: from now on the chunks of meshes and packets are counted.
  void declare(std::uint32_t meshes, std::uint32_t packets) { totals_ = Totals{meshes, packets}; }

  struct Broken {
    Fault fault = Fault::none;
    std::string found;  ///< how many chunks there are instead; may be empty
  };
  /// Takes the next chunk and says what is broken where it stands; none: nothing.
  Broken add(const ChunkType& type);

 private:
  struct Totals {
    std::uint32_t meshes = 0, packets = 0;
  };

  /// The chunks of which there is one a mesh or packet are all there before what follows them.
  Broken broken_count(const ChunkKind& kind) const;
  std::uint32_t count(const ChunkType& type) const {
    return counts_[static_cast<std::size_t>(find_kind(type) - std::begin(kChunkKinds))];
  }

  std::optional<Totals> totals_;
  std::array<std::uint32_t, std::size(kChunkKinds)> counts_{};  ///< chunks of each type so far
  int rank_ = -1;                                               ///< of the last known chunk
};

}  // namespace pstrips::inline formats
