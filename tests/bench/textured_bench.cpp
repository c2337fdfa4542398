// What textured models look like at coarse levels: pictures from twelve sides, ours beside
// meshopt_simplify, compared with pictures of the original. Writes CSV to standard output and, with
// --sheets, a picture of each model at 5 %; textured.py makes tables of it.
//
//   textured_bench [--sheets FOLDER] [--size N] [--only VARIANT] [--weight SEMANTIC=W …] [MODEL …]
//   MODEL is a path in the folder of models or "charts", a generated sphere of 864 charts; weights
//   are those of `convert --attribute-weight`

#include <fmt/format.h>
#include <meshoptimizer.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "codecs/measure/measure.h"
#include "codecs/render/rasterizer.h"
#include "codecs/triangulate/triangulate.h"
#include "codecs/vsplit/level.h"
#include "converters/encode.h"
#include "converters/files.h"
#include "core/file.h"
#include "tests/support/appearance.h"
#include "tests/support/paths.h"
#include "tests/support/seamed_meshes.h"

namespace pstrips::bench {
namespace {

namespace fs = std::filesystem;
using namespace pstrips::test;

constexpr double kShares[] = {0.2, 0.05, 0.01};
constexpr double kSheetShare = 0.05;
// Textures finer than a picture's pixels would flicker with every shift.
constexpr Index kMaxTexels = 512;

struct Options {
  std::vector<std::string> models;
  std::string sheets, only;
  std::vector<AttributeWeight> weights;
  Index size = 320;
};

// A triangle mesh to simplify, and all that it takes to draw it.
struct Subject {
  std::string name;
  Mesh mesh;
  std::vector<Texture> textures;
  std::vector<Index> group_texture;
  double diagonal = 0;
  std::vector<Camera> cameras;
};

std::uint64_t triangle_count(const Mesh& mesh) { return mesh.corners.size() / 3; }

// --- Reading ------------------------------------------------------------------------------------

std::optional<Texture> read_texture(const Image& image, const fs::path& folder) {
  Bytes bytes = image.data;
  if (bytes.empty() && !image.uri.empty()) {
    const auto file = read_file(folder / image.uri);
    if (!file) return std::nullopt;
    bytes.assign(file->view().begin(), file->view().end());
  }
  tinygltf::Image pixels;
  std::string error, warning;
  if (bytes.empty() ||
      !tinygltf::LoadImageData(&pixels, 0, &error, &warning, 0, 0,
                               reinterpret_cast<const unsigned char*>(bytes.data()),
                               static_cast<int>(bytes.size()), nullptr))
    return std::nullopt;
  if (pixels.bits != 8 || pixels.component < 3) return std::nullopt;
  Texture out{static_cast<Index>(pixels.width), static_cast<Index>(pixels.height), {}};
  const auto components = static_cast<std::size_t>(pixels.component);
  for (std::size_t i = 0; i < pixels.image.size(); i += components) {
    const auto part = [&](std::size_t k) { return static_cast<float>(pixels.image[i + k]) / 255; };
    out.texels.push_back({part(0), part(1), part(2)});
  }
  while (std::max(out.width, out.height) > kMaxTexels && out.width % 2 == 0 && out.height % 2 == 0)
    out = out.halved();
  return out;
}

// An OBJ file without materials may have its image beside it; the first by name.
std::optional<Texture> texture_beside(const fs::path& model) {
  fs::path image;
  for (const auto& file : fs::directory_iterator(model.parent_path()))
    if (file.path().extension() == ".png" && (image.empty() || file.path() < image))
      image = file.path();
  return image.empty() ? std::nullopt
                       : read_texture({{}, image.filename().string(), {}, {}}, image.parent_path());
}

// The images of materials, and for the rest a generated one.
void add_textures(const Model& model, const fs::path& path, Subject& subject) {
  subject.textures.push_back(checker_texture(kMaxTexels, 32));
  std::vector<Index> image_texture(model.scene.images.size(), 0);
  for (std::size_t i = 0; i < image_texture.size(); ++i)
    if (auto texture = read_texture(model.scene.images[i], path.parent_path())) {
      image_texture[i] = static_cast<Index>(subject.textures.size());
      subject.textures.push_back(std::move(*texture));
    }
  Index lone = 0;
  if (auto texture = model.scene.images.empty() ? texture_beside(path) : std::nullopt) {
    lone = static_cast<Index>(subject.textures.size());
    subject.textures.push_back(std::move(*texture));
  }
  for (const Group& group : subject.mesh.groups) {
    Index texture = lone;
    if (group.material != kNone) {
      const Index image = model.scene.materials[group.material].image(MapRole::base_color);
      if (image != kNone) texture = image_texture[image];
    }
    subject.group_texture.push_back(texture);
  }
}

// OBJ counts v upwards from the last row of an image, glTF downwards from the first.
void turn_v(Mesh& mesh) {
  for (Attribute& a : mesh.wedge_attributes)
    if (a.semantic == "TEXCOORD_0")
      for (std::size_t w = 0; w < a.elements(); ++w) set_component(a, w, 1, 1 - component(a, w, 1));
}

// Polygons are cut, and everything else left out.
void keep_triangles(Mesh& mesh) {
  Triangulation t = triangulate(mesh);
  std::vector<Index> group;
  for (const Index face : t.face) group.push_back(mesh.group_of(face));
  mesh.corners = std::move(t.corners);
  mesh.face_first.clear();
  mesh.face_group = std::move(group);
  mesh.face_attributes.clear();
  canonicalize(mesh);
}

void place_cameras(Subject& subject) {
  const std::vector<double> positions = positions_as_double(subject.mesh);
  subject.diagonal = bounding_box_diagonal(positions);
  Point low, high;
  low.fill(std::numeric_limits<double>::max());
  high.fill(std::numeric_limits<double>::lowest());
  for (const Index w : subject.mesh.corners)
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = positions[std::size_t{3} * subject.mesh.vertex_of(w) + k];
      low[k] = std::min(low[k], x);
      high[k] = std::max(high[k], x);
    }
  Point centre;
  for (std::size_t k = 0; k < 3; ++k) centre[k] = (low[k] + high[k]) / 2;
  double radius = 0;
  for (const Index w : subject.mesh.corners) {
    const std::size_t first = std::size_t{3} * subject.mesh.vertex_of(w);
    const Point d = Point{positions[first], positions[first + 1], positions[first + 2]} - centre;
    radius = std::max(radius, std::sqrt(dot(d, d)));
  }
  const auto cameras = icosahedron_cameras(centre, 1.05 * radius);
  subject.cameras.assign(cameras.begin(), cameras.end());
}

// The largest mesh of a file.
std::optional<Subject> read_subject(const std::string& name) {
  Subject subject;
  Model model;
  fs::path path = name;
  if (name == "charts") {
    model.meshes.push_back(cube_sphere(36, 12));
  } else {
    const auto dir = models_dir();
    if (!dir) return std::nullopt;
    path = *dir / name;
    auto file = load(path);
    if (!file || file->is_progressive()) return std::nullopt;
    model = std::get<Model>(std::move(file->content));
  }
  if (model.meshes.empty()) return std::nullopt;
  const fs::path stem = path.stem();  // a tile may be called 0
  subject.name = (stem.native().size() > 1 ? stem : path.parent_path().filename()).string();
  subject.mesh = *std::ranges::max_element(
      model.meshes, {}, [](const Mesh& m) { return triangulate(m).face.size(); });
  keep_triangles(subject.mesh);
  if (subject.mesh.corners.empty()) return std::nullopt;
  if (path.extension() == ".obj") turn_v(subject.mesh);
  if (name == "charts") {
    subject.textures.push_back(checker_texture(kMaxTexels, 128));
    subject.group_texture.push_back(0);
  } else {
    add_textures(model, path, subject);
  }
  place_cameras(subject);
  return subject;
}

// --- Simplifying --------------------------------------------------------------------------------

struct Reduced {
  Mesh mesh;
  std::string stop;  // why it ended; empty: target reached
};

// Every level of a sequence down to nothing, to take several from.
class Ours {
 public:
  Ours(const Mesh& mesh, EncodeOptions options) {
    options.stripifier = "sgi-strips";
    options.level_cost = 0;
    options.base_share = 0;
    options.packet_growth = 0;
    options.packet_min = 1;
    Model model;
    model.meshes.push_back(mesh);
    strips_ = encode(model, options).value();
  }

