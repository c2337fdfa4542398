#pragma once

#include <cassert>
#include <string>

#include "formats/pstrip/container/binary.h"
#include "formats/pstrip/xml/xml.h"
#include "tests/validators/chunk_file.h"
#include "tests/validators/corpus.h"

namespace pstrips::test {

// Ways to break a valid file.

inline Bytes written(const ProgressiveStrips& strips) {
  return write_binary_unchecked(strips).value();
}

template <class Edit>
Bytes edited(ProgressiveStrips strips, Edit edit) {
  edit(strips);
  return written(strips);
}
/// Edits the first mesh.
template <class Edit>
Bytes edited_mesh(ProgressiveStrips strips, Edit edit) {
  edit(strips.meshes[0]);
  return written(strips);
}
/// Edits chunks; sizes and offsets are left as they were.
template <class Edit>
Bytes recut(const ProgressiveStrips& strips, Edit edit) {
  ChunkFile file(written(strips));
  edit(file);
  return file.bytes();
}
/// Edits chunks and brings sizes and offsets in line.
template <class Edit>
Bytes settled(const ProgressiveStrips& strips, Edit edit) {
  ChunkFile file(written(strips));
  edit(file);
  return file.settle().bytes();
}
template <class Edit>
Bytes edited_bytes(const ProgressiveStrips& strips, Edit edit) {
  Bytes bytes = written(strips);
  edit(bytes);
  return bytes;
}
/// Replaces the first such text of the XML variant.
inline Bytes reworded(const ProgressiveStrips& strips, std::string_view from, std::string_view to) {
  const Bytes bytes = write_xml(strips);
  std::string text(as_text(bytes));
  const std::size_t at = text.find(from);
  assert(at != std::string::npos);
  if (at == std::string::npos) return {};
  text.replace(at, from.size(), to);
  const ByteView view = as_bytes(text);
  return Bytes(view.begin(), view.end());
}

/// A file of the corpus: how it is called and how it is made.
struct Case {
  const char* name;
  Bytes (*make)();
};
extern const std::span<const Case> kContainerCases, kModelCases, kXmlCases, kCompactCases;

}  // namespace pstrips::test
