#include "core/scene.h"

#include <algorithm>

namespace pstrips::inline core {

const TextureMap* Material::map(MapRole role) const {
  const auto found = std::ranges::find(maps, role, &TextureMap::role);
  return found == maps.end() ? nullptr : &*found;
}

Index Material::image(MapRole role) const {
  const TextureMap* const found = map(role);
  return found ? found->image : kNone;
}

void Material::set_map(const TextureMap& map) {
  const auto at = std::ranges::lower_bound(maps, map.role, {}, &TextureMap::role);
  if (at != maps.end() && at->role == map.role)
    *at = map;
  else
    maps.insert(at, map);
}

}  // namespace pstrips::inline core
