#include "codecs/stripify/stripify.h"

#include <algorithm>

#include "codecs/stripify/best.h"
#include "codecs/stripify/cache.h"
#include "codecs/stripify/delaunay.h"
#include "codecs/stripify/dstrips.h"
#include "codecs/stripify/ftsg.h"
#include "codecs/stripify/mstrip.h"
#include "codecs/stripify/multi_path.h"
#include "codecs/stripify/qstrip.h"
#include "codecs/stripify/sgi.h"
#include "codecs/stripify/stripe.h"
#include "codecs/stripify/tunneling.h"

namespace pstrips::inline codecs {
namespace {

// A new algorithm takes three files: its header, its source, and a row here.
constexpr NamedStripifier kStripifiers[] = {
    {.name = "best",
     .source = "ours, codecs/stripify/best.h",
     .run = best_strips,
     .run_polygons = best_polygon_strips,
     .honors_goal = true},
    {.name = "sgi-strips", .source = "[Vanecek02 §3; Vanecek05 §8.1 SGS]", .run = sgi_strips},
    {.name = "sgi-vertices", .source = "[Vanecek02 §3; Vanecek05 §8.1 SGV]", .run = sgi_vertices},
    {.name = "dstrips-greedy", .source = "[Shafae03 §5.1]", .run = dstrips_greedy},
    {.name = "dstrips-greedy-noswap", .source = "[Shafae03 §5.1]", .run = dstrips_greedy_no_swap},
    {.name = "dstrips-adjacency", .source = "[Shafae03 §5.2]", .run = dstrips_adjacency},
    {.name = "mstrip",
     .source = "[Silva02; Vanecek05 §2.2, §8.1 MSS, MSV]",
     .run = mstrip,
     .honors_goal = true},
    {.name = "multi-path", .source = "[Vanecek05 §4.2]", .run = multi_path},
    {.name = "multi-path-weighted",
     .source = "[Vanecek05 §5.1]",
     .run = multi_path_weighted,
     .honors_weight = true,
     .uses_positions = true},
    {.name = "ftsg", .source = "[Xiang99; Vanecek05 §2.2, §8.1]", .run = ftsg},
    {.name = "ftsg-sgi", .source = "[Xiang99; Vanecek05 §2.2, §8.1 FTS]", .run = ftsg_sgi},
    {.name = "ftsg-alt", .source = "[Xiang99; Vanecek05 §2.2, §8.1 FTV]", .run = ftsg_alt},
    {.name = "tunneling", .source = "[Stewart01 §3; Vanecek05 §2.2, §8.1 TUS]", .run = tunneling},
    {.name = "qstrip",
     .source = "[Vanecek05 §7.3]",
     .run = qstrip,
     .run_polygons = qstrip_polygons,
     .honors_goal = true,
     .uses_positions = true},
    {.name = "cache", .source = "ours, codecs/stripify/cache.h", .run = cache_strips},
    {.name = "stripe-lookahead",
     .source = "[Evans96; Vanecek05 §2.2, §8.1 STS]",
     .run = stripe_lookahead,
     .run_polygons = stripe_lookahead_polygons,
     .uses_positions = true},
    {.name = "stripe-noswap",
     .source = "[Evans96; Vanecek05 §2.2, §8.1 STV]",
     .run = stripe_noswap,
     .run_polygons = stripe_noswap_polygons,
     .uses_positions = true},
};

constexpr NamedPointStripifier kPointStripifiers[] = {
    {.name = "best", .source = "ours, codecs/stripify/best.h", .run = best_point_strips},
    {.name = "delaunay", .source = "[Vanecek05 §3.2]", .run = delaunay_strips},
};

template <class Named>
const Named* find_named(std::span<const Named> all, std::string_view name) {
  const auto found = std::ranges::find(all, name, &Named::name);
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

std::span<const NamedStripifier> stripifiers() { return kStripifiers; }

const NamedStripifier* find_stripifier(std::string_view name) {
  return find_named(stripifiers(), name);
}

std::span<const NamedPointStripifier> point_stripifiers() { return kPointStripifiers; }

const NamedPointStripifier* find_point_stripifier(std::string_view name) {
  return find_named(point_stripifiers(), name);
}

}  // namespace pstrips::inline codecs
