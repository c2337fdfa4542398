#pragma once

#include <cstdio>
#include <cstdlib>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "core/bytes.h"
#include "core/limits.h"

/// Aborts when a law does not hold, so that libFuzzer and replay keep the input.
#define FUZZ_CHECK(condition) \
  ((condition) ? void() : pstrips::fuzz::broken_law(__FILE__, __LINE__, #condition))

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace pstrips::fuzz {

[[noreturn]] inline void broken_law(const char* file, int line, const char* law) {
  std::fprintf(stderr, "%s:%d: does not hold: %s\n", file, line, law);
  std::abort();
}

/// What mutation and replay know of a reader; each target defines it.
struct Target {
  std::vector<std::string_view> extensions;  ///< what to look for in folders, with the dot
  std::vector<std::string_view> words;       ///< to be inserted; empty for binary formats
  std::vector<Bytes> seeds;                  ///< generated files, valid
};
Target target();

/// Tight enough that no input takes long, wide enough for every seed.
inline constexpr Limits kLimits{.vertices = 1u << 20,
                                .wedges = 1u << 20,
                                .corners = 1u << 22,
                                .meshes = 1u << 12,
                                .string_bytes = 1u << 20,
                                .memory_bytes = 1u << 26};

inline ByteView as_file(const std::uint8_t* data, std::size_t size) {
  return std::as_bytes(std::span(data, size));
}
inline Bytes copy(ByteView bytes) { return {bytes.begin(), bytes.end()}; }
inline Bytes copy(std::string_view text) { return copy(as_bytes(text)); }

/// A text file and, after its first zero byte, the companion it may ask for, so that one input has
/// both.
inline std::pair<ByteView, ByteView> split_companion(ByteView input) {
  std::size_t end = 0;
  while (end < input.size() && input[end] != std::byte{0}) ++end;
  if (end == input.size()) return {input, {}};
  return {input.first(end), input.subspan(end + 1)};
}
inline Bytes join_companion(ByteView file, ByteView companion) {
  Bytes out = copy(file);
  out.push_back(std::byte{0});
  out.insert(out.end(), companion.begin(), companion.end());
  return out;
}

}  // namespace pstrips::fuzz
