// What WebAssembly has instead of parts of the standard libraries that would be much of the
// download: they say why a program ends, and that needs printf().

#ifdef __wasm__

#include <__verbose_abort>
#include <cstdlib>
#include <new>

void std::__libcpp_verbose_abort(const char*, ...) { __builtin_trap(); }

extern "C" void __cxa_pure_virtual() { __builtin_trap(); }

void* operator new(std::size_t size) {
  void* const memory = std::malloc(size);
  if (memory == nullptr) __builtin_trap();
  return memory;
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return std::malloc(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

#endif
