#pragma once

#include <cstdint>
#include <vector>

#include "cli/command.h"
#include "converters/encode.h"

namespace pstrips::cli {

/// Says how far quantization moved positions and attributes, which attributes stay as they are and
/// why; or, of a file that keeps every bit, what that costs.
///
/// meshes  of a conversion with these options
/// below   see bytes_below_cells(), of so many bytes
void report_bits(const Streams& io, const EncodeOptions& options,
                 const std::vector<SimplifyReport>& meshes, std::uint64_t below,
                 std::uint64_t bytes);

}  // namespace pstrips::cli
