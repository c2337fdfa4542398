#pragma once

#include "codecs/stripify/linked_paths.h"
#include "codecs/stripify/stripify.h"

namespace pstrips::inline codecs {

/// Joins the last strips, which no tunnel of bearable length joins any more, until there is one a
/// component or none of `options.effort` moves a triangle is left.
///
/// An end walks, slide by slide, to the nearest end of another strip: of the legal slides the one
/// that gets nearest, with some noise and a price for swaps. Walks that lead nowhere are not taken
/// back: they bring other ends within reach, of tunnels too. Paths are followed by PathIndex, since
/// few strips are long ones.
void join_strips(LinkedPaths& paths, const StripOptions& options);

}  // namespace pstrips::inline codecs
