#pragma once

#include <cstddef>
#include <span>

#include "core/bytes.h"
#include "core/mesh.h"

namespace pstrips::inline core {

/// The elements rows[0], rows[1] … of a table, one after the other. Cost O(rows).
///
/// table  elements of `element_bytes` > 0 bytes; every row is one of them
Bytes gather(ByteView table, std::size_t element_bytes, std::span<const Index> rows);

/// The same of an attribute.
Attribute gather(const Attribute& attribute, std::span<const Index> rows);

}  // namespace pstrips::inline core
