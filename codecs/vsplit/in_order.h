#pragma once

#include <span>

#include "core/mesh.h"

namespace pstrips::inline codecs {

/// The attribute with the elements order[0], order[1] … of another.
Attribute in_order(const Attribute& from, std::span<const Index> order);

}  // namespace pstrips::inline codecs
