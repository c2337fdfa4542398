#pragma once

#include "codecs/simplify/complex.h"
#include "codecs/simplify/simplify.h"
#include "codecs/simplify/vertex_buckets.h"

namespace pstrips::inline codecs {

/// Fetches what the vertices that come next are going to ask for: step by step, since where the one
/// is stands in the other. Always inline: GCC takes a function that only prefetches for one without
/// effect and drops its calls.
[[gnu::always_inline]] inline void look_ahead(const Complex& complex, const VertexBuckets& queue) {
  if (const Index v = queue.ahead(12); v != kNone) complex.prefetch_record(v);
  if (const Index v = queue.ahead(9); v != kNone) complex.prefetch_ring(v);
  if (const Index v = queue.ahead(6); v != kNone) complex.prefetch_triangles(v);
  if (const Index v = queue.ahead(3); v != kNone) complex.prefetch_neighbours(v);
}

/// Collapses what is next in the queue until one of SimplifyStop's reasons ends the sequence.
///
/// out            its collapses, triangles left and reason to stop are kept up to date
/// is_limited     an error limit keeps vertices out of the queue
/// try_collapse   try_collapse(vertex): takes its collapse and says true, or puts the
///                vertex back with a greater key or not at all and says false
template <class TryCollapse>
void collapse_until(CollapseSequence& out, const Complex& complex, VertexBuckets& queue,
                    std::uint64_t target, bool is_limited, const Progress& progress,
                    TryCollapse&& try_collapse) {
  constexpr std::size_t kProgressInterval = 4096;
  const std::uint64_t start = out.triangles_left;
  out.stop = SimplifyStop::exhausted;
  for (Index vertex; (vertex = queue.pop()) != kNone;) {
    look_ahead(complex, queue);
    if (!try_collapse(vertex)) continue;
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

}  // namespace pstrips::inline codecs
