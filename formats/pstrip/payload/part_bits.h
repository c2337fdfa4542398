#pragma once

#include <cstdint>
#include <vector>

#include "core/limits.h"
#include "formats/pstrip/container/chunks.h"
#include "formats/pstrip/container/part.h"

namespace pstrips::inline formats {

/// What the bits of a file are spent on: for each of its chunks, bits by part. A code of the
/// compact profile takes -log2 of its share; what a chunk has beyond its codes is `container`. The
/// sum of a chunk is its bytes, and the signature counts to the first one.
///
/// chunks  from read_chunks() of the same file, which may be broken: from where it is on, the
///         payload of a chunk counts to one part
/// cost    that of decoding the file
std::vector<PartBits> count_part_bits(const ChunkList& chunks, const Limits& limits = {});

}  // namespace pstrips::inline formats
