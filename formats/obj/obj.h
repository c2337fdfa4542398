#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/file.h"
#include "core/limits.h"
#include "core/result.h"
#include "core/scene.h"

namespace pstrips::inline formats {

// Wavefront OBJ and MTL [WavefrontB1, WavefrontMtl], polygonal part: v vt vn, f l p, o g s,
// mtllib usemtl, with the vertex colours that MeshLab and others append to `v`.

/// Attributes for what a `v` or `vt` line may say beyond glTF's vocabulary.
inline constexpr std::string_view kObjWeight = "_OBJ_WEIGHT";  ///< w of `v x y z w`, wedge
inline constexpr std::string_view kObjTexW = "_OBJ_VT_W";      ///< w of `vt u v w`, wedge
inline constexpr std::string_view kObjSmoothing = "s";  ///< smoothing group, u32 a face; 0 is off

/// u8 a wedge, there only when wedges differ in what they have. The value in an attribute whose
/// bit is clear was not in the file: it is white in colours, else 0.
inline constexpr std::string_view kObjPresent = "_OBJ_PRESENT";
enum ObjPresent : std::uint8_t {
  kHasTexcoord = 1,
  kHasNormal = 2,
  kHasColor = 4,
  kHasWeight = 8,
  kHasTexV = 16,
  kHasTexW = 32,
  kHasAlpha = 64,
};

/// Whether the first line that is neither empty nor a comment begins with a word of OBJ, in text
/// without zeros. cost  O(comments)
bool looks_like_obj(ByteView file);

struct ObjReadOptions {
  bool allow_parent_paths = false;  ///< material libraries may stand outside the model's folder
  /// Receives what is missing, one phrase each: libraries and materials that are not there, corners
  /// that name no vt or vn.
  std::vector<std::string>* notes = nullptr;
};

/// Reads a model as one mesh.
///
/// vertices   the `v` lines in order, never welded; forward references are fine
/// wedges     the distinct (v, value of vt, value of vn), ordered by vertex, then by first corner;
///            a vertex that no corner names has one. NORMAL, TEXCOORD_0, COLOR_0 (rgb, or rgba
///            when a line has four), then the attributes above
/// numbers    an attribute is f32 when the shortest decimals of its floats are the numbers of the
///            file, else f64: no decimal of up to 17 digits is lost
/// faces      `f`, `l` and `p` in file order, of any size, never triangulated; a `p` line is one
///            face for each of its points
/// corners    a vt or vn of 0 or out of range is none, as other readers have it
/// groups     the distinct (object, groups, material, kind) in order of use; each `o` begins
/// another
///            object. Group::name as obj_group_name makes it; when all faces are of one object, it
///            is Mesh::name instead. A name that ends in a backslash does not swallow a statement
/// textures   (0, 0) is the lower left corner
/// clouds     in a file without any face, vt and vn belong to the vertices if there are as many
/// materials  those of all .mtl files in order (the first of a name counts), then those that only
///            `usemtl` knows; words count in any case. Kd is linear colour; d, or 1 - Tr, is alpha,
///            which blends when it is below 1 or has a map_d; Ke is emission; Pm is metallic, else
///            0. roughness is Pr, else 1 where Ks is black or illum is 0 or 1, else sqrt(2 / (Ns +
///            2)): the Beckmann lobe as wide as Blinn's of that exponent [Walter07 §5.2]. map_Kd,
///            map_Ke, map_Pm, map_Pr, map_d and norm are maps, bump too, as exporters use it; a
///            factor that is not written is 1 where there is a map. -o and -s move a map, -bm is
///            its strength
/// foreign    "obj/header" the comment lines at the top; "obj/mtl" the text of the .mtl files;
///            "obj/mtllib" names that could not be read, which is no error; "obj/notes"
///            statements that were not interpreted (free-form geometry, display attributes) and
///            how many vt and vn lines no corner names
/// text       names that are not UTF-8 are taken for Latin-1; control characters become spaces
///
/// errors  corrupt, over_limit, or truncated when the last line stops short; with the offset and
///         "line N". An index that is 0 or names nothing is corrupt
/// cost    O(size), no more than 30 times the file's size in memory
Result<Model> read_obj(ByteView file, const ReadFile& read_file, const Limits& limits = {},
                       const ObjReadOptions& options = {});

struct ObjFiles {
  Bytes obj;
  Bytes mtl;             ///< empty: no material needs a file
  std::string mtl_name;  ///< what `mtllib` says; empty with `mtl`
  /// What OBJ has no words for: attribute semantics, and phrases such as "node transforms".
  std::vector<std::string> dropped;
};

/// Writes a model; several meshes become several objects. The numbers are the shortest decimals
/// that read back to the same float or double. read_obj of the result is the model again, exactly,
/// if it came from read_obj. The .mtl text is the original one as long as it still says what the
/// materials are. A new one has Pm and Pr, and for those who know neither Ks = 0.04 (1 - metallic)
/// + Kd metallic and Ns = 2 / roughness² - 2, at most 1000.
///
/// Texture coordinates from the upper left are turned: the shortest decimal from which 1 - v is the
/// float again.
///
/// model     its meshes are consistent (find_inconsistency), its indices name what is there
/// mtl_name  for `mtllib`; relative, see ReadFile; may be empty: then no .mtl is made
/// threads   to work with, see thread_count(); the bytes are the same
/// errors    bad_argument for an mtl_name that a reader would refuse
Result<ObjFiles> write_obj(const Model& model, std::string mtl_name, unsigned threads = 0);

/// One name for an object and its group names: "group" without an object, else "object/" or
/// "object/group"; '%' and '/' within an object are written "%25" and "%2F". The second object of a
/// name is "object%n2/", the third "object%n3/".
std::string obj_group_name(std::string_view object, std::string_view group, Index instance = 1);

}  // namespace pstrips::inline formats
