#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace pstrips::inline core {

/// How many threads to work with: `wanted`, or for 0 as many as the machine has cores.
inline unsigned thread_count(unsigned wanted) {
  return wanted > 0 ? wanted : std::max(1u, std::thread::hardware_concurrency());
}

/// Calls body(begin, end) for every run of `grain` numbers below `count` (the last run may be
/// shorter), on up to `threads` threads, the caller's among them. Where the runs are cut depends on
/// `grain` alone: a body that writes only what belongs to its run gives the same for any number of
/// threads.
///
/// Returns when all runs are done. An exception of a body ends the work early; this function throws
/// it again. A thread takes some 20 microseconds to start, so a run should take longer.
///
/// Precondition: grain > 0.
template <class Body>
void parallel_for(unsigned threads, std::size_t count, std::size_t grain, Body&& body) {
  const std::size_t runs = (count + grain - 1) / grain;
  std::atomic<std::size_t> next{0};
  std::atomic<bool> failed{false};
  std::exception_ptr thrown;  // written by whoever sets `failed`, read after all have joined
  const auto work = [&] {
    try {
      for (std::size_t run; (run = next.fetch_add(1)) < runs && !failed;)
        body(run * grain, std::min(count, (run + 1) * grain));
    } catch (...) {
      if (!failed.exchange(true)) thrown = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    for (std::size_t i = 1; i < std::min<std::size_t>(thread_count(threads), runs); ++i) try {
        others.emplace_back(work);
      } catch (const std::exception&) {
        break;  // the system gives no more threads: those that run do all
      }
    work();
  }
  if (thrown) std::rethrow_exception(thrown);
}

/// Calls each of the functions, which must not depend on one another, as parallel_for() does.
template <class... Functions>
void parallel_invoke(unsigned threads, Functions&&... functions) {
  parallel_for(threads, sizeof...(functions), 1, [&](std::size_t begin, std::size_t) {
    std::size_t at = 0;
    ((at++ == begin ? functions() : void()), ...);
  });
}

}  // namespace pstrips::inline core
