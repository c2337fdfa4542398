#pragma once

#include <span>
#include <vector>

#include "codecs/measure/error_bounds.h"
#include "codecs/vsplit/record.h"
#include "core/progressive_strips.h"

namespace pstrips::inline converters {

/// How the vsplits of a recording become packets.
struct PacketCut {
  std::span<const Index> batches;  ///< the first so many vsplits each
  double growth;    ///< of the others: vertices a packet adds, as a share of those before it …
  Index least;      ///< … and at least so many
  double blur = 0;  ///< how far positions are off, at most, until the mesh is complete
};

/// The base, as a packet without vsplits, and the packets of a mesh.
///
/// bounds  by collapses done, which the vsplits undo from the last on. Vsplits beyond them bring
///         what is not drawn
std::vector<Packet> packets_of(const Recording& recording, std::span<const ErrorBounds> bounds,
                               Index mesh, const PacketCut& cut);

}  // namespace pstrips::inline converters
