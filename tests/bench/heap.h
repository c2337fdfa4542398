#pragma once

#include <cstddef>

namespace pstrips::bench {

// The heap of the whole program, libraries included, all threads: what operator new has handed out
// and what has not come back. Linking heap.cpp replaces the program's operator new.

/// From here on heap_peak() counts.
void start_heap_peak();

/// The largest number of bytes that stood allocated since start_heap_peak(), beyond those that
/// stood then.
std::size_t heap_peak();

}  // namespace pstrips::bench
