// How fast files are read and written: ours beside tinyobjloader, OpenMesh, assimp and tinygltf on
// the same files, and beside what the memory does when bytes are only touched. Writes CSV to
// standard output; bench_encoder makes tables of it.
//
//   files_bench [--ours] [--triangles N] [MODEL …]   paths in the folder of models
//
// Without arguments: noisy grids of 70 thousand and 1.4 million triangles, and some real models.

#include <fmt/format.h>
#include <tiny_gltf.h>
#include <tiny_obj_loader.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "converters/files.h"
#include "formats/ply/ply.h"
#include "tests/support/meshes.h"
#include "tests/support/paths.h"

#ifdef PSTRIPS_ASSIMP
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#endif

namespace pstrips::bench {
namespace {

namespace fs = std::filesystem;

/// What a file is, by the words of the table, and who else knows it.
struct Kind {
  const char* name;
  const char* extension;
  bool ascii = false, big_endian = false;
  const char* assimp_id = nullptr;  ///< of its exporter
};
constexpr Kind kKinds[] = {
    {"ply ascii", ".ply", true, false, "ply"},
    {"ply little-endian", ".ply", false, false, "plyb"},
    {"ply big-endian", ".ply", false, true},
    {"obj", ".obj", true, false, "obj"},
    {"glb", ".glb", false, false, "glb2"},
    {"gltf", ".gltf", false, false, "gltf2"},
    {"pstrip", ".pstrip"},
};

constexpr double kFailed = std::numeric_limits<double>::infinity();

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// A program on one file, in one direction. `run` returns how many faces it saw, or in writing of
/// how many it made a file; a negative number when it failed.
struct Contender {
  std::string program;
  std::function<std::int64_t()> run;
  double wall = kFailed, cpu = kFailed;
  std::int64_t faces = 0;
};

/// The contenders take turns; the best time of each counts. Slow ones run twice only.
void time_all(std::vector<Contender>& contenders) {
  constexpr int kRounds = 5;
  constexpr double kSlow = 0.5;  // seconds
  for (int round = 0; round < kRounds; ++round)
    for (Contender& c : contenders) {
      if (round >= 2 && c.wall > kSlow) continue;
      const double wall = wall_seconds(), cpu = cpu_seconds();
      c.faces = c.run();
      c.cpu = std::min(c.cpu, cpu_seconds() - cpu);
      c.wall = std::min(c.wall, wall_seconds() - wall);
    }
}

void print(const std::string& model, const Kind& kind, const char* direction,
           std::uint64_t triangles, std::uint64_t bytes, const std::vector<Contender>& contenders) {
  for (const Contender& c : contenders) {
    const auto megabytes = static_cast<double>(bytes) / 1e6;
    fmt::print("{},{},{},{},{},{},{:.5f},{:.5f},{:.1f},{:.1f},{}\n", model, kind.name, direction,
               c.program, triangles, bytes, c.wall, c.cpu, megabytes / c.wall, megabytes / c.cpu,
               c.faces);
  }
  std::fflush(stdout);
}

// Ours.

std::int64_t faces_of(const Model& model) {
  std::int64_t faces = 0;
  for (const Mesh& mesh : model.meshes) faces += mesh.face_count();
  return faces;
}

std::int64_t read_ours(const std::string& path, unsigned threads) {
  LoadOptions options;
  options.limits.threads = threads;
  auto file = load(path, options);
  if (!file) return -1;
  if (const auto* strips = std::get_if<ProgressiveStrips>(&file->content))
    return strips->meshes.empty() ? 0 : static_cast<std::int64_t>(strips->meshes[0].triangles);
  return faces_of(std::get<Model>(file->content));
}

std::int64_t write_ours(const Model& model, const Kind& kind, const std::string& path,
                        unsigned threads) {
  if (kind.big_endian) {
    const auto bytes =
        write_ply(model, {.format = PlyWriteOptions::Format::big_endian, .threads = threads});
    return bytes && write_files({{path, *bytes}}) ? faces_of(model) : -1;
  }
  const auto saved =
      save(model, path, *format_of_path(path), {.ascii = kind.ascii, .threads = threads});
  return saved ? faces_of(model) : -1;
}

// What the machine does with the bytes alone.

std::int64_t touch_bytes(const std::string& path) {
  const auto file = read_file(path);
  if (!file) return -1;
  std::uint64_t sum = 0;
  const ByteView bytes = file->view();
  for (std::size_t i = 0; i + 8 <= bytes.size(); i += 8) {
    std::uint64_t word;
    std::memcpy(&word, bytes.data() + i, 8);
    sum += word;
  }
  return sum == 0 ? -1 : 0;
}

// Peers.

using PeerMesh = OpenMesh::PolyMesh_ArrayKernelT<>;

std::int64_t read_tinyobj(const std::string& path) {
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning, error;
  const std::string folder = fs::path(path).parent_path().string() + "/";
  if (!tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, path.c_str(),
                        folder.c_str(), false))
    return -1;
  std::int64_t faces = 0;
  for (const auto& shape : shapes)
    faces += static_cast<std::int64_t>(shape.mesh.num_face_vertices.size());
  return faces;
}

OpenMesh::IO::Options openmesh_options(const Kind& kind) {
  OpenMesh::IO::Options out;
  if (kind.ascii) return out;
  out += OpenMesh::IO::Options::Binary;
  out += kind.big_endian ? OpenMesh::IO::Options::MSB : OpenMesh::IO::Options::LSB;
  return out;
}

std::int64_t read_openmesh(const std::string& path, PeerMesh& mesh) {
  OpenMesh::IO::Options options;
  mesh.clear();
  if (!OpenMesh::IO::read_mesh(mesh, path, options)) return -1;
  return static_cast<std::int64_t>(mesh.n_faces());
}

std::int64_t faces_of(const tinygltf::Model& model) {
  std::int64_t corners = 0;
  for (const auto& mesh : model.meshes)
    for (const auto& primitive : mesh.primitives)
      corners += static_cast<std::int64_t>(
          model.accessors[static_cast<std::size_t>(primitive.indices)].count);
  return corners / 3;
}

bool read_tinygltf(const std::string& path, tinygltf::Model& model) {
  tinygltf::TinyGLTF reader;
  std::string error, warning;
  return path.ends_with(".glb") ? reader.LoadBinaryFromFile(&model, &error, &warning, path)
                                : reader.LoadASCIIFromFile(&model, &error, &warning, path);
}

#ifdef PSTRIPS_ASSIMP
std::int64_t faces_of(const aiScene* scene) {
  if (scene == nullptr) return -1;
  std::int64_t faces = 0;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) faces += scene->mMeshes[m]->mNumFaces;
  return faces;
}
#endif

