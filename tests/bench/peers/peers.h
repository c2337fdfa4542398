#pragma once

#include <span>

#include "codecs/stripify/stripify.h"

namespace pstrips::bench {

/// Other libraries' stripifiers behind our interface, those that were found when this was built;
/// only for comparison. They promise less than ours: OpenMesh leaves out the triangles that make
/// an edge or a vertex non-manifold, VTK may turn windings around. Their time holds the building
/// of the structure they need, as ours holds the dual graph. Options are not looked at.
std::span<const NamedStripifier> peer_stripifiers();

}  // namespace pstrips::bench
