#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/limits.h"
#include "formats/pstrip/payload/geometry.h"
#include "formats/pstrip/payload/layout.h"
#include "formats/pstrip/payload/reservation.h"

namespace pstrips::inline formats {

/// How far payloads are judged.
enum class PayloadChecks : std::uint8_t {
  fields,  ///< what the bytes of a payload must satisfy; the model is judged elsewhere
  model,   ///< also what payload/check.h demands: every index may be followed
};

/// Builds the model from payloads, chunk by chunk in file order. [spec/container.md §5 to §9]
///
/// What breaks a demand goes to the sink. A chunk that is refused leaves the model as it was; with
/// PayloadChecks::fields the mesh of a refused MESH stays, so that places in it can be named.
class PayloadDecoder {
 public:
  /// file_bytes  the size of the file when it is known, else 0; memory is then reserved at once
  PayloadDecoder(const Limits& limits, PayloadChecks checks, FaultSink& faults,
                 std::uint64_t file_bytes = 0)
      : limits_(limits), checks_(checks), faults_(faults), file_bytes_(file_bytes) {
    strips_.complete = false;
  }

  using MakeReader =
      std::function<std::unique_ptr<GeometryReader>(Profile profile, const FileHeader& header)>;
  /// Has BASE and PCKT read by another reader than that of the profile.
  /// Precondition: no chunk was decoded yet.
  void use_reader(MakeReader make) { make_reader_ = std::move(make); }

  /// Takes the next chunk. False when it is refused; then no more may follow.
  /// Precondition: its frame is sound and the order of chunks holds.
  bool decode(const Chunk& chunk);

  ProgressiveStrips& strips() { return strips_; }  ///< `complete` once PEND is there
  const ProgressiveStrips& strips() const { return strips_; }
  const std::optional<FileHeader>& header() const { return header_; }
  const std::vector<IndexRow>& index() const { return rows_; }
  const std::vector<layout::MeshCounts>& counts() const { return counts_; }  ///< of each MESH
  const std::vector<std::uint8_t>& embedded() const { return embedded_; }    ///< one an image
  /// The mesh that the last chunk was about, if it was about one.
  Index mesh() const { return mesh_; }
  /// Every BASE is there.
  bool has_base() const { return has_index_ && strips_.bases.size() == strips_.meshes.size(); }
  /// Meshes of which a FINE chunk has completed the numbers, ascending.
  std::span<const Index> completed_meshes() const { return fine_; }

 private:
  using ReadIo = layout::ReadIo;

  bool read(const Chunk& chunk, ReadIo& io);
  bool read_header(ReadIo& io);
  bool read_scene(ReadIo& io);
  bool read_materials(ReadIo& io);
  bool read_mesh(ReadIo& io);
  bool check_mesh(const layout::MeshCounts& counts);
  bool read_index(ReadIo& io);
  bool read_base(ReadIo& io);
  bool read_packet(ReadIo& io);
  bool read_fine(ReadIo& io);
  bool read_faces(ReadIo& io);
  /// Chunks at the end ascend by mesh, then in the order of the table.
  bool is_in_order(const ChunkType& type, Index mesh);
  template <class Extra>
  bool read_extra(ReadIo& io, Extra extra);
  bool read_image(ReadIo& io);
  bool read_foreign(ReadIo& io);
  bool read_end(ReadIo& io);

  bool checks_model() const { return checks_ == PayloadChecks::model; }
  /// Reports a fault of the current chunk.
  bool refuse(Fault fault, std::string found = {});
  bool goes_on(Fault fault, std::string text = {});
  /// Refuses the chunk unless there is no fault.
  bool holds(Fault fault) { return fault == Fault::none || refuse(fault); }
  bool within(std::uint64_t figure, const char* what, std::uint64_t limit, const Where& where);
  bool names_mesh(Index mesh, Fault otherwise);
  /// What PIDX says of the current BASE or PCKT; null when it says nothing.
  const IndexRow* row() const;

  Limits limits_;
  PayloadChecks checks_;
  FaultSink& faults_;
  std::uint64_t file_bytes_;
  Reservation reservation_;

  ProgressiveStrips strips_;
  std::optional<FileHeader> header_;
  std::vector<IndexRow> rows_;
  std::vector<layout::MeshCounts> counts_;
  std::vector<std::uint8_t> embedded_;
  MakeReader make_reader_;
  std::unique_ptr<GeometryReader> geometry_;
  std::vector<PacketStart> reached_;  ///< per mesh, where its next packet starts
  std::vector<Index> fine_;           ///< meshes that are complete, ascending
  bool has_index_ = false;
  std::int64_t extra_ = -1, image_ = -1;  ///< the last ones, as numbers that ascend

  const Chunk* chunk_ = nullptr;  ///< the current one
  Index mesh_ = kNone;
};

}  // namespace pstrips::inline formats
