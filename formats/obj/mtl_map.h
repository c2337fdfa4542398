#pragma once

#include <string>
#include <string_view>

#include "core/scene.h"

namespace pstrips::inline formats::obj {

/// What follows a `map_…` word: options, then a file. [WavefrontMtl]
struct MapStatement {
  std::string file;     ///< '/' between its parts; empty: the statement names none
  char channel = '\0';  ///< of -imfchan: r g b m l z
  TextureMap map;       ///< where -o, -s and -bm put it; no image
};
MapStatement parse_map(std::string_view text);

/// The same as text, from the word on, with a line end. What MTL cannot say of a map is left out:
/// its rotation and set of texture coordinates.
std::string map_line(std::string_view word, const MapStatement& statement);

}  // namespace pstrips::inline formats::obj