std::vector<Contender> readers(const Kind& kind, const std::string& path, bool ours_alone) {
  const std::string_view extension = kind.extension;
  std::vector<Contender> out;
  out.push_back({"pstrips", [=] { return read_ours(path, 1); }});
  out.push_back({"pstrips (all cores)", [=] { return read_ours(path, 0); }});
  out.push_back({"touching the mapped bytes", [=] { return touch_bytes(path); }});
  if (ours_alone || extension == ".pstrip") return out;
  if (extension == ".obj") out.push_back({"tinyobjloader", [=] { return read_tinyobj(path); }});
  if (extension == ".obj" || extension == ".ply")
    out.push_back({"OpenMesh", [=] {
                     PeerMesh mesh;
                     return read_openmesh(path, mesh);
                   }});
  if (extension == ".glb" || extension == ".gltf")
    out.push_back({"tinygltf", [=] {
                     tinygltf::Model model;
                     return read_tinygltf(path, model) ? faces_of(model) : -1;
                   }});
#ifdef PSTRIPS_ASSIMP
  out.push_back({"assimp", [=] {
                   Assimp::Importer importer;
                   return faces_of(importer.ReadFile(path, 0));
                 }});
#endif
  return out;
}

/// Peers write what they have read from `source`.
class Writers {
 public:
  Writers(const Model& model, const Kind& kind, const std::string& source, const std::string& path,
          bool ours_alone) {
    list.push_back({"pstrips", [&model, kind, path] { return write_ours(model, kind, path, 1); }});
    list.push_back(
        {"pstrips (all cores)", [&model, kind, path] { return write_ours(model, kind, path, 0); }});
    if (auto file = read_file(source)) bytes_ = std::move(*file);
    list.push_back({"writing the bytes", [this, path]() -> std::int64_t {
                      return write_files({{path, bytes_.view()}}) ? 0 : -1;
                    }});
    if (ours_alone) return;
    const std::string_view extension = kind.extension;
    if (extension == ".obj" || extension == ".ply") add_openmesh(kind, source, path);
    if (extension == ".glb" || extension == ".gltf") add_tinygltf(source, path);
#ifdef PSTRIPS_ASSIMP
    if (kind.assimp_id != nullptr) add_assimp(kind, source, path);
#endif
  }
  Writers(const Writers&) = delete;
  Writers& operator=(const Writers&) = delete;

