#include "formats/pstrip/payload/plain/plain.h"

#include "formats/pstrip/payload/plain/plain_fields.h"

namespace pstrips::inline formats {
namespace {

using namespace plain;

class PlainReader final : public GeometryReader {
 public:
  void read_head(ReadIo& io, BaseHead& head) override { head_fields(io, head); }
  void read_head(ReadIo& io, PacketHead& head, std::span<const ProgressiveMesh> meshes) override {
    head_fields(io, head);
    if (head.mesh < meshes.size()) growth_fields(io, head, meshes[head.mesh]);
  }
  bool read(ReadIo& io, const BaseHead& head, ProgressiveMesh& mesh) override {
    return read_arrays(io, head, mesh, {});
  }
  bool read(ReadIo& io, PacketHead& head, ProgressiveMesh& mesh,
            const PacketStart& start) override {
    return read_arrays(io, head, mesh, start);
  }

 private:
  template <class Head>
  static bool read_arrays(ReadIo& io, const Head& head, ProgressiveMesh& mesh,
                          const PacketStart& start) {
    if (!io.expect([&](SizeIo& size) { payload_fields(size, head, mesh); })) return false;
    array_fields(io, head, mesh, start);
    return io.finish();
  }
};

class PlainCodec final : public GeometryCodec {
 public:
  std::unique_ptr<GeometryReader> reader(const FileHeader&) const override {
    return std::make_unique<PlainReader>();
  }

  std::uint64_t min_packet_bytes() const override { return kPacketHeadBytes; }
  std::uint64_t min_base_bytes() const override { return kBaseHeadBytes; }
  // A vsplit takes more room in memory than its fields in the file.
  std::uint64_t max_expansion() const override { return 2; }

  std::uint64_t estimate_map_offsets(const ProgressiveMesh& mesh, std::uint64_t vsplits,
                                     std::uint64_t packets, std::uint64_t bytes) const override {
    const std::uint64_t wedges = mesh.wedges - mesh.base_wedges;
    const std::uint64_t positions = mesh.placement == Placement::optimal ? 2 : 1;
    std::uint64_t wedge_bytes = sizeof(Index);
    for (const Attribute& a : mesh.wedge_attributes) wedge_bytes += a.element_bytes();
    const bool grows = mesh.encoding == MapEncoding::triangles;
    const std::uint64_t columns = (mesh.single_wedges ? 1 : 3) + (grows ? 1 : 0);
    const std::uint64_t corners = grows ? full_map_entries(mesh) : 0;
    // What is left of the packets is reassigned wedges, few, and map offsets.
    const std::uint64_t fixed =
        packets * kPacketHeadBytes + wedges * wedge_bytes + corners * sizeof(Index) +
        vsplits * (columns * sizeof(Index) + positions * mesh.position.element_bytes());
    return bytes > fixed ? (bytes - fixed) / sizeof(Index) : 0;
  }
};

}  // namespace

const GeometryCodec& plain_codec() {
  static const PlainCodec codec;
  return codec;
}

}  // namespace pstrips::inline formats
