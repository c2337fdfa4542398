#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/bytes.h"
#include "core/file.h"
#include "core/limits.h"
#include "core/result.h"
#include "core/scene.h"

namespace pstrips::inline formats {

/// Reads a glTF 2.0 asset, .glb or .gltf by its first bytes. [glTF 2.0; spec/references.md]
///
/// Meshes      Primitives of a glTF mesh with one attribute layout and one kind of face (polygons,
///             lines, points) are the groups of one Mesh; others make further meshes. A glTF
///             vertex is a wedge; wedges of a mesh with bit-equal positions share a vertex.
///             Primitives that name the same accessors share their wedges. Unused wedges stay.
///             Primitives without POSITION become no mesh and are kept as they are.
/// Attributes  Wedge attributes under glTF's names and component types, those of morph target k as
///             "TARGET_k/NAME". Sparse accessors become dense, the padding of matrices goes.
/// Faces       Lists, strips and fans become triangles (a strip's triangles with a repeated index
///             are its joints and go), LINES two-corner polylines, LINE_STRIP and LINE_LOOP one
///             polyline (a loop ends at its first corner), POINTS one-corner faces.
/// Scene       Nodes (all of them, parents first; one with several parents once for each),
///             materials and images in glTF's order; embedded images as bytes, others as the URI
///             that the file wrote, percent-decoded. Texture coordinates are from the upper left.
///             The rest of the asset (cameras, skins, animations, extensions, extras …) goes to the
///             foreign keys "gltf/…", from which write_gltf restores it.
///
/// Draco and meshopt compression are decoded where there are no plain bytes beside.
///
/// `dropped`, when given, receives what the model cannot hold, one phrase each: extensions that
/// speak of the vertex order of the file or whose references nobody here knows (they are left out),
/// indices beyond whole faces, bytes after the end of a .glb.
///
/// errors  truncated, corrupt, over_limit, with a byte offset or a JSON pointer; unsupported for
///         glTF 1.0, for required extensions that this build does not know, and for URIs that leave
///         the folder;
///         whatever `read_file` answers
/// cost    O(size) and memory by `limits`; same bytes, same model
Result<Model> read_gltf(ByteView file, const ReadFile& read_file, const Limits& limits = {},
                        std::vector<std::string>* dropped = nullptr);

/// How triangles are written. glTF 2.0 has no primitive restart.
enum class GltfTopology : std::uint8_t {
  triangles,      ///< triangle lists
  strips,         ///< one primitive a strip
  joined_strips,  ///< one strip a group, its parts joined by repeated indices
};

struct GltfWriteOptions {
  bool binary = true;  ///< .glb, else .gltf
  /// Strips continue as far as the next triangle in face order shares the edge that a strip needs;
  /// a mesh whose faces stand in strip order keeps its strips.
  GltfTopology topology = GltfTopology::triangles;
  /// A strip may turn by a repeated index where a triangle stands on the last one's other edge.
  bool swaps = false;
  bool embed = false;  ///< .gltf only: the buffer as a data URI
  /// Images with data and a URI go into the buffer; else they are named, and the caller writes
  /// them.
  bool embed_images = true;
  std::string buffer_name = "buffer.bin";  ///< .gltf only: file name of the buffer
};

struct GltfFiles {
  Bytes main;
  std::vector<std::pair<std::string, Bytes>> others;  ///< name and content; at most the buffer
  std::vector<std::string> dropped;    ///< what glTF or the options cannot hold, one phrase each
  std::vector<std::string> converted;  ///< what they hold in another way
};

/// Writes a model as glTF 2.0. A model that came from read_gltf gets back its meshes, primitives
/// and the rest of its asset; then read_gltf(write_gltf(model)) equals the model, unless something
/// is reported as dropped. Any other model, or one whose meshes, materials or images no longer
/// fit what was kept, becomes a new asset of the generic scene.
///
/// What glTF forbids is not written: vertices that are no numbers go with their faces, values are
/// mended (see mend.h), skins and weights go with the attributes that they need, textures with
/// their coordinates. Positions that f32 would distort (map coordinates) are counted from one
/// origin for all meshes, which stands in the translation of a node.
/// Texture coordinates from the lower left are turned. Materials become metallic-roughness ones
/// with KHR_texture_transform where their maps are moved. Colours beyond 1 are taken for numbers up
/// to 255 or 65535.
///
/// Polygons become triangle fans, f64 and other types that glTF forbids f32; names that glTF does
/// not know get a leading '_'. Indices take the smallest type and never its largest value.
///
/// errors  over_limit when the buffer or the file would reach 4 GiB
/// cost    O(size); same model and options, same bytes
Result<GltfFiles> write_gltf(const Model& model, const GltfWriteOptions& options = {});

}  // namespace pstrips::inline formats
