#include "codecs/stripify/straight_runs.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "codecs/stripify/random.h"
#include "tests/support/meshes.h"
#include "tests/support/strip_check.h"

namespace pstrips {
namespace {

StripFaces faces_of(const Mesh& mesh) { return make_strip_faces(test::polygon_mesh(mesh).input()); }

// How many free quads follow over `exit`, straight on; kNone when it comes back to its quad.
Index follow(const StripFaces& faces, const std::vector<bool>& taken, Index exit) {
  const Index start = exit;
  for (Index count = 0;; ++count) {
    const Index entry = faces.opposite[exit];
    if (entry == kNone || faces.size(faces.face[entry]) != 4 || taken[faces.face[entry]])
      return count;
    exit = faces.turned(entry, 2);
    if (exit == start || entry == start) return kNone;
  }
}

Index longest_by_walking(const StripFaces& faces, const std::vector<bool>& taken) {
  Index longest = 0;
  for (Index f = 0; f < faces.count(); ++f)
    for (Index h = faces.first[f]; faces.size(f) == 4 && !taken[f] && h < faces.first[f] + 2; ++h) {
      const Index ahead = follow(faces, taken, h);
      const Index length =
          ahead == kNone ? 0 : 1 + ahead + follow(faces, taken, faces.turned(h, 2));
      longest = std::max(longest, length);
    }
  return longest;
}

// Rows are open, but for rings that nothing has been taken of yet, of which the walk knows nothing.
RC_GTEST_PROP(StraightRuns, FindTheLongestWhileFacesAreTaken, (std::uint32_t seed)) {
  const StripFaces faces = seed % 2 ? faces_of(test::joined_to_quads(test::grid(2 + seed % 11)))
                                    : faces_of(test::polygon_soup(seed, 12, 100));
  Random random(seed);
  StraightRuns runs(faces);
  std::vector<bool> taken(faces.count());
  for (Index left = faces.count(); left > 0; --left) {
    const auto row = runs.longest(1);
    RC_ASSERT(row.size() >= longest_by_walking(faces, taken));
    for (std::size_t i = 0; i < row.size(); ++i) {
      const Index f = faces.face[row[i]];
      RC_ASSERT(faces.size(f) == 4 && !taken[f]);
      if (i > 0) RC_ASSERT(faces.opposite[row[i - 1]] == faces.turned(row[i], 2));
    }
    Index f = random.below(faces.count());
    while (taken[f]) f = (f + 1) % faces.count();
    taken[f] = true;
    runs.take(f);
  }
  RC_ASSERT(runs.longest(1).empty());
}

TEST(StraightRuns, AreTheRingsOfATorus) {
  const StripFaces faces = faces_of(test::joined_to_quads(test::torus(7, 12)));
  StraightRuns runs(faces);
  EXPECT_EQ(runs.longest(1).size(), 12u);
  EXPECT_EQ(runs.longest(12).size(), 12u);
  EXPECT_TRUE(runs.longest(13).empty());
}

}  // namespace
}  // namespace pstrips
