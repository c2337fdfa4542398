#include "core/equal_elements.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <span>

#include "core/group_by.h"
#include "core/parallel.h"

namespace pstrips::inline core {
namespace {

struct HashedElement {
  std::uint64_t hash = 0;
  Index i = 0;
};

std::vector<HashedElement> hash_elements(ByteView table, std::size_t size, unsigned threads) {
  constexpr std::size_t kGrain = 16 << 10;
  std::vector<HashedElement> out(table.size() / size);
  parallel_for(threads, out.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      std::uint64_t hash = 0;
      for (std::size_t at = 0; at < size; at += 4) {
        std::uint32_t word = 0;
        std::memcpy(&word, table.data() + i * size + at, std::min<std::size_t>(4, size - at));
        hash = (hash ^ word) * 0x9e3779b97f4a7c15;  // 2^64 / golden ratio: spreads close values
        hash ^= hash >> 29;
      }
      out[i] = {hash * 0x9e3779b97f4a7c15, static_cast<Index>(i)};
    }
  });
  return out;
}

/// By the upper bits of their hashes, some eight a bucket.
Grouped<HashedElement> sort_into_buckets(const std::vector<HashedElement>& in) {
  const int bits = std::max(1, static_cast<int>(std::bit_width(in.size())) - 3);
  return group_each<HashedElement>(std::size_t{1} << bits, [&](auto&& visit) {
    for (const HashedElement& e : in) visit(e.hash >> (64 - bits), [&] { return e; });
  });
}

}  // namespace

// Buckets are sorted, so that no choice of bytes makes it slow.
std::vector<Index> first_equals(ByteView table, std::size_t size, unsigned threads) {
  assert(size > 0 && table.size() % size == 0);
  const auto compare = [&](const HashedElement& a, const HashedElement& b) {
    return std::memcmp(table.data() + a.i * size, table.data() + b.i * size, size);
  };
  const auto is_before = [&](const HashedElement& a, const HashedElement& b) {
    if (a.hash != b.hash) return a.hash < b.hash;
    const int order = compare(a, b);
    return order != 0 ? order < 0 : a.i < b.i;
  };
  Grouped<HashedElement> buckets = sort_into_buckets(hash_elements(table, size, threads));
  std::vector<Index> first(table.size() / size);
  constexpr std::size_t kGrain = 2048;
  parallel_for(threads, buckets.keys(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const std::span<HashedElement> bucket = buckets[b];
      std::ranges::sort(bucket, is_before);
      for (std::size_t k = 0; k < bucket.size(); ++k) {
        const bool same =
            k > 0 && bucket[k].hash == bucket[k - 1].hash && compare(bucket[k], bucket[k - 1]) == 0;
        first[bucket[k].i] = same ? first[bucket[k - 1].i] : bucket[k].i;
      }
    }
  });
  return first;
}

}  // namespace pstrips::inline core
