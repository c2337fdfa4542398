#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/progressive_strips.h"
#include "formats/pstrip/container/chunks.h"
#include "formats/pstrip/container/header.h"
#include "formats/pstrip/container/part.h"
#include "formats/pstrip/payload/check.h"
#include "formats/pstrip/payload/io.h"

// The seam between what all profiles share (chunks, packets, index, model, rules) and how one of
// them codes the geometry: the payloads of BASE and PCKT.
//
// A profile is a folder beside payload/plain with a GeometryCodec and a GeometryLayout, a row each
// in kCodecs (geometry.cpp) and kLayouts (geometry_layout.cpp), and one in kProfiles
// (core/profile.h). Nothing else knows how many bytes a record takes.

namespace pstrips::inline formats {

/// What a BASE says of itself, however it is coded. [spec/container.md §7.1]
struct BaseHead {
  Index mesh = 0, vertices = 0, wedges = 0, map_entries = 0;
};

/// What a PCKT says of itself. [spec/container.md §7.2]
struct PacketHead {
  Index mesh = 0, first_vsplit = 0, vsplits = 0, wedges = 0, reassigned = 0, map_offsets = 0;
  Index triangles = 0;  ///< that are appended to the map
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
  /// meshes  as far as they are there; the one that the head names may not be
  virtual void read_head(layout::ReadIo& io, PacketHead& head,
                         std::span<const ProgressiveMesh> meshes) = 0;

  /// Fills positions, wedge vertices, wedge attributes, index map and groups of triangles of the
  /// base, none of which are there yet. Precondition: the head agrees with the counts of the mesh.
  virtual bool read(layout::ReadIo& io, const BaseHead& head, ProgressiveMesh& mesh) = 0;
  /// Appends head.vsplits records (parent, wedges, reassigned, triangles), and to
  /// wedge_offset_counts, map_offsets, reassigned, new_corners, triangle_group and the attributes
  /// what they bring. Counts need not add up yet.
  ///
  /// head   gets the counts that the records tell and read_head() did not
  /// start  where the lists of the mesh end now
  virtual bool read(layout::ReadIo& io, PacketHead& head, ProgressiveMesh& mesh,
                    const PacketStart& start) = 0;

  /// Some numbers of the mesh have bits that its packets leave out; FINE brings them.
  virtual bool needs_fine(Index mesh) const;
  /// The rest of a FINE: completes the mesh. Precondition: all packets of it are there, and
  /// needs_fine().
  virtual bool read_fine(layout::ReadIo& io, Index index, ProgressiveMesh& mesh);

  /// fACE is coded by this profile, too. Otherwise its fields are those of the plain profile.
  virtual bool codes_faces() const;
  /// The rest of a fACE: fills the table of a mesh whose packets are all there.
  ///
  /// faces  of the decoded mesh, as MESH says
  virtual bool read_faces(layout::ReadIo& io, Index faces, ProgressiveMesh& mesh);
};

/// How one profile codes the geometry, as far as a decoder is concerned; geometry_layout.h has the
/// rest.
class GeometryCodec {
 public:
  /// header  of the file: no more is granted than it announces
  virtual std::unique_ptr<GeometryReader> reader(const FileHeader& header) const = 0;

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

 protected:
  ~GeometryCodec() = default;
};

/// The codec of the profile.
const GeometryCodec& codec_of(Profile profile);

}  // namespace pstrips::inline formats
