#pragma once

#include "codecs/stripify/linked_paths.h"
#include "codecs/stripify/stripify.h"

namespace pstrips::inline codecs {

inline constexpr int kAnySwaps = 1 << 30;

/// Joins strips by tunnels. A tunnel leads from an end of one strip to an end of another over edges
/// of the dual graph that are linked and not linked by turns, the first and the last one not;
/// changing every edge of it makes the two strips one. [Stewart01; Vanecek05 §2.2]
///
/// From every end in turn the shortest tunnel of at most `options.tunnel_length` edges that adds
/// at most `most_swaps` swaps is looked for, breadth first, and dug; round after round until none
/// is found, until the searches have made `options.tunnel_effort` steps a triangle (a step
/// counts one more for every eight before it), or `options.stop` says so.
///
/// Changing a tunnel may bend strips into rings, and the longer it is, the likelier. Here a step
/// that closes a ring is not taken, so that every tunnel found can be dug. Where rings are looked
/// for in the tunnel found only, and a search that found one is given up, cow keeps 31 strips and
/// bunny 160 ([Vanecek05 table 8.3]: 19 and 166); this way 2 and 17 are left.
///
/// cost  at most tunnel_effort n steps, each of some tunnel_length^2 operations at worst and a few
///       in practice; a tunnel that is dug, as much as the strips it changes are long
void dig_tunnels(LinkedPaths& paths, const StripOptions& options, int most_swaps = kAnySwaps);

/// SGI's strips (sgi_strips_links), joined by tunnels.
Strips tunneling(const StripInput& input, const StripOptions& options);

}  // namespace pstrips::inline codecs
