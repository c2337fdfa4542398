#pragma once

#include "codecs/collapse.h"
#include "formats/pstrip/text/text.h"

namespace pstrips::inline converters {

/// The collapses of a text file with what becomes of each wedge, as record() takes them: wedges of
/// a removed triangle map to the other wedge on its edge (first triangle wins), others are
/// reassigned. Vertices that appeared on their own, or that no triangle shows at full resolution,
/// are left to record(), which lets them appear last; their collapses are left out, and what they
/// say of where the kept vertex goes. Errors are 0: the text has none.
///
/// cost  O(n log n): of two vertices' triangle lists the shorter is moved
CollapseSequence collapses_of(const TextProgressive& text);

}  // namespace pstrips::inline converters
