#include "web/decoder.h"

#include <algorithm>
#include <cstdlib>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "converters/stream_decoder.h"
#include "core/mesh.h"
#include "core/strips.h"

struct PstripsViewer {
  pstrips::StreamDecoder decoder;
  std::string error;
  std::vector<float> positions;
  std::vector<std::uint32_t> entries;
};

namespace {

using pstrips::Index;

std::vector<float> positions_of(const pstrips::Level& level) {
  pstrips::Attribute shown = level.mesh().position;
  const pstrips::ByteView bytes = level.positions();
  shown.data.assign(bytes.begin(), bytes.end());
  std::vector<float> out(std::size_t{3} * level.vertex_count());
  const std::size_t count = std::min<std::size_t>(shown.count, 3);
  for (std::size_t i = 0; i < level.vertex_count(); ++i)
    for (std::size_t c = 0; c < count; ++c)
      out[3 * i + c] = static_cast<float>(pstrips::component(shown, i, c));
  return out;
}

std::vector<Index> vertex_strips(const pstrips::DisplayLevel& shown) {
  pstrips::DisplayStrips strips;
  shown.append_display(strips);
  for (Index& entry : strips)
    if (entry != pstrips::kRestart) entry = shown.level().vertex_of(entry);
  return strips;
}

std::vector<Index> triangles_of(std::span<const Index> strips) {
  std::vector<Index> out;
  pstrips::for_each_triangle(
      strips, [](Index vertex) { return vertex; },
      [&](Index a, Index b, Index c) {
        out.insert(out.end(), {a, b, c});
      });
  return out;
}

}  // namespace

void* pstrips_allocate(std::size_t bytes) { return std::malloc(bytes); }

void pstrips_release(void* memory) { std::free(memory); }

PstripsViewer* pstrips_open() { return new PstripsViewer; }

void pstrips_close(PstripsViewer* viewer) { delete viewer; }

int pstrips_feed(PstripsViewer* viewer, const std::byte* bytes, std::size_t size) {
  return viewer->decoder.feed({bytes, size}) ? 0 : 1;
}

const char* pstrips_error(PstripsViewer* viewer) {
  const std::optional<pstrips::Error> error = viewer->decoder.end();
  viewer->error = error ? error->message : "";
  return viewer->error.c_str();
}

int pstrips_update(PstripsViewer* viewer) { return viewer->decoder.update() ? 1 : 0; }

std::uint32_t pstrips_packets(const PstripsViewer* viewer) {
  return static_cast<std::uint32_t>(viewer->decoder.packets());
}

std::uint32_t pstrips_meshes(const PstripsViewer* viewer) {
  if (!viewer->decoder.has_base()) return 0;
  return static_cast<std::uint32_t>(viewer->decoder.strips().meshes.size());
}

std::uint32_t pstrips_vertex_count(const PstripsViewer* viewer, std::uint32_t mesh) {
  return viewer->decoder.mesh(mesh).level().vertex_count();
}

const float* pstrips_positions(PstripsViewer* viewer, std::uint32_t mesh) {
  viewer->positions = positions_of(viewer->decoder.mesh(mesh).level());
  return viewer->positions.data();
}

const std::uint32_t* pstrips_strips(PstripsViewer* viewer, std::uint32_t mesh) {
  viewer->entries = vertex_strips(viewer->decoder.mesh(mesh));
  return viewer->entries.data();
}

const std::uint32_t* pstrips_triangles(PstripsViewer* viewer, std::uint32_t mesh) {
  viewer->entries = triangles_of(vertex_strips(viewer->decoder.mesh(mesh)));
  return viewer->entries.data();
}

std::uint32_t pstrips_entries(const PstripsViewer* viewer) {
  return static_cast<std::uint32_t>(viewer->entries.size());
}
