// Levels of meshes whose textures have seams: nothing cracks, nothing is torn from its place, and
// the base is as small as asked.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "codecs/triangulate/triangulate.h"
#include "codecs/vsplit/level.h"
#include "converters/encode.h"
#include "converters/files.h"
#include "tests/support/meshes.h"
#include "tests/support/models.h"
#include "tests/support/paths.h"
#include "tests/support/seamed_meshes.h"

namespace pstrips {
namespace {

struct Seamed {
  std::string name;
  Mesh mesh;
};

std::vector<Seamed> generated() {
  return {{"sphere in 6 charts", test::cube_sphere(12, 1)},
          {"sphere in 54 charts", test::cube_sphere(12, 3)},
          {"cylinder", test::seamed_cylinder(40, 20)},
          {"torus", test::seamed_torus(40, 24)},
          {"cube", test::cube(true)}};
}

std::vector<Seamed> from_files() {
  std::vector<Seamed> out;
  for (const char* const path :
       {"shipped/textured/charts.obj", "shipped/textured/charts.glb",
        "textured/spot/spot_triangulated.obj", "textured/texturedknot/texturedknot.obj",
        "textured/Duck-glTF-Binary/Duck.glb", "textured/blender-io/02_suzanne/02_suzanne.gltf",
        "textured/CesiumMan-glTF-Binary/CesiumMan.glb", "textured/babylon/shaderBall.glb"}) {
    if (!test::is_here(path)) continue;
    auto file = load(*test::model_path(path));
    if (file && !file->is_progressive())
      out.push_back({path, std::get<Model>(std::move(file->content)).meshes.at(0)});
  }
  return out;
}

struct Manner {
  const char* name;
  Placement placement;
  Metric metric;
};
constexpr Manner kManners[] = {
    {"subset, qem", Placement::subset, Metric::qem},
    {"subset, memoryless", Placement::subset, Metric::memoryless},
    {"optimal, qem", Placement::optimal, Metric::qem},
    {"optimal, memoryless", Placement::optimal, Metric::memoryless},
};

// In packets small enough to see many levels.
ProgressiveStrips encoded(const Mesh& mesh, const Manner& manner,
                          std::vector<SimplifyReport>* reports = nullptr) {
  Model model;
  model.meshes.push_back(mesh);
  EncodeOptions options;
  options.stripifier = "sgi-strips";
  options.packet_min = 64;
  options.placement = manner.placement;
  options.metric = manner.metric;
  auto strips = encode(model, options, {}, reports);
  EXPECT_TRUE(strips) << strips.error().message;
  return std::move(strips).value();
}

// The mesh as its base and each of its packets show it.
template <class Visit>
void for_each_level(const ProgressiveStrips& strips, Visit&& visit) {
  Level level(strips.meshes[0]);
  visit(mesh_of(level).value());
  for (const Packet& packet : strips.packets) {
    level.refine(packet.vsplits);
    visit(mesh_of(level).value());
  }
}

using Edge = std::pair<Index, Index>;

// Of vertices: how many more triangles run along an edge from its lower end than back. A surface
// without border has none that differ.
std::map<Edge, int> open_edges(const Mesh& mesh) {
  std::map<Edge, int> out;
  const Triangulation t = triangulate(mesh);
  for (std::size_t c = 0; c < t.corners.size(); ++c) {
    const Index a = mesh.vertex_of(t.corners[c]);
    const Index b = mesh.vertex_of(t.corners[c % 3 == 2 ? c - 2 : c + 1]);
    out[std::minmax(a, b)] += a < b ? 1 : -1;
  }
  std::erase_if(out, [](const auto& edge) { return edge.second == 0; });
  return out;
}

// A place as its bits.
using Place = std::array<std::uint64_t, 3>;
Place place_of(const Mesh& mesh, Index vertex) {
  Place out;
  for (std::size_t c = 0; c < 3; ++c) {
    const double x = component(mesh.position, vertex, c);
    std::memcpy(&out[c], &x, sizeof x);
  }
  return out;
}

// What shows at corners: a place and, as they stand, the bytes of all attributes.
using Look = std::pair<Place, Bytes>;
std::vector<Look> looks(const Mesh& mesh) {
  std::vector<Look> out;
  for (const Index w : triangulate(mesh).corners) {
    Bytes bytes;
    for (const Attribute& a : mesh.wedge_attributes) {
      const ByteView element = a.element(w);
      bytes.insert(bytes.end(), element.begin(), element.end());
    }
    out.emplace_back(place_of(mesh, mesh.vertex_of(w)), std::move(bytes));
  }
  return out;
}

// Places with more than one wedge in use.
std::set<Place> seam_places(const Mesh& mesh) {
  std::map<Index, std::set<Index>> wedges;
  for (const Index w : triangulate(mesh).corners) wedges[mesh.vertex_of(w)].insert(w);
  std::set<Place> out;
  for (const auto& [vertex, its_wedges] : wedges)
    if (its_wedges.size() > 1) out.insert(place_of(mesh, vertex));
  return out;
}

TEST(TexturedLevels, DoNotCrackAtSeams) {
  for (const Seamed& seamed : generated()) {
    SCOPED_TRACE(seamed.name);
    const std::size_t border = open_edges(seamed.mesh).size();
    EXPECT_EQ(border, seamed.name == "cylinder" ? 80u : 0u);
    for (const Manner& manner : kManners) {
      SCOPED_TRACE(manner.name);
      std::size_t before = 0;  // coarse levels come first
      for_each_level(encoded(seamed.mesh, manner), [&](const Mesh& level) {
        const std::size_t open = open_edges(level).size();
        EXPECT_GE(open, before);
        EXPECT_LE(open, border);
        before = open;
      });
      EXPECT_EQ(before, border);
    }
  }
}

TEST(TexturedLevels, OfFilesDoNotCrackEither) {
  const auto models = from_files();
  ASSERT_GE(models.size(), 2u);
  for (const Seamed& seamed : models) {
    SCOPED_TRACE(seamed.name);
    const auto border = open_edges(seamed.mesh);
    for_each_level(encoded(seamed.mesh, kManners[0]),
                   [&](const Mesh& level) { EXPECT_LE(open_edges(level).size(), border.size()); });
  }
}

TEST(TexturedLevels, KeepSeamsWhereTheyAre) {
  // Without moving vertices, a place has at any level the looks it has in the end, unless a wedge
  // was carried to it: that is dear, and happens where a chart has hardly two triangles.
  for (const Seamed& seamed : generated()) {
    SCOPED_TRACE(seamed.name);
    const auto all = looks(seamed.mesh);
    const std::set<Look> known(all.begin(), all.end());
    const std::set<Place> seams = seam_places(seamed.mesh);
    for_each_level(encoded(seamed.mesh, kManners[1]), [&](const Mesh& level) {
      const auto shown = looks(level);
      const auto strange =
          std::ranges::count_if(shown, [&](const Look& look) { return !known.contains(look); });
      const auto off_seam = std::ranges::count_if(
          seam_places(level), [&](const Place& place) { return !seams.contains(place); });
      EXPECT_LE(strange,
                shown.size() < 3 * 200 ? static_cast<std::ptrdiff_t>(shown.size() / 3) : 0);
      EXPECT_EQ(off_seam, 0);
    });
  }
}

TEST(TexturedLevels, ReachTheBaseAskedFor) {
  std::vector<Seamed> all = generated();
  for (Seamed& model : from_files()) all.push_back(std::move(model));
  for (const Seamed& seamed : all) {
    SCOPED_TRACE(seamed.name);
    const std::size_t triangles = triangulate(seamed.mesh).face.size();
    for (const Manner& manner : kManners) {
      SCOPED_TRACE(manner.name);
      std::vector<SimplifyReport> reports;
      const ProgressiveStrips strips = encoded(seamed.mesh, manner, &reports);
      // A small mesh keeps a tetrahedron.
      EXPECT_LE(strips.bases[0].triangles, std::max<std::size_t>(triangles / 20, 4));
      ASSERT_EQ(reports.size(), 1u);
      EXPECT_EQ(reports[0].stop, SimplifyStop::target);
    }
  }
}

}  // namespace
}  // namespace pstrips
