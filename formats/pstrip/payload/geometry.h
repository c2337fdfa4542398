#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/progressive_strips.h"
#include "formats/pstrip/container/chunks.h"
#include "formats/pstrip/container/part.h"
#include "formats/pstrip/payload/check.h"
#include "formats/pstrip/payload/io.h"

// The seam between what all profiles share (chunks, packets, index, model, rules) and how one of
// them codes the geometry: the payloads of BASE and PCKT.
//
// A profile is a folder beside payload/plain with a GeometryCodec, one row in kCodecs
// (geometry.cpp) and one in kProfiles (core/profile.h). Nothing else knows how many bytes a record
// takes.

namespace pstrips::inline formats {

/// What a BASE says of itself, however it is coded. [spec/container.md §7.1]
struct BaseHead {
  Index mesh = 0, vertices = 0, wedges = 0, map_entries = 0;
};

/// What a PCKT says of itself. [spec/container.md §7.2]
struct PacketHead {
  Index mesh = 0, first_vsplit = 0, vsplits = 0, wedges = 0, reassigned = 0, map_offsets = 0;
};

/// Reads the geometry of one file, chunk by chunk in file order, so that it may keep a state for
/// each mesh. A head is read first; the caller judges it before it reads the rest.
///
/// What breaks a demand goes to the ReadIo; then the functions that return bool return false, and
/// the caller takes back what the chunk brought.
class GeometryReader {
 public:
  virtual ~GeometryReader() = default;

  virtual void read_head(layout::ReadIo& io, BaseHead& head) = 0;
  virtual void read_head(layout::ReadIo& io, PacketHead& head) = 0;

  /// Fills positions, wedge vertices, wedge attributes and index map of the base, none of which are
  /// there yet. Precondition: the head agrees with the counts of the mesh.
  virtual bool read(layout::ReadIo& io, const BaseHead& head, ProgressiveMesh& mesh) = 0;
  /// Appends head.vsplits records (parent, wedges, reassigned), and to wedge_offset_counts,
  /// map_offsets, reassigned and the attributes what they bring. Counts need not add up yet.
  ///
  /// start  where the lists of the mesh end now
  virtual bool read(layout::ReadIo& io, const PacketHead& head, ProgressiveMesh& mesh,
                    const PacketStart& start) = 0;
};

/// Writes the geometry of one file. Sizes are known before anything is written, so that offsets can
/// be; chunks may be written in any order and more than once.
class GeometryWriter {
 public:
  virtual ~GeometryWriter() = default;

  virtual std::uint64_t base_bytes(Index mesh) = 0;
  virtual std::uint64_t packet_bytes(std::size_t packet) = 0;
  /// payload  of that many bytes, all zero
  virtual void write_base(Index mesh, std::span<std::byte> payload) = 0;
  virtual void write_packet(std::size_t packet, std::span<std::byte> payload) = 0;
};

/// From here to the next mark, bytes of a payload belong to a part.
struct PartMark {
  Part part = Part::container;
  std::uint64_t position = 0;  ///< in the payload
};

/// How one profile codes the geometry.
class GeometryCodec {
 public:
  virtual std::unique_ptr<GeometryReader> reader() const = 0;
  /// strips  outlives the writer
  virtual std::unique_ptr<GeometryWriter> writer(const ProgressiveStrips& strips) const = 0;

  /// No payload of a PCKT is shorter, and none of a BASE.
  virtual std::uint64_t min_packet_bytes() const = 0;
  virtual std::uint64_t min_base_bytes() const = 0;
  /// Bytes of memory that a byte of payload may come to, at most: what may be reserved ahead.
  virtual std::uint64_t max_expansion() const = 0;
  /// About how many map offsets packets bring to a mesh of which the header is known.
  ///
  /// payload_bytes  of all packets of the mesh together
  virtual std::uint64_t estimate_map_offsets(const ProgressiveMesh& mesh, std::uint64_t vsplits,
                                             std::uint64_t packets,
                                             std::uint64_t payload_bytes) const = 0;

  /// Which bytes of the payload of a BASE or PCKT belong to what: marks ascending from 0. Empty
  /// when the payload does not fit its own counts.
  ///
  /// meshes  as far as MESH describes them
  virtual std::vector<PartMark> parts(const Chunk& chunk,
                                      std::span<const ProgressiveMesh> meshes) const = 0;
  /// The byte of the payload where an element of a list of the mesh stands; 0 when it is in none.
  ///
  /// list  the address of a list of `mesh`; `element` counts from where the chunk's part begins
  virtual std::uint64_t position_of(const Chunk& chunk, const ProgressiveMesh& mesh,
                                    const void* list, std::uint64_t element) const = 0;

 protected:
  ~GeometryCodec() = default;
};

/// The codec of the profile.
const GeometryCodec& codec_of(Profile profile);

}  // namespace pstrips::inline formats
