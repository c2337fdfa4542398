#pragma once

#include <span>

#include "codecs/weld/weld.h"
#include "core/progressive_strips.h"

namespace pstrips::inline codecs {

struct WeldingRecord {
  Welding welding;
  /// Of what unweld() gives: for each vertex and wedge, its number in the source.
  std::vector<Index> vertex_from, wedge_from;
};

/// Notes how a mesh that was welded and then decoded becomes the source again.
///
/// source      before it was welded
/// decoded     as decoders have it before unweld()
/// wedge_from  for each wedge of `decoded`, its number in the welded source
/// order       for each face of `decoded`, where it stood in the source, and its rotation
/// cost        O(size)
WeldingRecord record_welding(const Mesh& source, const Welds& welds, const Mesh& decoded,
                             std::span<const Index> wedge_from, const OriginalOrder& order);

}  // namespace pstrips::inline codecs