  Reduced at(std::uint64_t target) const {
    Index vsplits = 0;
    for (const Packet& packet : strips_.packets) {
      if (packet.triangles > target) break;
      vsplits += packet.vsplits;
    }
    Level level(strips_.meshes[0]);
    level.refine(vsplits);
    return {mesh_of(level).value(), strips_.bases[0].triangles > target ? "exhausted" : ""};
  }

 private:
  ProgressiveStrips strips_;
};

// Vertices of one primitive as a glTF tool has them: those it uses, no others.
class Primitive {
 public:
  // Wedges, or with `welded` the first wedge of each vertex for all of its corners.
  void add(const Mesh& mesh, std::span<const double> positions, Index wedge, bool welded) {
    const Index v = mesh.vertex_of(wedge);
    const auto [it, is_new] =
        numbers_.try_emplace(welded ? v : wedge, static_cast<Index>(wedges_.size()));
    corners_.push_back(it->second);
    if (!is_new) return;
    wedges_.push_back(wedge);
    for (std::size_t k = 0; k < 3; ++k)
      positions_.push_back(static_cast<float>(positions[std::size_t{3} * v + k]));
  }

  std::size_t triangles() const { return corners_.size() / 3; }

  // Corners that are left, as wedges.
  std::vector<Index> simplify(std::size_t target) const {
    std::vector<Index> left(corners_.size());
    left.resize(meshopt_simplify(left.data(), corners_.data(), corners_.size(), positions_.data(),
                                 wedges_.size(), 3 * sizeof(float), 3 * target,
                                 std::numeric_limits<float>::max(), 0, nullptr));
    for (Index& corner : left) corner = wedges_[corner];
    return left;
  }

