#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/scene.h"

namespace pstrips::inline formats {

/// What the rest of a glTF asset holds that only glTF can: animations, skins, cameras, lights,
/// extensions by name, each with how many there are. Empty for a scene that came from no glTF. Cost
/// O(size of what read_gltf kept)
std::vector<std::pair<std::string, std::uint64_t>> kept_kinds(const Scene& scene);

/// Animations, skins, cameras or lights in which two assets differ, by name: what they say, or what
/// their accessors hold. Nothing when neither has any. Cost as kept_kinds().
std::vector<std::string> different_kinds(const Scene& a, const Scene& b);

}  // namespace pstrips::inline formats
