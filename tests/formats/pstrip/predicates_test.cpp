#include "formats/pstrip/payload/predicates.h"

#include <gtest/gtest.h>

namespace pstrips {
namespace {

using List = std::vector<Index>;
using Found = std::vector<std::size_t>;

/// The elements that a predicate visits when it is told to go on.
template <class Predicate>
Found all_of(Predicate&& predicate) {
  Found found;
  const bool holds = predicate([&](std::size_t i) {
    found.push_back(i);
    return true;
  });
  EXPECT_EQ(holds, found.empty());
  std::size_t visited = 0;
  EXPECT_EQ(predicate([&](std::size_t) { return ++visited, false; }), holds);
  EXPECT_EQ(visited, holds ? 0u : 1u) << "it stops when it is told to";
  return found;
}

TEST(Predicates, AllBelow) {
  const auto found = [](const List& list, std::uint64_t end) {
    return all_of([&](auto&& visit) { return all_below(list, end, visit); });
  };
  EXPECT_EQ(found({}, 0), Found{});
  EXPECT_EQ(found({0, 2, 1}, 3), Found{});
  EXPECT_EQ(found({3, 2, kNone}, 3), (Found{0, 2}));
  EXPECT_EQ(found({kNone}, std::uint64_t{1} << 32), Found{});
}

TEST(Predicates, Bounds) {
  const auto found = [](const List& first, std::size_t size) {
    return all_of([&](auto&& visit) { return are_bounds(first, size, visit); });
  };
  EXPECT_EQ(found({}, 0), Found{});
  EXPECT_EQ(found({}, 4), Found{0});
  EXPECT_EQ(found({0, 3, 3, 4}, 4), Found{}) << "runs may be empty";
  EXPECT_EQ(found({1, 3, 4}, 4), Found{0});
  EXPECT_EQ(found({0, 3, 2, 4}, 4), Found{2});
  EXPECT_EQ(found({0, 3, 5}, 4), Found{2});
  EXPECT_EQ(found({0}, 0), Found{});
}

TEST(Predicates, Permutation) {
  const auto found = [](const List& list) {
    return all_of([&](auto&& visit) { return is_permutation(list, list.size(), visit); });
  };
  EXPECT_EQ(found({}), Found{});
  EXPECT_EQ(found({2, 0, 1}), Found{});
  EXPECT_EQ(found({2, 0, 2}), Found{2});
  EXPECT_EQ(found({3, 0, 0}), (Found{0, 2}));
}

TEST(Predicates, AllDiffer) {
  const auto found = [](const List& list, std::size_t end) {
    return all_of([&](auto&& visit) { return all_differ(list, end, visit); });
  };
  EXPECT_EQ(found({}, 0), Found{});
  EXPECT_EQ(found({4, 0, 2}, 5), Found{});
  EXPECT_EQ(found({4, 0, 4, 0}, 5), (Found{2, 3}));
  EXPECT_EQ(found({kNone, kNone}, 5), Found{}) << "past the end is another demand";
}

TEST(Predicates, Rotations) {
  FaceTable faces;
  faces.first = {0, 5, 5};
  faces.corners = List(5);
  EXPECT_EQ(corners_of_face(faces, 2, 1), 3u);
  EXPECT_EQ(corners_of_face(faces, 2, 2), 5u);
  EXPECT_EQ(corners_of_face(faces, 2, 3), 0u);
  EXPECT_TRUE(is_rotation(4, 5));
  EXPECT_FALSE(is_rotation(5, 5));
  EXPECT_TRUE(is_rotation(0, 0));
  EXPECT_FALSE(is_rotation(1, 0));
}

TEST(Predicates, GroupEntriesAddUpBeyond32Bits) {
  ProgressiveMesh mesh;
  mesh.group_entries = {kNone, 2};
  EXPECT_EQ(sum_of_group_entries(mesh), (std::uint64_t{1} << 32) + 1);
}

}  // namespace
}  // namespace pstrips
