#include "web/decoder.h"

#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "converters/stream_decoder.h"
#include "web/mesh_arrays.h"
#include "web/scene_words.h"

namespace {

pstrips::Limits limits_of(double max_memory) {
  pstrips::Limits limits;
  limits.memory_bytes = static_cast<std::uint64_t>(max_memory);
  return limits;
}

}  // namespace

struct PstripsViewer {
  PstripsViewer(double max_memory, bool strips)
      : decoder(limits_of(max_memory)), keeps_strips(strips) {}

  pstrips::StreamDecoder decoder;
  bool keeps_strips;
  std::vector<pstrips::MeshArrays> meshes;
  std::optional<std::size_t> updated_to;  // changes
  std::string error;
  pstrips::Bytes scene;
};

void* pstrips_allocate(std::size_t bytes) { return std::malloc(bytes); }

void pstrips_release(void* memory) { std::free(memory); }

PstripsViewer* pstrips_open(double max_memory, int keeps_strips) {
  return new PstripsViewer(max_memory, keeps_strips != 0);
}

void pstrips_close(PstripsViewer* viewer) { delete viewer; }

int pstrips_feed(PstripsViewer* viewer, const std::byte* bytes, std::size_t size) {
  return viewer->decoder.feed({bytes, size}) ? 0 : 1;
}

const char* pstrips_error(PstripsViewer* viewer) {
  const std::optional<pstrips::Error> error = viewer->decoder.end();
  viewer->error = error ? error->message : "";
  return viewer->error.c_str();
}

int pstrips_error_code(const PstripsViewer* viewer) {
  const std::optional<pstrips::Error> error = viewer->decoder.end();
  return error ? static_cast<int>(error->code) : -1;
}

double pstrips_error_offset(const PstripsViewer* viewer) {
  const std::optional<pstrips::Error> error = viewer->decoder.end();
  return error && error->offset != pstrips::kNoOffset ? static_cast<double>(error->offset) : -1;
}

int pstrips_update(PstripsViewer* viewer) {
  pstrips::StreamDecoder& decoder = viewer->decoder;
  if (!decoder.has_base() || viewer->updated_to == decoder.changes()) return 0;
  if (viewer->keeps_strips) decoder.update();
  viewer->meshes.resize(decoder.strips().meshes.size());
  for (std::size_t i = 0; i < viewer->meshes.size(); ++i)
    viewer->meshes[i].update(decoder.mesh(static_cast<pstrips::Index>(i)), viewer->keeps_strips);
  viewer->updated_to = decoder.changes();
  return 1;
}

std::uint32_t pstrips_packets(const PstripsViewer* viewer) {
  return static_cast<std::uint32_t>(viewer->decoder.packets());
}

double pstrips_vertices(const PstripsViewer* viewer) {
  return static_cast<double>(viewer->decoder.totals().vertices);
}

double pstrips_triangles(const PstripsViewer* viewer) {
  return static_cast<double>(viewer->decoder.totals().triangles);
}

double pstrips_distance(const PstripsViewer* viewer) { return viewer->decoder.totals().error; }

std::uint32_t pstrips_meshes(const PstripsViewer* viewer) {
  return static_cast<std::uint32_t>(viewer->meshes.size());
}

const PstripsMesh* pstrips_mesh(const PstripsViewer* viewer, std::uint32_t mesh) {
  return &viewer->meshes[mesh].mesh();
}

const std::byte* pstrips_attribute(const PstripsViewer* viewer, std::uint32_t mesh,
                                   std::uint32_t attribute) {
  return viewer->decoder.strips().meshes[mesh].wedge_attributes[attribute].data.data();
}

const std::byte* pstrips_scene(PstripsViewer* viewer) {
  const auto& header = viewer->decoder.header();
  viewer->scene = pstrips::scene_words(viewer->decoder.strips(), header ? header->packets : 0);
  return viewer->scene.data();
}

const std::byte* pstrips_image(const PstripsViewer* viewer, std::uint32_t image) {
  return viewer->decoder.strips().scene.images[image].data.data();
}

std::uint32_t pstrips_image_bytes(const PstripsViewer* viewer, std::uint32_t image) {
  return static_cast<std::uint32_t>(viewer->decoder.strips().scene.images[image].data.size());
}
