#pragma once

#include "validators/document.h"

namespace pstrips::inline validators {

/// The byte and the name of a place in a binary file: "PCKT 3, vsplit 17". Cost O(chunk's fields).
Location locate_binary(const Document& doc, const Where& where);

}  // namespace pstrips::inline validators
