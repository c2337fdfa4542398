#pragma once

#include <cassert>
#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "core/mesh.h"

namespace pstrips::inline core {

/// Elements listed by key, those of a key in the order in which they came.
template <class T>
struct Grouped {
  std::vector<Index> first{0};  ///< into `elements`: one a key, and one past the end
  std::vector<T> elements;

  std::size_t keys() const { return first.size() - 1; }
  std::span<const T> operator[](std::size_t key) const {
    return std::span(elements).subspan(first[key], first[key + 1] - first[key]);
  }
  std::span<T> operator[](std::size_t key) {
    return std::span(elements).subspan(first[key], first[key + 1] - first[key]);
  }
};

/// Lists elements by key, by counting them.
///
/// keys      their number
/// for_each  for_each(visit) calls visit(key, make) for each element, key < keys; it is called
///           twice and must come to the same keys. make() gives the element; it is called once
/// cost      O(keys + elements); no memory but the result's
template <class T, class ForEach>
Grouped<T> group_each(std::size_t keys, ForEach&& for_each) {
  Grouped<T> out;
  out.first.assign(keys + 2, 0);
  for_each([&](std::size_t key, auto&&) {
    assert(key < keys);
    ++out.first[key + 2];
  });
  for (std::size_t k = 2; k < out.first.size(); ++k) out.first[k] += out.first[k - 1];
  out.elements.resize(out.first.back());
  // While they fill, first[k + 1] is where the next of k goes; afterwards it is k's end.
  for_each([&](std::size_t key, auto&& make) { out.elements[out.first[key + 1]++] = make(); });
  out.first.pop_back();
  return out;
}

/// Lists the numbers below `count` by key_of(number).
template <class KeyOf>
Grouped<Index> group_by(std::size_t keys, std::size_t count, KeyOf&& key_of) {
  return group_each<Index>(keys, [&](auto&& visit) {
    for (std::size_t i = 0; i < count; ++i)
      visit(key_of(static_cast<Index>(i)), [&] { return static_cast<Index>(i); });
  });
}

}  // namespace pstrips::inline core
