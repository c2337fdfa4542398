#include "formats/pstrip/text/face_finder.h"

#include <algorithm>

namespace pstrips::inline formats {
namespace {

/// The finalizer of splitmix64: every bit of the input reaches every bit of the output. [Steele14]
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

}  // namespace

std::uint64_t fingerprint(ByteView bytes) {
  std::uint64_t key = mixed(bytes.size() + 1);
  for (std::size_t at = 0; at < bytes.size(); at += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, std::min<std::size_t>(8, bytes.size() - at));
    key = mixed(key ^ word);
  }
  return key;
}

FaceFinder::Triangle FaceFinder::smallest_rotation(const Triangle& t) {
  return std::min({t, Triangle{t[1], t[2], t[0]}, Triangle{t[2], t[0], t[1]}});
}

/// Where the triangle stands, or the free entry where it may be put.
std::size_t FaceFinder::slot_of(const Triangle& t) const {
  const std::uint64_t hash = mixed(mixed(mixed(key_ ^ t[0]) ^ t[1]) ^ t[2]);
  const std::size_t mask = table_.size() - 1;
  std::size_t removed = table_.size();
  for (std::size_t at = hash & mask;; at = (at + 1) & mask) {
    if (table_[at] == kNone) return removed < table_.size() ? removed : at;
    if (table_[at] == kRemoved)
      removed = removed < table_.size() ? removed : at;
    else if (vertices_[table_[at]] == t)
      return at;
  }
}

void FaceFinder::insert(Index face, const Triangle& vertices) {
  if (2 * used_ >= table_.size()) grow();
  if (face >= vertices_.size()) {
    vertices_.resize(face + std::size_t{1});
    below_.resize(face + std::size_t{1}, kNone);
  }
  const Triangle t = smallest_rotation(vertices);
  const std::size_t at = slot_of(t);
  if (table_[at] == kNone) ++used_;
  below_[face] = table_[at] < kRemoved ? table_[at] : kNone;
  vertices_[face] = t;
  table_[at] = face;
}

Index FaceFinder::take(const Triangle& vertices) {
  const std::size_t at = slot_of(smallest_rotation(vertices));
  const Index face = table_[at];
  if (face >= kRemoved) return kNone;
  table_[at] = below_[face] == kNone ? kRemoved : below_[face];
  return face;
}

/// Room for as many faces again, without the entries of those that were removed.
void FaceFinder::grow() {
  std::vector<Index> old;
  for (const Index face : table_)
    if (face < kRemoved) old.push_back(face);
  std::size_t size = 16;
  while (size < 4 * old.size()) size *= 2;
  table_.assign(size, kNone);
  for (const Index face : old) table_[slot_of(vertices_[face])] = face;
  used_ = old.size();
}

}  // namespace pstrips::inline formats
