#include "formats/gltf/extensions/extension.h"

namespace pstrips::inline formats::gltf {

// Both names mean the same bytes. Read from the plain buffer of a view, where that has a URI.
namespace {

void read_view(const json&, View& view) { view.compressed = true; }

}  // namespace

constinit const Extension kExtMeshopt = {
    .name = "EXT_meshopt_compression", .fate = Fate::held, .read_view = read_view};
constinit const Extension kKhrMeshopt = {
    .name = "KHR_meshopt_compression", .fate = Fate::held, .read_view = read_view};

}  // namespace pstrips::inline formats::gltf
