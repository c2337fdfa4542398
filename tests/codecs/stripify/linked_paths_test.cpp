#include "codecs/stripify/linked_paths.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "codecs/stripify/path_index.h"
#include "codecs/stripify/random.h"
#include "tests/support/meshes.h"
#include "tests/support/strip_check.h"

namespace pstrips {
namespace {

using test::StripMesh;

// Swaps of an index map but for those that only mend a strip's start, which come second.
int inner_swaps(const Strips& strips) {
  int swaps = 0;
  std::size_t start = 0;
  for (std::size_t i = 0; i + 2 < strips.size(); ++i) {
    if (strips[i] == kRestart) start = i + 1;
    swaps += i >= start + 2 && strips[i + 1] != kRestart && strips[i] == strips[i + 2];
  }
  return swaps;
}

// The end of the path that leaves over `exit`, step by step.
bool walks_to(const LinkedPaths& paths, Index exit, Index t) {
  for (Index h = exit; h != kNone; h = paths.other_link(paths.opposite(h)))
    if (LinkedPaths::triangle_of(paths.opposite(h)) == t) return true;
  return false;
}

// Links and cuts at random, as far as paths stay paths.
void shuffle(LinkedPaths& paths, Random& random, int moves) {
  for (; moves > 0; --moves) {
    const Index h = LinkedPaths::half_edge(random.below(paths.triangle_count()), random.below(3));
    if (!paths.has_opposite(h)) continue;
    const Index s = LinkedPaths::triangle_of(h), t = LinkedPaths::triangle_of(paths.opposite(h));
    if (paths.is_linked(h)) {
      if (random.below(4) == 0) paths.flip(h);
    } else if (paths.is_end(s) && paths.is_end(t) && !paths.on_same_path(s, t)) {
      paths.flip(h);
    }
  }
}

RC_GTEST_PROP(LinkedPaths, KeepStripsThatCoverTheMesh, (std::uint32_t seed)) {
  const StripMesh mesh = test::strip_mesh(test::random_soup(seed, 15, 150));
  const DualGraph graph = make_dual_graph(mesh.input());
  LinkedPaths paths(graph, Links(graph.half_edge_count()));
  RC_PRE(paths.triangle_count() > 0);
  Random random(seed);
  shuffle(paths, random, 2000);
  const Strips strips = emit_strips(mesh.input(), graph, paths.links());
  RC_ASSERT(test::find_strip_fault(mesh.input(), strips) == "");
}

RC_GTEST_PROP(LinkedPaths, PriceALinkAsTheIndexMapDoes, (std::uint32_t seed)) {
  const StripMesh mesh = test::strip_mesh(test::torus(6, 5));
  const DualGraph graph = make_dual_graph(mesh.input());
  LinkedPaths paths(graph, Links(graph.half_edge_count()));
  Random random(seed);
  shuffle(paths, random, 2000);
  const int before = inner_swaps(emit_strips(mesh.input(), graph, paths.links()));
  for (Index t = 0; t < paths.triangle_count(); ++t) {
    const Index h = LinkedPaths::half_edge(t, random.below(3));
    if (!paths.is_linked(h)) continue;
    const int swaps = paths.link_cost(h);
    paths.flip(h);
    RC_ASSERT(paths.link_cost(h) == swaps);
    RC_ASSERT(inner_swaps(emit_strips(mesh.input(), graph, paths.links())) == before - swaps);
    paths.flip(h);
  }
}

RC_GTEST_PROP(LinkedPaths, KnowWherePathsLead, (std::uint32_t seed)) {
  const StripMesh mesh = test::strip_mesh(test::torus(4, 4));
  LinkedPaths paths(make_dual_graph(mesh.input()), Links(mesh.triangles.size()));
  Random random(seed);
  shuffle(paths, random, 500);
  for (Index t = 0; t < paths.triangle_count(); ++t) {
    if (!paths.is_end(t)) continue;
    for (Index s = 0; s < paths.triangle_count(); ++s)
      for (Index k = 0; k < 3; ++k) {
        const Index exit = LinkedPaths::half_edge(s, k);
        if (s == t || !paths.is_linked(exit)) continue;
        RC_ASSERT(paths.leads_to(exit, t) == walks_to(paths, exit, t));
      }
  }
}

RC_GTEST_PROP(BreakSet, FindsTheNextEitherWay, (std::uint32_t seed)) {
  Random random(seed);
  const Index size = 2 + random.below(20'000);
  BreakSet breaks;
  breaks.reset(size);
  std::vector<bool> expected(size);
  for (int i = 0; i < 40; ++i) {
    const Index at = random.below(size);
    const bool on = random.below(3) != 0;
    breaks.set(at, on);
    expected[at] = on;
  }
  breaks.set(0, true);
  breaks.set(size - 1, true);
  expected.front() = expected.back() = true;
  for (int i = 0; i < 40; ++i) {
    const Index at = random.below(size);
    Index first = at, last = at;
    while (!expected[first]) ++first;
    while (!expected[last]) --last;
    RC_ASSERT(breaks.first_from(at) == first);
    RC_ASSERT(breaks.last_to(at) == last);
  }
}

// More changes than it takes to number anew.
RC_GTEST_PROP(PathIndex, FindsEndsWhileLinksChange, (std::uint32_t seed)) {
  const StripMesh mesh = test::strip_mesh(test::torus(9, 8));
  LinkedPaths paths(make_dual_graph(mesh.input()), Links(mesh.triangles.size()));
  Random random(seed);
  PathIndex index(paths);
  for (int i = 0; i < 3000; ++i) {
    const Index h = LinkedPaths::half_edge(random.below(paths.triangle_count()), random.below(3));
    const Index s = LinkedPaths::triangle_of(h), t = LinkedPaths::triangle_of(paths.opposite(h));
    if (paths.is_linked(h)) {
      Index at = h, end = s;
      for (; at != kNone; at = paths.other_link(paths.opposite(at)))
        end = LinkedPaths::triangle_of(paths.opposite(at));
      RC_ASSERT(index.end_over(h) == end);
      if (random.below(8) == 0) index.flip(h);
    } else if (paths.is_end(s) && paths.is_end(t) && index.mate(s) != t) {
      RC_ASSERT(!paths.on_same_path(s, t));
      index.flip(h);
    }
  }
}

}  // namespace
}  // namespace pstrips