 private:
  std::map<Index, Index> numbers_;  // of vertices or wedges
  std::vector<Index> wedges_, corners_;
  std::vector<float> positions_;
};

// How glTF tools call it: each primitive for itself, with its share of the triangles. Vertices are
// wedges, and meshoptimizer finds those at one place; or they are welded before and have the
// attributes of one wedge.
Reduced meshopt(const Mesh& mesh, std::uint64_t target, bool welded) {
  const std::vector<double> positions = positions_as_double(mesh);
  std::vector<Primitive> primitives(mesh.groups.size());
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (const Index w : mesh.face(f)) primitives[mesh.group_of(f)].add(mesh, positions, w, welded);
  Mesh out = mesh;
  out.corners.clear();
  out.face_group.clear();
  for (Index g = 0; g < primitives.size(); ++g) {
    const double share = static_cast<double>(target) / static_cast<double>(triangle_count(mesh));
    const auto left = primitives[g].simplify(
        static_cast<std::size_t>(share * static_cast<double>(primitives[g].triangles())));
    out.corners.insert(out.corners.end(), left.begin(), left.end());
    out.face_group.insert(out.face_group.end(), left.size() / 3, g);
  }
  canonicalize(out);
  const bool reached = triangle_count(out) <= target + target / 50;
  return {std::move(out), reached ? "" : "stuck"};
}

struct Manner {
  const char* name;
  Placement placement;
  Metric metric;
  bool weighs_attributes = true;
};
constexpr Manner kManners[] = {
    {"ours", Placement::subset, Metric::memoryless},
    {"ours-qem", Placement::subset, Metric::qem},
    {"ours-optimal", Placement::optimal, Metric::memoryless},
    {"ours-optimal-qem", Placement::optimal, Metric::qem},
    {"ours-geometry", Placement::subset, Metric::memoryless, false},
};

EncodeOptions options_of(const Manner& manner, const std::vector<AttributeWeight>& weights) {
  EncodeOptions options;
  options.attribute_weights = weights;
  options.placement = manner.placement;
  options.metric = manner.metric;
  if (!manner.weighs_attributes)
    for (const char* const semantic : {"NORMAL", "TEXCOORD", "COLOR"})
      options.attribute_weights.push_back({semantic, 0});
  return options;
}

// --- Measuring ----------------------------------------------------------------------------------

void print(const Subject& subject, const std::string& variant, double share, const Reduced& reduced,
           const RenderMesh& original, Index size) {
  const RenderMesh drawn = render_mesh(reduced.mesh, subject.group_texture);
  const Appearance a = compare_appearance(original, drawn, subject.textures, subject.cameras, size);
  const Stretch s = stretch(drawn), s0 = stretch(original);
  fmt::print(
      "{},{},{},{},{},{},{:.5f},{:.3f},{:.3f},{:.3f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},"
      "{:.4f},{:.4f},{:.4g},{:.5f}\n",
      subject.name, variant, share, triangle_count(subject.mesh), triangle_count(reduced.mesh),
      reduced.stop, a.silhouette, a.depth / subject.diagonal * 1e4, a.face_normal, a.vertex_normal,
      a.unlit, a.face_lit, a.vertex_lit, a.structure, a.uv, a.stretch, s.l2 / s0.l2,
      s.maximum / s0.maximum, s.collapsed);
  std::fflush(stdout);
}

// Rows of pictures side by side, as binary PPM.
class Sheet {
 public:
  explicit Sheet(const Subject& subject, Index size) : subject_(subject), size_(size) {}

  /// Two pictures below each other: as lit by vertex normals.
  void add(const RenderMesh& mesh) {
    for (std::size_t view = 0; view < 2; ++view) {
      const Camera& camera = subject_.cameras[view == 0 ? 1 : 6];
      const Picture picture = render(mesh, subject_.textures, camera, size_);
      Bytes& strip = columns_.emplace_back();
      for (const Pixel& p : picture.pixels) {
        const auto colour =
            p.is_covered() ? lit(p, p.vertex_normal, camera.toward) : std::array<float, 3>{1, 1, 1};
        for (const float x : colour)
          strip.push_back(static_cast<std::byte>(std::lround(255 * std::clamp(x, 0.f, 1.f))));
      }
    }
  }

