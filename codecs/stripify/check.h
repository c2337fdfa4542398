#pragma once

#include <span>
#include <string>

#include "codecs/stripify/stripify.h"

namespace pstrip {

/// What is wrong with `strips` as a stripification of `input`, as a phrase; empty when they cover
/// every triangle exactly once with its winding, in ascending order of group, no strip across
/// groups, none without a triangle. Looks at the indices alone: nothing of what made them is used.
///
/// cost  O(n log n)
std::string find_strip_fault(const StripInput& input, std::span<const Index> strips);

}  // namespace pstrip
