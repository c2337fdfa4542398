#pragma once

#include <cstddef>
#include <vector>

#include "core/bytes.h"
#include "core/mesh.h"

namespace pstrips::inline core {

/// For each element of a table the first one with the same bytes.
///
/// table   elements of `element_bytes` > 0 bytes, one after the other; at most kMaxCount of them
/// cost    O(n) for most tables, O(n log n) for any; some 40 bytes of memory an element. The result
///         does not depend on the number of threads
std::vector<Index> first_equals(ByteView table, std::size_t element_bytes, unsigned threads);

}  // namespace pstrips::inline core
