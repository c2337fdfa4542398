#pragma once

#include <vector>

#include "formats/ply/ply_header.h"

namespace pstrips::inline formats::ply {

// What is erased leaves its remarks to the next line of the header. `gone` has a value for each
// element or property.

void erase_elements(Header& header, const std::vector<bool>& gone);
/// Precondition: the element is one of the header's.
void erase_properties(Header& header, Element& element, const std::vector<bool>& gone);

/// Changes type and word together; a word for the same type stays as it was spelled.
void set_type(Property& property, ComponentType type);
/// Makes the counts of a list large enough for lists of that length.
void widen_count(Property& list, std::uint64_t length);

/// Whether an integer type holds the value; floats hold all.
bool fits(ComponentType type, std::uint64_t value);

}  // namespace pstrips::inline formats::ply
