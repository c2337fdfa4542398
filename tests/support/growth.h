#pragma once

#include <algorithm>
#include <ctime>

namespace pstrips::test {

/// Whether run(make(4 n)) takes at most 8 times the processor time of run(make(n)): half way
/// between linear work, sorting and the cache included, and quadratic work. One of three tries is
/// enough, since other programs take the cache, too. Less than 5 ms count as 5 ms. The large input
/// is the last that runs.
template <class Make, class Run>
bool grows_linearly(unsigned n, Make&& make, Run&& run) {
  constexpr double kShortest = 0.005, kMaxGrowth = 8;
  const auto small = make(n), large = make(4 * n);
  const auto seconds = [&](const auto& input) {
    const std::clock_t start = std::clock();
    run(input);
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  };
  for (int i = 0; i < 3; ++i) {
    const double most = kMaxGrowth * std::max(seconds(small), kShortest);
    if (seconds(large) <= most) return true;
  }
  return false;
}

}  // namespace pstrips::test
