#include "core/equal_elements.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <span>

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

/// Elements by the upper bits of their hashes, some eight a bucket.
struct Buckets {
  std::vector<Index> first;  ///< into `elements`, one a bucket and one past the end
  std::vector<HashedElement> elements;
};

Buckets sort_into_buckets(const std::vector<HashedElement>& in) {
  const int bits = std::max(1, static_cast<int>(std::bit_width(in.size())) - 3);
  const int shift = 64 - bits;
  Buckets out;
  out.first.assign((std::size_t{1} << bits) + 1, 0);
  for (const HashedElement& e : in) ++out.first[(e.hash >> shift) + 1];
  std::inclusive_scan(out.first.begin(), out.first.end(), out.first.begin());
  std::vector<Index> next(out.first.begin(), out.first.end() - 1);
  out.elements.resize(in.size());
  for (const HashedElement& e : in) out.elements[next[e.hash >> shift]++] = e;
  return out;
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
  Buckets buckets = sort_into_buckets(hash_elements(table, size, threads));
  std::vector<Index> first(table.size() / size);
  constexpr std::size_t kGrain = 2048;
  parallel_for(threads, buckets.first.size() - 1, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const auto bucket = std::span(buckets.elements)
                              .subspan(buckets.first[b], buckets.first[b + 1] - buckets.first[b]);
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
