#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/progressive_strips.h"
#include "core/result.h"
#include "formats/pstrip/container/chunks.h"
#include "formats/pstrip/container/part.h"
#include "formats/pstrip/payload/geometry.h"

namespace pstrips::inline formats {

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

  /// The payload of FINE; 0: the mesh needs none.
  virtual std::uint64_t fine_bytes(Index mesh);
  virtual void write_fine(Index mesh, std::span<std::byte> payload);

  /// The payload of fACE where the profile codes it; null: its fields are those of the plain one.
  virtual const Bytes* coded_faces(Index mesh) const;
};

/// From here to the next mark, bytes of a payload belong to a part.
struct PartMark {
  Part part = Part::container;
  std::uint64_t position = 0;  ///< in the payload
};

/// How one profile lays out the geometry, for those who write, list or point into payloads. A
/// decoder does without it.
class GeometryLayout {
 public:
  /// strips  outlives the writer
  /// errors  what this profile cannot hold
  virtual Result<std::unique_ptr<GeometryWriter>> writer(const ProgressiveStrips& strips) const = 0;

  /// A reader of one file that adds to `bits` what the codes of each chunk take, by part. One that
  /// adds nothing will do where all of them are whole bytes.
  ///
  /// bits  outlives the reader
  virtual std::unique_ptr<GeometryReader> counting_reader(const FileHeader& header,
                                                          PartBits& bits) const = 0;

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
  ~GeometryLayout() = default;
};

/// The layout of the profile.
const GeometryLayout& layout_of(Profile profile);

}  // namespace pstrips::inline formats
