#pragma once

#include <sstream>
#include <string>

#include "formats/ply/ply.h"

namespace pstrips::test {

inline std::string describe(const Attribute& a) {
  std::ostringstream out;
  out << a.semantic << ' ' << name_of(a.type) << 'x' << int(a.count) << (a.normalized ? "n" : "");
  for (std::size_t i = 0; i < a.elements(); ++i)
    for (std::size_t c = 0; c < a.count; ++c) out << (c == 0 ? " " : ",") << component(a, i, c);
  return out.str();
}

/// A mesh as one line: position, wedge attributes, vertices of wedges (W), faces (F), their
/// attributes and groups (G), each where there are some.
inline std::string describe(const Mesh& mesh) {
  std::ostringstream out;
  out << describe(mesh.position);
  for (const Attribute& a : mesh.wedge_attributes) out << " | " << describe(a);
  if (!mesh.wedge_vertex.empty()) out << " | W";
  for (const Index v : mesh.wedge_vertex) out << ' ' << v;
  if (mesh.face_count() != 0) out << " | F";
  for (Index f = 0; f < mesh.face_count(); ++f) {
    out << ' ';
    for (std::size_t k = 0; k < mesh.face(f).size(); ++k) out << (k ? "," : "") << mesh.face(f)[k];
    if (mesh.face(f).empty()) out << '-';
  }
  for (const Attribute& a : mesh.face_attributes) out << " | " << describe(a);
  if (!mesh.face_group.empty()) out << " | G";
  for (const Index g : mesh.face_group) out << ' ' << g;
  return out.str();
}

inline constexpr PlyWriteOptions::Format kFormats[] = {PlyWriteOptions::Format::ascii,
                                                       PlyWriteOptions::Format::little_endian,
                                                       PlyWriteOptions::Format::big_endian};

/// Whether a model comes back the same in all formats; else what happened.
inline std::string round_trip_failure(const Model& model) {
  for (const auto format : kFormats) {
    const std::string name = "format " + std::to_string(int(format)) + ": ";
    const auto file = write_ply(model, {format});
    if (!file) return name + "write: " + file.error().message;
    const auto again = read_ply(*file);
    if (!again) return name + "read: " + again.error().message + ' ' + again.error().path;
    if (*again != model) return name + "models differ";
  }
  return {};
}

}  // namespace pstrips::test
