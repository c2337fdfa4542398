#include "core/parallel.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace pstrips {
namespace {

TEST(ParallelFor, CutsTheSameRunsForAnyNumberOfThreads) {
  for (const unsigned threads : {1u, 2u, 5u}) {
    std::vector<std::size_t> begin_of(103, 999), calls(103, 0);
    parallel_for(threads, begin_of.size(), 10, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) begin_of[i] = begin, ++calls[i];
    });
    for (std::size_t i = 0; i < begin_of.size(); ++i) {
      EXPECT_EQ(begin_of[i], i / 10 * 10) << threads;
      EXPECT_EQ(calls[i], 1u) << threads;
    }
  }
}

TEST(ParallelFor, DoesNothingForNothing) {
  parallel_for(4, 0, 10, [](std::size_t, std::size_t) { ADD_FAILURE(); });
}

TEST(ParallelFor, RunsOnSeveralThreads) {
  std::atomic<unsigned> here{0};
  // Each of the two waits for the other, which one thread alone could not.
  parallel_for(2, 2, 1, [&](std::size_t, std::size_t) {
    ++here;
    while (here < 2) std::this_thread::yield();
  });
  EXPECT_EQ(here, 2u);
}

TEST(ParallelFor, ThrowsWhatABodyThrew) {
  for (const unsigned threads : {1u, 3u})
    EXPECT_THROW(parallel_for(threads, 100, 1,
                              [](std::size_t begin, std::size_t) {
                                if (begin == 42) throw std::length_error("42");
                              }),
                 std::length_error);
}

TEST(ParallelInvoke, CallsEachOnce) {
  for (const unsigned threads : {1u, 2u}) {
    int a = 0, b = 0, c = 0;
    parallel_invoke(
        threads, [&] { a += 1; }, [&] { b += 2; }, [&] { c += 3; });
    EXPECT_EQ(a, 1);
    EXPECT_EQ(b, 2);
    EXPECT_EQ(c, 3);
  }
}

TEST(ThreadCount, IsWhatIsWantedOrWhatTheMachineHas) {
  EXPECT_EQ(thread_count(3), 3u);
  EXPECT_GE(thread_count(0), 1u);
}

}  // namespace
}  // namespace pstrips
