#pragma once

#include "codecs/stripify/emit.h"

namespace pstrips::inline codecs {

// Many paths grown at once. A triangle is open to as many others as it has edges left to link;
// next is always one of the lowest class of
//
//   alone and open to none (a strip of its own), alone and open to 1, an end of a strip open to 1,
//   alone and open to 2, an end open to 2, alone and open to 3,
//
// which is linked over one of its open edges. A triangle with two links closes its others; so is
// an edge closed that would bend a strip into a ring. [Vanecek05 §4.2: U0, U1, C1, U2, C2, U3]
//
// The thesis does not say which triangle of a class is first. Here it is the one that came into the
// class first, over its first open edge: the paths then wind about what is already covered. Cow
// gives 17 strips as in [Vanecek05 table 8.3], bunny 34 instead of 154; last in first out, 27 and
// 146.

/// cost  O(n)
Strips multi_path(const StripInput& input, const StripOptions& options);
Links multi_path_links(const DualGraph& graph);

/// Of the lowest class, the triangle and edge with the least difference between the weights of the
/// two triangles. [Vanecek05 §5.1] with these choices:
///
/// axis         the largest x of the corners. The thesis says "according to the X-coordinates"; of
///              their mean come 1.4 to 1.8 times as many strips (cow 23 against 16 here and 16
///              published, bunny 109 against 61 and 86)
/// topological  the largest distance of a corner from the first one of its component, in edges of
///              the mesh: strips then run around that corner. Also taken when there are no
///              positions. Ours; the thesis leaves it open
///
/// Differences count to a sixteenth, and not at all below 2^-16 of the largest, so that
/// candidates stay in buckets: the thesis searches the whole class for the least one.
///
/// cost  O(n)
Strips multi_path_weighted(const StripInput& input, const StripOptions& options);

}  // namespace pstrips::inline codecs
