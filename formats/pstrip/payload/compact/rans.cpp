#include "formats/pstrip/payload/compact/rans.h"

#include <algorithm>

namespace pstrips::inline formats {
namespace {

/// Between steps a coder's state is at least this and below 2^32.
constexpr std::uint32_t kLeastState = 1u << 16;

}  // namespace

Bytes RansWriter::finish() {
  // rANS gives symbols back in reverse: the last one is coded first, and bytes are turned round.
  std::vector<std::uint16_t> words;
  std::uint32_t state = kLeastState;
  for (auto step = steps_.rbegin(); step != steps_.rend(); ++step) {
    const std::uint32_t shares = step->shares;
    if (state >> (32 - kShareBits) >= shares) {
      words.push_back(static_cast<std::uint16_t>(state));
      state >>= 16;
    }
    state = (state / shares << kShareBits) + state % shares + step->start;
  }
  words.push_back(static_cast<std::uint16_t>(state));
  words.push_back(static_cast<std::uint16_t>(state >> 16));
  steps_.clear();
  Bytes out;
  out.reserve(words.size() * 2);
  for (auto word = words.rbegin(); word != words.rend(); ++word) {
    out.push_back(static_cast<std::byte>(*word & 0xff));
    out.push_back(static_cast<std::byte>(*word >> 8));
  }
  return out;
}

RansState::RansState(ByteView bytes) : bytes_(bytes) {
  state_ = word() << 16;
  state_ |= word();
}

bool RansState::complete() const {
  return !overrun_ && at_ == bytes_.size() && state_ == kLeastState;
}

std::uint32_t RansState::word() {
  if (bytes_.size() - at_ < 2) {
    overrun_ = true;
    at_ = bytes_.size();
    return 0;
  }
  const auto low = std::to_integer<std::uint32_t>(bytes_[at_]);
  const auto high = std::to_integer<std::uint32_t>(bytes_[at_ + 1]);
  at_ += 2;
  return low | high << 8;
}

}  // namespace pstrips::inline formats
