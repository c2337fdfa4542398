#pragma once

#include <string>

#include "converters/encode.h"

namespace pstrips::test {

/// Encodes a model, writes the file (binary or XML), validates it, reads it again and decodes it.
/// Empty when the model comes back exactly, or with another order where the options allow that;
/// else what went wrong.
std::string round_trip(const Model& model, const EncodeOptions& options, bool xml);

}  // namespace pstrips::test
