#pragma once

#include "codecs/simplify/simplify.h"
#include "codecs/simplify/vertex_heap.h"

namespace pstrip {

/// Collapses what is on top of the heap until one of SimplifyStop's reasons ends the sequence.
///
/// out            its collapses, triangles left and reason to stop are kept up to date
/// is_limited     an error limit keeps vertices out of the heap
/// try_collapse   try_collapse(vertex): takes its collapse and says true, or gives the vertex
///                another key and says false
template <class TryCollapse>
void collapse_until(CollapseSequence& out, const VertexHeap& heap, std::uint64_t target,
                    bool is_limited, const Progress& progress, TryCollapse&& try_collapse) {
  constexpr std::size_t kProgressInterval = 4096;
  const std::uint64_t start = out.triangles_left;
  out.stop = SimplifyStop::exhausted;
  while (!heap.empty()) {
    if (!try_collapse(heap.top())) continue;
    if (out.triangles_left <= target) {
      out.stop = SimplifyStop::target;
      break;
    }
    if (progress && out.collapses.size() % kProgressInterval == 0 &&
        !progress("simplify", static_cast<double>(start - out.triangles_left) /
                                  static_cast<double>(start - target))) {
      out.stop = SimplifyStop::interrupted;
      break;
    }
  }
  if (out.stop == SimplifyStop::exhausted && out.triangles_left > 0 && is_limited)
    out.stop = SimplifyStop::max_error;
}

}  // namespace pstrip
