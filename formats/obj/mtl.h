#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/limits.h"
#include "core/result.h"
#include "core/scene.h"

namespace pstrips::inline formats::obj {

/// What a name in `usemtl` stands for when no .mtl file has it.
Material named_material(std::string name);

/// Appends the materials of an .mtl file and the images of their maps, by the formulas of obj.h.
/// Words count in any case. A value that is not understood leaves the material's default: the text
/// itself is kept beside it.
///
/// errors  over_limit by number of materials
Result<void> read_mtl(std::string_view text, Scene& scene, const Limits& limits);

/// The text from which read_mtl makes these materials.
///
/// names    one a material: distinct, clean, not empty
/// dropped  receives what MTL has no words for
std::string write_mtl(const Scene& scene, const std::vector<std::string>& names,
                      std::set<std::string>& dropped);

}  // namespace pstrips::inline formats::obj
