#pragma once

#include <cstddef>

namespace pstrips::cli {

/// The largest number of bytes that stood allocated by operator new since it was made, beyond
/// those that stood then; of the whole program, libraries included, all threads. One at a time.
class HeapPeak {
 public:
  HeapPeak();
  std::size_t bytes() const;

 private:
  std::size_t start_;
};

}  // namespace pstrips::cli
