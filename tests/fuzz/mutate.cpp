#include "tests/fuzz/mutate.h"

#include <algorithm>
#include <random>

namespace pstrips::fuzz {
namespace {

// Where counts and indices go wrong: ends of types, symbols of the index map, signs.
constexpr std::uint64_t kNumbers[] = {0,           1,           2,           3,
                                      0x7f,        0x80,        0xff,        0x7fff,
                                      0xffff,      0x7fff'ffff, 0x8000'0000, 0xffff'fffb,
                                      0xffff'ffff, 0x7f80'0000, 0x7fc0'0001, ~std::uint64_t{0}};
constexpr std::string_view kDigits[] = {
    "0",   "-1",     "1",   "4294967295", "4294967296",
    "nan", "1e400",  "-0",  "0.1",        "2147483648",
    "inf", "1e-320", "007", "1e39",       "18446744073709551616"};

class Mutation {
 public:
  Mutation(ByteView file, std::uint32_t seed) : bytes_(file.begin(), file.end()), random_(seed) {}

  void edit(std::span<const std::string_view> words, std::span<const Bytes> others) {
    switch (below(9)) {
      case 0:
        if (!bytes_.empty()) bytes_[below(bytes_.size())] ^= std::byte(1u << below(8));
        break;
      case 1:
        if (!bytes_.empty()) bytes_[below(bytes_.size())] = std::byte(below(256));
        break;
      case 2:
        erase(below(bytes_.size() + 1), 1 + below(8));
        break;
      case 3:
        if (below(8) == 0)
          bytes_.resize(below(bytes_.size() + 1));
        else
          erase(below(bytes_.size() + 1), 1 + below(64));
        break;
      case 4:
        insert(piece_of(bytes_));
        break;
      case 5:
        if (!others.empty()) insert(piece_of(others[below(others.size())]));
        break;
      case 6:
        if (!others.empty()) overwrite(piece_of(others[below(others.size())]));
        break;
      case 7:
        if (words.empty())
          number();
        else
          insert(as_bytes(words[below(words.size())]));
        break;
      case 8:
        if (words.empty())
          number();
        else
          word(below(2) == 0 ? words[below(words.size())] : kDigits[below(std::size(kDigits))]);
        break;
    }
  }
  std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }
  Bytes take() && { return std::move(bytes_); }

 private:
  using Offset = Bytes::difference_type;

  void erase(std::size_t at, std::size_t count) {
    count = std::min(count, bytes_.size() - at);
    bytes_.erase(bytes_.begin() + Offset(at), bytes_.begin() + Offset(at + count));
  }
  void insert(ByteView piece) {
    const Bytes copy(piece.begin(), piece.end());  // it may be a part of bytes_
    bytes_.insert(bytes_.begin() + Offset(below(bytes_.size() + 1)), copy.begin(), copy.end());
  }
  void overwrite(ByteView piece) {
    const std::size_t at = below(bytes_.size() + 1);
    std::ranges::copy(piece.first(std::min(piece.size(), bytes_.size() - at)),
                      bytes_.begin() + Offset(at));
  }
  ByteView piece_of(ByteView file) {
    const std::size_t at = below(file.size() + 1);
    return file.subspan(at, std::min(1 + below(64), file.size() - at));
  }
  // Of 1, 2, 4 or 8 bytes, mostly aligned.
  void number() {
    const std::size_t size = std::size_t{1} << below(4);
    const std::uint64_t value = kNumbers[below(std::size(kNumbers))];
    std::size_t at = below(bytes_.size());
    if (below(4) != 0) at -= at % size;
    for (std::size_t i = 0; i < size && at + i < bytes_.size(); ++i)
      bytes_[at + i] = std::byte(value >> (8 * i));
  }
  // In place of the token at a random position.
  void word(std::string_view text) {
    constexpr std::string_view kEnds = " \t\r\n\"<>/,:[]{}=";
    const auto is_end = [&](std::byte b) {
      return kEnds.find(static_cast<char>(b)) != std::string_view::npos;
    };
    std::size_t first = below(bytes_.size()), last = first;
    while (first > 0 && !is_end(bytes_[first - 1])) --first;
    while (last < bytes_.size() && !is_end(bytes_[last])) ++last;
    erase(first, last - first);
    const ByteView piece = as_bytes(text);
    bytes_.insert(bytes_.begin() + Offset(first), piece.begin(), piece.end());
  }

  Bytes bytes_;
  std::mt19937 random_;
};

}  // namespace

Bytes mutate(ByteView file, std::uint32_t seed, std::span<const std::string_view> words,
             std::span<const Bytes> others) {
  Mutation mutation(file, seed);
  for (std::size_t edits = 1 + mutation.below(4); edits > 0; --edits) mutation.edit(words, others);
  return std::move(mutation).take();
}

}  // namespace pstrips::fuzz
