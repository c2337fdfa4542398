#pragma once

#include <string>
#include <vector>

#include "formats/gltf/json.h"

namespace pstrips::inline formats::gltf {

/// Takes the extensions out of an asset that may refer, in a way that nobody here knows, to what is
/// renumbered when the asset is read: those that the table does not list and that hold a whole
/// number below `numbered`, under a key that does not follow the convention, or any number within a
/// primitive, where it may speak of the order of vertices. They go everywhere, and from the lists
/// of extensions.
///
/// numbered  how many accessors or views there are, of which the larger
/// returns   their names
/// cost      O(size)
std::vector<std::string> drop_unknown_references(json& root, std::size_t numbered);

}  // namespace pstrips::inline formats::gltf
