#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <vector>

#include "converters/inspect.h"
#include "core/limits.h"
#include "formats/pstrip/container/chunks.h"
#include "formats/pstrip/container/part.h"

namespace pstrips::cli {

/// What the bits of a binary file are spent on.
class PartTable {
 public:
  PartTable() = default;
  /// chunks  of the whole file or of what there is of it
  PartTable(const ChunkList& chunks, const Limits& limits);

  bool empty() const { return ends_.empty(); }
  /// Where the last BASE and each packet end in the file.
  const std::vector<std::uint64_t>& ends() const { return ends_; }

  /// In all, then packet by packet, a vertex each that comes with it.
  void print(std::ostream& out, const Inspection& file) const;

  using Bits = std::array<double, kPartGroups>;  ///< of each group, rounded to thousandths
  const Bits& all() const { return all_; }
  /// The base, then the packets.
  const std::vector<Bits>& packets() const { return packets_; }

 private:
  void print_packets(std::ostream& out, const Inspection& file) const;

  Bits all_{};
  std::vector<Bits> packets_;  // the base comes first
  std::vector<std::uint64_t> ends_;
};

}  // namespace pstrips::cli