  std::vector<Contender> list;

 private:
  void add_openmesh(const Kind& kind, const std::string& source, const std::string& path) {
    if (read_openmesh(source, mesh_) < 0) return;
    list.push_back({"OpenMesh", [this, kind, path]() -> std::int64_t {
                      const bool good = OpenMesh::IO::write_mesh(
                          mesh_, path, openmesh_options(kind), kind.ascii ? 9 : 6);
                      return good ? static_cast<std::int64_t>(mesh_.n_faces()) : -1;
                    }});
  }
  void add_tinygltf(const std::string& source, const std::string& path) {
    if (!read_tinygltf(source, gltf_)) return;
    list.push_back({"tinygltf", [this, path]() -> std::int64_t {
                      tinygltf::TinyGLTF writer;
                      const bool good = writer.WriteGltfSceneToFile(&gltf_, path, false, false,
                                                                    false, path.ends_with(".glb"));
                      return good ? faces_of(gltf_) : -1;
                    }});
  }
#ifdef PSTRIPS_ASSIMP
  void add_assimp(const Kind& kind, const std::string& source, const std::string& path) {
    const aiScene* const scene = importer_.ReadFile(source, 0);
    if (scene == nullptr) return;
    list.push_back({"assimp", [scene, kind, path]() -> std::int64_t {
                      Assimp::Exporter exporter;
                      const bool good = exporter.Export(scene, kind.assimp_id, path) == AI_SUCCESS;
                      return good ? faces_of(scene) : -1;
                    }});
  }
  Assimp::Importer importer_;
#endif

  FileBytes bytes_;
  PeerMesh mesh_;
  tinygltf::Model gltf_;
};

std::uint64_t size_with_buffer(const std::string& path) {
  const fs::path buffer = fs::path(path).replace_extension(".bin");
  const bool has_buffer = path.ends_with(".gltf") && fs::exists(buffer);
  return fs::file_size(path) + (has_buffer ? fs::file_size(buffer) : 0);
}

/// Every face that we see, they see; files that touching and copying leave unread count as none.
bool agree(const std::vector<Contender>& contenders, std::int64_t faces) {
  return std::ranges::all_of(contenders, [&](const Contender& c) {
    if (c.faces == faces || c.faces == 0) return true;
    fmt::print(stderr, "{} has {} faces, not {}\n", c.program, c.faces, faces);
    return c.program != "pstrips" && c.program != "pstrips (all cores)";
  });
}

bool measure(const std::string& name, const Model& model, const fs::path& folder, bool ours_alone) {
  const std::int64_t faces = faces_of(model);
  for (const Kind& kind : kKinds) {
    const std::string source = (folder / ("source" + std::string(kind.extension))).string();
    const std::string target = (folder / ("target" + std::string(kind.extension))).string();
    if (kind.extension == std::string_view(".pstrip")) {
      const auto strips = encode(model, {.stripifier = "sgi-strips"});
      if (!strips || !save(*strips, source, FileFormat::pstrip)) return false;
      auto reading = readers(kind, source, ours_alone);
      time_all(reading);
      print(name, kind, "read", static_cast<std::uint64_t>(faces), fs::file_size(source), reading);
      std::vector<Contender> writing;
      writing.push_back({"pstrips", [&]() -> std::int64_t {
                           return save(*strips, target, FileFormat::pstrip) ? faces : -1;
                         }});
      time_all(writing);
      print(name, kind, "write", static_cast<std::uint64_t>(faces), fs::file_size(source), writing);
      continue;
    }
    if (write_ours(model, kind, source, 1) < 0) return false;
    const std::uint64_t bytes = size_with_buffer(source);
    auto reading = readers(kind, source, ours_alone);
    time_all(reading);
    print(name, kind, "read", static_cast<std::uint64_t>(faces), bytes, reading);
    Writers writers(model, kind, source, target, ours_alone);
    time_all(writers.list);
    print(name, kind, "write", static_cast<std::uint64_t>(faces), bytes, writers.list);
    if (!agree(reading, faces) || !agree(writers.list, faces)) return false;
  }
  return true;
}

