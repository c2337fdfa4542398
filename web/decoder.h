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

/// What a mesh shows as of the last update. Arrays are of wedges: a vertex with one tuple of
/// attributes, which is what a drawing interface calls a vertex.
struct PstripsMesh {
  std::uint32_t vertices, wedges, triangles, groups;
  std::uint32_t strip_entries;  ///< 0 unless strips are kept
  const float* positions;       ///< x, y and z of each wedge
  /// Three wedges each, counter-clockwise, those of one group after those of the group before.
  const std::uint32_t* triangle_list;
  const std::uint32_t* group_first;  ///< first triangle of each group and one past the last
  const std::uint32_t* strips;       ///< display strips of wedges, parted by 0xffffffff
  /// What the last update changed, pairs of first and one past the last, ascending: of wedges, then
  /// of triangles. What the list is longer by counts as changed.
  const std::uint32_t* changed;
  std::uint32_t changed_wedges, changed_triangles;  ///< pairs of each
};

extern "C" {

/// Memory for the bytes of a file; the caller gives it back. nullptr when there is none left.
PSTRIPS_EXPORT(pstrips_allocate) void* pstrips_allocate(std::size_t bytes);
PSTRIPS_EXPORT(pstrips_release) void pstrips_release(void* memory);

/// \param max_memory  what the decoder may ask for, in bytes; a file that needs more is refused
/// \param keeps_strips  whether display strips are made besides the triangles, 0 or 1
PSTRIPS_EXPORT(pstrips_open)
PstripsViewer* pstrips_open(double max_memory, int keeps_strips);
PSTRIPS_EXPORT(pstrips_close) void pstrips_close(PstripsViewer* viewer);

/// Takes the next bytes of the file. 0, or 1 after an error, which stays.
PSTRIPS_EXPORT(pstrips_feed)
int pstrips_feed(PstripsViewer* viewer, const std::byte* bytes, std::size_t size);

/// What was wrong, or what is missing if no more bytes come; empty for a whole file.
PSTRIPS_EXPORT(pstrips_error) const char* pstrips_error(PstripsViewer* viewer);
/// A pstrips::ErrorCode, or -1 for a whole file.
PSTRIPS_EXPORT(pstrips_error_code) int pstrips_error_code(const PstripsViewer* viewer);
/// Byte of the file at which it was noticed, or -1.
PSTRIPS_EXPORT(pstrips_error_offset) double pstrips_error_offset(const PstripsViewer* viewer);

/// 1 when there is something new to show.
PSTRIPS_EXPORT(pstrips_update) int pstrips_update(PstripsViewer* viewer);
PSTRIPS_EXPORT(pstrips_packets) std::uint32_t pstrips_packets(const PstripsViewer* viewer);
/// Of all meshes as they are now; 0 before the base is there.
PSTRIPS_EXPORT(pstrips_vertices) double pstrips_vertices(const PstripsViewer* viewer);
PSTRIPS_EXPORT(pstrips_triangles) double pstrips_triangles(const PstripsViewer* viewer);
/// Bound of the distance to the full model, model units.
PSTRIPS_EXPORT(pstrips_distance) double pstrips_distance(const PstripsViewer* viewer);

/// 0 before the base is there.
PSTRIPS_EXPORT(pstrips_meshes) std::uint32_t pstrips_meshes(const PstripsViewer* viewer);
/// mesh < pstrips_meshes(), as of the last update.
PSTRIPS_EXPORT(pstrips_mesh)
const PstripsMesh* pstrips_mesh(const PstripsViewer* viewer, std::uint32_t mesh);
/// Elements of a wedge attribute, as many as the mesh has wedges, in the type that pstrips_scene()
/// says.
PSTRIPS_EXPORT(pstrips_attribute)
const std::byte* pstrips_attribute(const PstripsViewer* viewer, std::uint32_t mesh,
                                   std::uint32_t attribute);

/// All of the file but geometry, once there is a base, as little-endian words; strings are a u32
/// length and that many bytes, lists a u32 length and that many elements:
///
///     u32 profile, packets, texture origin; list of materials: string name, f64[4] base colour,
///     f64[3] emissive, f64 metallic, f64 roughness, f64 alpha cutoff, u32 alpha mode, u32 image of
///     the base colour, u32 double-sided; list of images: string name, uri, media type; list of
///     nodes: string name, u32 parent, f64[16] matrix, list of u32 meshes; list of meshes: string
///     name, u32 vertices, wedges, triangles; list of groups: string name, u32 material, u32 kind;
///     list of attributes: string semantic, u32 type, count, normalized
PSTRIPS_EXPORT(pstrips_scene) const std::byte* pstrips_scene(PstripsViewer* viewer);
/// The encoded file of an image; 0 bytes until it is there.
PSTRIPS_EXPORT(pstrips_image)
const std::byte* pstrips_image(const PstripsViewer* viewer, std::uint32_t image);
PSTRIPS_EXPORT(pstrips_image_bytes)
std::uint32_t pstrips_image_bytes(const PstripsViewer* viewer, std::uint32_t image);

}  // extern "C"
