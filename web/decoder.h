#pragma once

#include <cstddef>
#include <cstdint>

// The decoder as plain functions, for WebAssembly and for languages that call C. Pointers that they
// return are good until the next call with the same viewer.

#ifdef __wasm__
#define PSTRIPS_EXPORT(name) __attribute__((export_name(#name)))
#else
#define PSTRIPS_EXPORT(name)
#endif

struct PstripsViewer;

extern "C" {

/// Memory for the bytes of a file; the caller gives it back. nullptr when there is none left.
PSTRIPS_EXPORT(pstrips_allocate) void* pstrips_allocate(std::size_t bytes);
PSTRIPS_EXPORT(pstrips_release) void pstrips_release(void* memory);

PSTRIPS_EXPORT(pstrips_open) PstripsViewer* pstrips_open();
PSTRIPS_EXPORT(pstrips_close) void pstrips_close(PstripsViewer* viewer);

/// Takes the next bytes of the file. 0, or 1 after an error, which stays.
PSTRIPS_EXPORT(pstrips_feed)
int pstrips_feed(PstripsViewer* viewer, const std::byte* bytes, std::size_t size);
/// What was wrong, or what is missing if no more bytes come; empty for a whole file.
PSTRIPS_EXPORT(pstrips_error) const char* pstrips_error(PstripsViewer* viewer);

/// 1 when there is something new to show.
PSTRIPS_EXPORT(pstrips_update) int pstrips_update(PstripsViewer* viewer);
PSTRIPS_EXPORT(pstrips_packets) std::uint32_t pstrips_packets(const PstripsViewer* viewer);
/// 0 before the base is there.
PSTRIPS_EXPORT(pstrips_meshes) std::uint32_t pstrips_meshes(const PstripsViewer* viewer);

// Of a mesh < pstrips_meshes(), as of the last update.
PSTRIPS_EXPORT(pstrips_vertex_count)
std::uint32_t pstrips_vertex_count(const PstripsViewer* viewer, std::uint32_t mesh);
/// x, y and z of each vertex.
PSTRIPS_EXPORT(pstrips_positions)
const float* pstrips_positions(PstripsViewer* viewer, std::uint32_t mesh);
/// Display strips of vertices, parted by 0xffffffff; how many entries they have is said below.
PSTRIPS_EXPORT(pstrips_strips)
const std::uint32_t* pstrips_strips(PstripsViewer* viewer, std::uint32_t mesh);
/// The same as triangles, three vertices each, counter-clockwise.
PSTRIPS_EXPORT(pstrips_triangles)
const std::uint32_t* pstrips_triangles(PstripsViewer* viewer, std::uint32_t mesh);
/// Entries of what one of the two functions above gave last.
PSTRIPS_EXPORT(pstrips_entries) std::uint32_t pstrips_entries(const PstripsViewer* viewer);

}  // extern "C"
