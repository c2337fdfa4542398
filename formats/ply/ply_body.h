#pragma once

#include <span>
#include <vector>

#include "formats/ply/ply_header.h"
#include "formats/ply/ply_runs.h"

namespace pstrips::inline formats::ply {

/// A list property: `sizes` has a value count for each row, `values` all of them, packed.
struct ListColumn {
  std::vector<std::uint32_t> sizes;
  Bytes values;
};

/// Faces as they arrive: triangles until one is none.
struct FaceLists {
  std::vector<Index> corners;
  std::vector<Index> first;  ///< as Mesh::face_first
};

/// Where a property's values go. Values are packed little-endian.
struct Sink {
  enum class Kind : std::uint8_t { scalars, list, faces };
  Kind kind = Kind::scalars;
  ComponentType stored = ComponentType::f32;  ///< scalars: the property's own type or f64
  std::byte* data = nullptr;                  ///< scalars: where row 0 goes
  std::size_t stride = 0;                     ///< scalars: bytes from a row to the next
  ListColumn* list = nullptr;
  FaceLists* faces = nullptr;
};

/// What readers check while they read.
struct BodyLimits {
  std::uint64_t vertices = 0;  ///< indices are below it
  std::uint64_t corners = 0;   ///< of all faces together
  std::uint64_t memory_bytes = 0;
};

/// Reads elements one after the other; an ascii body in runs, on several threads.
class BodyReader {
 public:
  /// Text is cut into runs of about run_bytes. What is read and what is refused depends on neither
  /// that nor the threads.
  BodyReader(ByteView file, std::uint64_t body, Encoding encoding, const BodyLimits& limits,
             unsigned threads, std::size_t run_bytes);

  /// Whether the rows can be there at all. Called before a sink is made for them.
  /// Errors: truncated. After it, rows × bytes of a row cannot overflow.
  Result<void> expect(const Element& element) const;

  /// Reads element.count rows; precondition: expect() was content, one sink a property.
  Result<void> read(const Element& element, std::span<const Sink> sinks);

  /// The bytes after the last element, ascii white space aside.
  ByteView rest() const;
  std::uint64_t position() const { return position_; }

 private:
  bool read_in_runs(const Element& element, std::span<const Sink> sinks);

  ByteView file_;
  std::uint64_t position_;
  Encoding encoding_;
  BodyLimits limits_;
  unsigned threads_;
  std::vector<Run> runs_;   ///< empty: one thread reads all
  std::uint64_t rows_ = 0;  ///< ascii: of the elements read
};

/// Where a property's values come from, the mirror of Sink.
struct Source {
  enum class Kind : std::uint8_t { scalars, list, indices };
  Kind kind = Kind::scalars;
  ComponentType stored = ComponentType::f32;  ///< scalars: the property's own type or f64
  const std::byte* data = nullptr;            ///< scalars: row 0; list: all values, of the own type
  std::size_t stride = 0;                     ///< scalars
  const std::uint32_t* sizes = nullptr;       ///< list: values of each row; null: see below
  const Index* indices = nullptr;             ///< indices: all values
  const Index* first = nullptr;         ///< bounds of faces as Mesh::face_first; null: triangles
  std::uint32_t values_per_corner = 1;  ///< with `first` or triangles

  std::size_t size(std::size_t row) const {
    if (sizes != nullptr) return sizes[row];
    return values_per_corner * std::size_t{first == nullptr ? 3 : first[row + 1] - first[row]};
  }
};

/// Bytes of element.count rows; in ascii a guess for reserving memory.
std::size_t expected_bytes(const Element& element, std::span<const Source> sources,
                           Encoding encoding);

/// Appends element.count rows; text is made on up to `threads` threads. Precondition: the values
/// fit the property types.
void write_rows(const Element& element, std::span<const Source> sources, Encoding encoding,
                unsigned threads, Bytes& out);

}  // namespace pstrips::inline formats::ply