/// A grid whose numbers have all their digits, as those of a scan do; with texture coordinates and
/// normals.
Model noisy_grid(std::uint64_t triangles, bool textured) {
  const auto side = static_cast<Index>(std::sqrt(static_cast<double>(triangles) / 2)) + 2;
  Model model;
  Mesh& mesh = model.meshes.emplace_back(test::grid(side));
  std::mt19937 random(1);
  const auto noise = [&random] { return static_cast<float>(random()) * 0x1p-33f; };
  const auto fill = [&](Attribute& attribute, std::size_t floats) {
    attribute.data.resize(floats * sizeof(float));
    for (std::size_t i = 0; i < floats; ++i) {
      const float value = noise();
      std::memcpy(attribute.data.data() + i * sizeof value, &value, sizeof value);
    }
  };
  for (std::size_t i = 0; i < std::size_t{3} * mesh.vertex_count(); ++i)
    set_component(mesh.position, i / 3, i % 3, component(mesh.position, i / 3, i % 3) + noise());
  if (!textured) return model;
  for (const auto& [semantic, count] : {std::pair{"NORMAL", 3}, std::pair{"TEXCOORD_0", 2}}) {
    Attribute& a = mesh.wedge_attributes.emplace_back();
    a.semantic = semantic;
    a.count = static_cast<std::uint8_t>(count);
    fill(a, std::size_t{a.count} * mesh.vertex_count());
  }
  return model;
}

struct Arguments {
  bool ours_alone = false;
  std::uint64_t triangles = 0;
  std::vector<std::string> models;
};

bool run(const Arguments& arguments, const fs::path& folder) {
  fmt::print(
      "model,format,direction,program,triangles,bytes,seconds,cpu_seconds,mb_per_s,"
      "mb_per_cpu_s,faces\n");
  std::vector<std::uint64_t> sizes{arguments.triangles};
  if (arguments.triangles == 0) sizes = {70'000, 1'400'000};
  if (!arguments.models.empty()) sizes.clear();
  for (const std::uint64_t triangles : sizes)
    for (const bool textured : {false, true}) {
      const std::string name =
          fmt::format("grid {} k{}", triangles / 1000, textured ? " textured" : "");
      if (!measure(name, noisy_grid(triangles, textured), folder, arguments.ours_alone))
        return false;
    }
  std::vector<std::string> names = arguments.models;
  if (names.empty() && arguments.triangles == 0) names = {"classic/bun_zipper.ply"};
  const auto models = test::models_dir();
  for (const std::string& name : names) {
    if (!models) break;
    auto file = load((*models / name).string());
    if (!file || file->is_progressive()) return false;
    Model model = std::get<Model>(std::move(file->content));
    if (!measure(fs::path(name).filename().string(), model, folder, arguments.ours_alone))
      return false;
  }
  return true;
}

}  // namespace
}  // namespace pstrips::bench

int main(int argc, char** argv) {
  pstrips::bench::Arguments arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument == "--ours")
      arguments.ours_alone = true;
    else if (argument == "--triangles" && i + 1 < argc)
      arguments.triangles = std::strtoull(argv[++i], nullptr, 10);
    else
      arguments.models.emplace_back(argument);
  }
  std::string name = (std::filesystem::temp_directory_path() / "files_bench.XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) return EXIT_FAILURE;
  const bool good = pstrips::bench::run(arguments, name);
  std::filesystem::remove_all(name);
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
