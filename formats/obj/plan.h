#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/mesh.h"
#include "formats/obj/obj.h"

namespace pstrips::inline formats::obj {

/// What the writer finds out about a mesh before it writes: its attributes by their role, null
/// where there is none that OBJ has words for.
struct MeshPlan {
  const Attribute *normal = nullptr, *texcoord = nullptr, *texw = nullptr;
  const Attribute *color = nullptr, *weight = nullptr, *smoothing = nullptr;
  const Attribute* present = nullptr;
  std::vector<bool> used;           ///< wedges that a corner names, or all of a cloud
  std::vector<Index> vertex_wedge;  ///< a wedge of each vertex
  bool turns_v = false;             ///< texture coordinates are from the upper left
  bool turns_in_f32 = true;         ///< each v of floats, see obj::turns_in_f32()
  bool cloud = false;               ///< no corners in the file: the n-th vn is the n-th v's

  bool has(std::size_t wedge, ObjPresent what) const {
    return !present || (std::to_integer<int>(present->data[wedge]) & what) != 0;
  }
};

/// alone    the file is to hold no other mesh
/// dropped  receives what OBJ has no words for
MeshPlan plan_mesh(const Mesh& mesh, bool alone, std::set<std::string>& dropped);

}  // namespace pstrips::inline formats::obj
