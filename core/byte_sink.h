#pragma once

#include "core/bytes.h"
#include "core/result.h"

namespace pstrips::inline core {

/// Takes the bytes of a file front to back, so that no writer needs all of them in memory.
class ByteSink {
 public:
  /// errors  of whatever the bytes go to; then no more may follow
  virtual Result<void> write(ByteView bytes) = 0;

 protected:
  ~ByteSink() = default;
};

/// Keeps them.
class BytesSink final : public ByteSink {
 public:
  void reserve(std::uint64_t bytes) { bytes_.reserve(static_cast<std::size_t>(bytes)); }
  Result<void> write(ByteView bytes) override {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    return {};
  }
  Bytes take() && { return std::move(bytes_); }

 private:
  Bytes bytes_;
};

}  // namespace pstrips::inline core
