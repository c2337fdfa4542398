#include "tests/bench/heap.h"

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

// Replaces the program's operator new, so that what a stripifier takes is counted exactly and
// equally for ours and for other libraries'. The resident set of a process, the other way to
// measure, is rounded to what the allocator holds back.
namespace {

std::atomic<std::size_t> allocated{0}, peak{0};

void* count(void* block) {
  if (!block) throw std::bad_alloc();
  const std::size_t size = ::malloc_usable_size(block);
  const std::size_t now = allocated.fetch_add(size, std::memory_order_relaxed) + size;
  std::size_t largest = peak.load(std::memory_order_relaxed);
  while (now > largest && !peak.compare_exchange_weak(largest, now, std::memory_order_relaxed)) {
  }
  return block;
}

void release(void* block) {
  allocated.fetch_sub(::malloc_usable_size(block), std::memory_order_relaxed);
  std::free(block);
}

}  // namespace

void* operator new(std::size_t size) { return count(std::malloc(std::max<std::size_t>(size, 1))); }
void* operator new[](std::size_t size) { return ::operator new(size); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto step = static_cast<std::size_t>(alignment);
  if (size > SIZE_MAX - step) throw std::bad_alloc();
  return count(std::aligned_alloc(step, (size + step - 1) / step * step));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return ::operator new(size, alignment);
}
// The standard library's own nothrow forms, which std::stable_sort calls, may count elsewhere than
// the operators above.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return ::operator new(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void* operator new[](std::size_t size, const std::nothrow_t& tag) noexcept {
  return ::operator new(size, tag);
}
void* operator new(std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  try {
    return ::operator new(size, alignment);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void* operator new[](std::size_t size, std::align_val_t alignment,
                     const std::nothrow_t& tag) noexcept {
  return ::operator new(size, alignment, tag);
}
void operator delete(void* block) noexcept { release(block); }
void operator delete[](void* block) noexcept { release(block); }
void operator delete(void* block, std::size_t) noexcept { release(block); }
void operator delete[](void* block, std::size_t) noexcept { release(block); }
void operator delete(void* block, std::align_val_t) noexcept { release(block); }
void operator delete[](void* block, std::align_val_t) noexcept { release(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { release(block); }
void operator delete[](void* block, std::size_t, std::align_val_t) noexcept { release(block); }
void operator delete(void* block, const std::nothrow_t&) noexcept { release(block); }
void operator delete[](void* block, const std::nothrow_t&) noexcept { release(block); }
void operator delete(void* block, std::align_val_t, const std::nothrow_t&) noexcept {
  release(block);
}
void operator delete[](void* block, std::align_val_t, const std::nothrow_t&) noexcept {
  release(block);
}

namespace pstrips::bench {
namespace {

std::size_t before = 0;

}  // namespace

void start_heap_peak() { peak = before = allocated.load(); }

std::size_t heap_peak() { return peak.load() - before; }

}  // namespace pstrips::bench
