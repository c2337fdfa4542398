#pragma once

namespace pstrips::inline core {

/// Reads a value only to have it in the cache.
///
/// For random access that is known some steps ahead: the loads of a batch wait for memory together,
/// those of the work itself one after the other. Unlike a prefetch instruction a load is not
/// dropped where the address translation is not cached, which decides for arrays of many megabytes.
template <class T>
inline void prefetch(const T& value) {
  asm volatile("" : : "r"(value));
}

}  // namespace pstrips::inline core
