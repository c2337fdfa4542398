#include "codecs/stripify/path_index.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace pstrips::inline codecs {

using HalfEdge = LinkedPaths::HalfEdge;

void BreakSet::reset(Index size) {
  words_.assign(size / 64 + 1, 0);
  summary_.assign(words_.size() / 64 + 1, 0);
}

void BreakSet::set(Index i, bool on) {
  std::uint64_t& word = words_[i / 64];
  const std::uint64_t bit = std::uint64_t{1} << (i % 64);
  word = on ? word | bit : word & ~bit;
  const std::uint64_t summary_bit = std::uint64_t{1} << (i / 64 % 64);
  std::uint64_t& summary = summary_[i / 4096];
  summary = word != 0 ? summary | summary_bit : summary & ~summary_bit;
}

Index BreakSet::first_from(Index i) const {
  Index w = i / 64;
  std::uint64_t word = words_[w] & ~std::uint64_t{0} << (i % 64);
  if (word == 0) {
    Index s = ++w / 64;
    std::uint64_t summary = summary_[s] & ~std::uint64_t{0} << (w % 64);
    while (summary == 0) summary = summary_[++s];
    w = 64 * s + static_cast<Index>(std::countr_zero(summary));
    word = words_[w];
  }
  return 64 * w + static_cast<Index>(std::countr_zero(word));
}

Index BreakSet::last_to(Index i) const {
  Index w = i / 64;
  std::uint64_t word = words_[w] & ~std::uint64_t{0} >> (63 - i % 64);
  if (word == 0) {
    assert(w > 0);
    Index s = --w / 64;
    std::uint64_t summary = summary_[s] & ~std::uint64_t{0} >> (63 - w % 64);
    while (summary == 0) summary = summary_[--s];
    w = 64 * s + 63 - static_cast<Index>(std::countl_zero(summary));
    word = words_[w];
  }
  return 64 * w + 63 - static_cast<Index>(std::countl_zero(word));
}

void PathIndex::number() {
  const Index n = paths_.triangle_count();
  position_.assign(n, kNone);
  at_.resize(n + 1);
  breaks_.reset(n + 1);
  breaks_.set(0, true);
  Index next = 1, ends = 0;
  for (Index t = 0; t < n; ++t) {
    if (!paths_.is_end(t) || position_[t] != kNone) continue;
    ++ends;
    HalfEdge exit = paths_.is_single(t) ? kNone : paths_.first_link(t);
    for (Index at = t;; at = LinkedPaths::triangle_of(paths_.opposite(exit)),
               exit = paths_.other_link(paths_.opposite(exit))) {
      position_[at] = next;
      at_[next++] = at;
      if (exit == kNone) break;
    }
    breaks_.set(next - 1, true);
  }
  detours_ = 0;
  // A walk passes one in so many of them; numbering costs as much as 10 n steps or so.
  max_detours_ = 500 + 25 * static_cast<int>(ends);
}

HalfEdge PathIndex::link_to(Index t, Index neighbor) const {
  const HalfEdge link = paths_.first_link(t);
  if (LinkedPaths::triangle_of(paths_.opposite(link)) == neighbor) return link;
  return paths_.other_link(link);
}

Index PathIndex::end_over(HalfEdge exit) const {
  for (;;) {
    const HalfEdge entry = paths_.opposite(exit);
    Index t = LinkedPaths::triangle_of(entry);
    exit = paths_.other_link(entry);
    if (exit == kNone) return t;
    const Index position = position_[t];
    const Index after = LinkedPaths::triangle_of(paths_.opposite(exit));
    const Index next = position_[after];
    Index last;  // of the stretch
    if (next == position + 1)
      last = breaks_.first_from(next);
    else if (next + 1 == position)
      last = breaks_.last_to(next - 1) + 1;
    else
      continue;
    if (last == next) continue;
    t = at_[last];
    exit = paths_.other_link(link_to(t, at_[next > position ? last - 1 : last + 1]));
    if (exit == kNone) return t;
  }
}

void PathIndex::flip(HalfEdge h) {
  const Index a = position_[LinkedPaths::triangle_of(h)];
  const Index b = position_[LinkedPaths::triangle_of(paths_.opposite(h))];
  paths_.flip(h);
  const bool is_linked = paths_.is_linked(h), is_along = a + 1 == b || b + 1 == a;
  if (is_along) breaks_.set(std::min(a, b), !is_linked);
  detours_ += is_linked == is_along ? -1 : 1;
  if (detours_ > max_detours_) number();
}

}  // namespace pstrips::inline codecs
