#pragma once

#include <string>
#include <vector>

#include "core/limits.h"
#include "core/result.h"
#include "core/scene.h"

namespace pstrips::inline formats {

/// Reads a PLY 1.0 file: ascii, binary little- or big-endian. [Turk94]
///
/// file     the whole file; nothing points into it afterwards
/// returns  a model of one mesh; of none when the file has no vertex element
/// cost     O(size); a header's promises are checked against the bytes before anything is allocated
/// errors   truncated, corrupt, over_limit, unsupported, with the byte offset; in the header and in
///          ascii bodies also with the line
///
/// What becomes what:
/// - x y z: POSITION in their common type, f64 when their types differ. Row i is vertex i; equal
///   positions are not welded.
/// - nx ny nz: NORMAL. red green blue [alpha] (also diffuse_red …, r g b [a]): COLOR_n.
///   s t, u v, texture_u texture_v, s0 t0 …: TEXCOORD_n. Each only when its properties have one
///   fitting type (floats; u8 and u16 for colours and texture coordinates, i8 and i16 for normals,
///   all normalized). Faces have NORMAL and COLOR_n likewise.
/// - NAME[0] NAME[1] …, written by `write_ply` for what PLY has no word for: one attribute NAME.
/// - every other scalar of a vertex or a face: an attribute of that name; a second "a" is "a~2".
/// - vertex_indices or vertex_index: faces of any size. tristrips: triangles, the degenerate ones
///   left out, after the faces.
/// - the faces' texcoord lists: wedges with TEXCOORD_0, when every face has one pair a corner.
///   Equal pairs at a vertex are one wedge; wedges ascend by vertex, then by first use; a vertex
///   without a face has one wedge with zeros.
/// - texture coordinates are from the lower left corner of an image.
/// - `comment TextureFile`: an image and a material each. With `texnumber` each has its group.
/// - edges with vertex1 and vertex2 alone: lines of two corners, in a group behind the others,
/// whose
///   face attributes are zeros.
/// - comments, obj_info, other elements and lists, and bytes after the end of a binary body (which
///   other readers ignore): Scene::foreign, so that write_ply puts them back.
///
/// Ascii rows are lines: a row of too few or too many values is corrupt. "nan", "inf" (any case,
/// signed), "nan(0x…)" with a payload and 1.#INF, 1.#QNAN are read. A file cut inside the last
/// number of an ascii body looks like a whole one without its final newline.
Result<Model> read_ply(ByteView file, const Limits& limits = {});

struct PlyWriteOptions {
  enum class Format : std::uint8_t { ascii, little_endian, big_endian };
  Format format = Format::little_endian;
  unsigned threads = 0;  ///< see thread_count(); the bytes are the same
};

/// Writes a model of one mesh (or of none: elements without vertices only) as PLY 1.0.
///
/// A model that read_ply made comes back with its own property names, types, order, comments and
/// elements: read(write(m)) == m in all three formats. Ascii numbers are the shortest that read
/// back to the same bits, NaN payloads included. Two things are left out: foreign rows bound to
/// vertices (edges, lists of vertices and faces) once vertices or faces have changed, and bytes
/// after the end in ascii.
///
/// Lines become edges, one for each two corners that follow each other; points are vertices
/// without a face. Face attributes of both are left out.
///
/// Attributes that all wedges of a vertex share are vertex properties. Where wedges differ in
/// TEXCOORD_0 alone, faces get a texcoord list. Otherwise each wedge is a row, and a property
/// wedge_vertex under a comment of ours lets read_ply find the vertices again.
///
/// Texture coordinates are written as they are: from the lower left is for the caller to see to,
/// with_texture_origin().
///
/// PLY has no words for nodes, names, embedded images, materials beyond a texture's name: they are
/// not written. Normalized integer positions are written as doubles in model units.
///
/// cost    O(size); same model, same bytes
/// errors  bad_argument for several meshes, an inconsistent mesh or foreign data that does not
///         parse; unsupported for positions of other than three components
///
/// dropped  receives names of elements and lists that are left out, unless null
Result<Bytes> write_ply(const Model& model, const PlyWriteOptions& options = {},
                        std::vector<std::string>* dropped = nullptr);

/// Whether the scene of a model that read_ply made has rows that mean something only while vertices
/// and faces keep their order: edges, lists of vertices and faces.
bool has_rows_bound_to_order(const Scene& scene);

}  // namespace pstrips::inline formats