  void write(const fs::path& path) const {
    const std::size_t columns = columns_.size() / 2, row_bytes = std::size_t{3} * size_;
    std::ofstream out(path, std::ios::binary);
    out << "P6\n" << columns * size_ << ' ' << 2 * size_ << "\n255\n";
    for (std::size_t view = 0; view < 2; ++view)
      for (Index row = 0; row < size_; ++row)
        for (std::size_t c = 0; c < columns; ++c)
          out.write(reinterpret_cast<const char*>(columns_[2 * c + view].data()) + row * row_bytes,
                    static_cast<std::streamsize>(row_bytes));
  }

 private:
  const Subject& subject_;
  Index size_;
  std::vector<Bytes> columns_;
};

// A peer that did not reach its target.
struct Stop {
  const char* peer;
  double share;
  std::uint64_t triangles;
};

void measure(const Subject& subject, const Options& options) {
  const RenderMesh original = render_mesh(subject.mesh, subject.group_texture);
  Sheet sheet(subject, options.size);
  sheet.add(original);
  const auto target_of = [&](double share) {
    return static_cast<std::uint64_t>(share * static_cast<double>(triangle_count(subject.mesh)));
  };
  const auto note = [&](const std::string& variant, double share, const Reduced& reduced) {
    print(subject, variant, share, reduced, original, options.size);
    if (share == kSheetShare) sheet.add(render_mesh(reduced.mesh, subject.group_texture));
  };
  const auto is_wanted = [&](std::string_view name) {
    return options.only.empty() || options.only == name;
  };
  std::vector<Stop> early;
  for (const bool welded : {false, true}) {
    const char* const name = welded ? "meshopt-welded" : "meshopt";
    for (const double share : kShares) {
      const Reduced reduced = meshopt(subject.mesh, target_of(share), welded);
      if (is_wanted(name)) note(name, share, reduced);
      if (!reduced.stop.empty()) early.push_back({name, share, triangle_count(reduced.mesh)});
    }
  }
  for (const Manner& manner : kManners) {
    if (!is_wanted(manner.name)) continue;
    const Ours ours(subject.mesh, options_of(manner, options.weights));
    for (const double share : kShares) note(manner.name, share, ours.at(target_of(share)));
    // More triangles alone make better pictures.
    for (const Stop& stop : early)
      print(subject, fmt::format("{}@{}", manner.name, stop.peer), stop.share,
            ours.at(stop.triangles), original, options.size);
  }
  if (!options.sheets.empty()) sheet.write(fs::path(options.sheets) / (subject.name + ".ppm"));
}

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--sheets" && i + 1 < argc)
      options.sheets = argv[++i];
    else if (word == "--only" && i + 1 < argc)
      options.only = argv[++i];
    else if (word == "--size" && i + 1 < argc)
      options.size = static_cast<Index>(std::strtoul(argv[++i], nullptr, 10));
    else if (word == "--weight" && i + 1 < argc) {
      const std::string_view weight = argv[++i];
      const std::size_t split = std::min(weight.find('='), weight.size() - 1);
      options.weights.push_back(
          {std::string(weight.substr(0, split)), std::strtod(argv[i] + split + 1, nullptr)});
    } else
      options.models.emplace_back(word);
  }
  if (options.models.empty())
    options.models = {"textured/spot/spot_triangulated.obj",
                      "textured/Duck-glTF-Binary/Duck.glb",
                      "textured/blender-io/02_suzanne/02_suzanne.gltf",
                      "textured/CesiumMan-glTF-Binary/CesiumMan.glb",
                      "textured/texturedknot/texturedknot.obj",
                      "textured/babylon/shaderBall.glb",
                      "textured/doorman/doorman.obj",
                      "textured/deer/deer.gltf",
                      "textured/agi-ktx2/0.glb",
                      "charts"};
  return options;
}

}  // namespace
}  // namespace pstrips::bench

int main(int argc, char** argv) {
  using namespace pstrips;
  const bench::Options options = bench::parse(argc, argv);
  fmt::print(
      "model,variant,share,source_triangles,triangles,stop,silhouette,depth,face_normal,"
      "vertex_normal,unlit,face_lit,vertex_lit,structure,uv,stretch,stretch_l2,stretch_max,"
      "collapsed\n");
  for (const std::string& name : options.models)
    if (const auto subject = bench::read_subject(name)) bench::measure(*subject, options);
}
