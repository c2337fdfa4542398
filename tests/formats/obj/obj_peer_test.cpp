#include <gtest/gtest.h>
#include <tiny_obj_loader.h>

#include <cmath>

#include "tests/formats/obj/models.h"
#include "tests/formats/obj/support.h"
#include "tests/support/paths.h"

namespace pstrips::test {
namespace {

/// The peer scales by powers of ten in doubles, right to about 15 digits; a float is the nearest.
bool near(const Attribute& mine, std::size_t i, std::size_t c, double theirs) {
  const double value = component(mine, i, c);
  if (!std::isfinite(value)) return true;  // it reads 1.#IND as 1
  const double tolerance = mine.type == ComponentType::f32 ? 0x1p-24 * (1 + 1e-6) : 1e-14;
  return std::abs(value - theirs) <= tolerance * std::abs(theirs) + 1e-45;
}

/// The value of an attribute at a wedge agrees with the peer's tuple; an index of nothing is none.
bool same_tuple(const Attribute* mine, Index wedge, const std::vector<tinyobj::real_t>& theirs,
                int index, std::size_t width) {
  const bool is_there = index >= 0 && width * static_cast<std::size_t>(index) < theirs.size();
  if (!is_there) return true;
  if (!mine) return false;
  for (std::size_t c = 0; c < width; ++c)
    if (!near(*mine, wedge, c, theirs[width * static_cast<std::size_t>(index) + c])) return false;
  return true;
}

/// What differs between the two readings of a file, or nothing. The peer leaves out faces of fewer
/// than three corners.
std::string difference(const Mesh& mesh, const tinyobj::ObjReader& peer) {
  const auto& attrib = peer.GetAttrib();
  if (attrib.vertices.size() != std::size_t{3} * mesh.vertex_count()) return "vertex count";
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    for (std::size_t c = 0; c < 3; ++c)
      if (!near(mesh.position, v, c, attrib.vertices[std::size_t{3} * v + c]))
        return "position of vertex " + std::to_string(v);
  const Attribute* texcoord = find_attribute(mesh.wedge_attributes, "TEXCOORD_0");
  const Attribute* normal = find_attribute(mesh.wedge_attributes, "NORMAL");
  Index f = 0;
  const auto skip = [&] {
    while (f < mesh.face_count() &&
           (mesh.groups[mesh.group_of(f)].kind != FaceKind::polygons || mesh.face(f).size() < 3))
      ++f;
  };
  for (const tinyobj::shape_t& shape : peer.GetShapes()) {
    std::size_t first = 0;
    for (const std::size_t size : shape.mesh.num_face_vertices) {
      skip();
      if (f == mesh.face_count() || mesh.face(f).size() != size) return "face " + std::to_string(f);
      for (std::size_t k = 0; k < size; ++k) {
        const tinyobj::index_t& corner = shape.mesh.indices[first + k];
        const Index w = mesh.face(f)[k];
        if (mesh.vertex_of(w) != static_cast<Index>(corner.vertex_index) ||
            !same_tuple(texcoord, w, attrib.texcoords, corner.texcoord_index, 2) ||
            !same_tuple(normal, w, attrib.normals, corner.normal_index, 3))
          return "corner of face " + std::to_string(f);
      }
      first += size;
      ++f;
    }
  }
  skip();
  return f == mesh.face_count() ? "" : "face count";
}

TEST(ObjPeer, TinyobjloaderReadsTheSame) {
  std::size_t compared = 0;
  for (const auto& [name, path] : model_files({".obj"})) {
    if (path.filename() == "box_longline.obj") continue;  // 936 corners; it counts them in a byte
    const std::string text = load(path);
    const auto model = read_text(text);
    if (!model) continue;
    tinyobj::ObjReader peer;
    tinyobj::ObjReaderConfig config;
    config.triangulate = false;
    if (!peer.ParseFromString(text, "", config)) continue;
    ++compared;
    EXPECT_EQ(difference(model->meshes[0], peer), "") << path;
  }
  EXPECT_GT(compared, 0u);
  RecordProperty("compared", static_cast<int>(compared));
}

}  // namespace
}  // namespace pstrips::test
