#include "formats/pstrip/payload/compact/compact.h"

#include "formats/pstrip/payload/compact/compact_reader.h"

namespace pstrips::inline formats {
namespace {

class CompactCodec final : public GeometryCodec {
 public:
  std::unique_ptr<GeometryReader> reader(const FileHeader& header) const override {
    return std::make_unique<CompactReader<>>(header);
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
