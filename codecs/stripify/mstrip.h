#pragma once

#include "codecs/stripify/stripify.h"

namespace pstrips::inline codecs {

/// Two strips grown concurrently. [Silva02; Vanecek05 §2.2, §8.1 MSS and MSV with -m 2]
///
/// A strip starts at a triangle with the fewest free neighbours. Of all steps that the four ends of
/// the two strips can take, the one to the triangle with the fewest free neighbours comes next, so
/// that a triangle about to be walled in is fetched by whoever is near. Among equals, few strips:
/// the one whose own best neighbour has the fewest; few indices: the one that takes no swap. An
/// end that is walled in is linked to the end of another strip next to it; when both ends are,
/// another strip starts.
///
/// The thesis says no more than "concurrently using the SGI algorithm": which strip goes on, that
/// strips grow at both ends and when they are connected is our choice. On a torus ours ends in one
/// strip where the original left two.
///
/// cost  O(n)
Strips mstrip(const StripInput& input, const StripOptions& options);

}  // namespace pstrips::inline codecs
