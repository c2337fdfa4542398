#include "formats/gltf/extensions/extension.h"

namespace pstrips::inline formats::gltf {

// Extensions that list vertices or edges of triangles in the order of the file, which a model does
// not keep.
constinit const Extension kMeshManifold = {.name = "EXT_mesh_manifold", .fate = Fate::dropped};
constinit const Extension kEdgeVisibility = {.name = "EXT_mesh_primitive_edge_visibility",
                                             .fate = Fate::dropped};
constinit const Extension kPrimitiveOutline = {.name = "CESIUM_primitive_outline",
                                               .fate = Fate::dropped};

}  // namespace pstrips::inline formats::gltf
