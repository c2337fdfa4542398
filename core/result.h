#pragma once

#include <cstdint>
#include <string>
#include <tl/expected.hpp>
#include <utility>

#include "core/fault.h"

namespace pstrips::inline core {

/// The kinds of errors. Of untrusted bytes, `truncated` means that more bytes may mend the input,
/// `corrupt` that no bytes will, `over_limit` that the input may be valid and is refused.
enum class ErrorCode : std::uint8_t {
  bad_argument,  ///< an option or argument from outside that cannot be used
  io,            ///< the operating system refused to read or write
  truncated,     ///< the input ends before what it announces
  corrupt,       ///< the input contradicts its format
  over_limit,    ///< the input needs more than `Limits` grants
  unsupported,   ///< well-formed, but needs something this build does not know
  interrupted,   ///< the user stopped the work
};

inline constexpr std::uint64_t kNoOffset = ~std::uint64_t{0};

/// Why something from outside was refused, and where.
struct Error {
  ErrorCode code = ErrorCode::corrupt;
  std::string message;               ///< a fixed phrase in lower case, no trailing full stop
  std::uint64_t offset = kNoOffset;  ///< byte offset into the input, where one is known
  std::string path = {};             ///< line ("line 12"), element path, JSON pointer or file name
  Fault fault = Fault::none;         ///< the demand that is broken, where the reader knows it
  friend bool operator==(const Error&, const Error&) = default;
};

template <class T>
using Result = tl::expected<T, Error>;

/// `return fail(ErrorCode::corrupt, "…", offset);` from any function that returns a Result.
inline tl::unexpected<Error> fail(ErrorCode code, std::string message,
                                  std::uint64_t offset = kNoOffset, std::string path = {}) {
  return tl::unexpected<Error>(Error{code, std::move(message), offset, std::move(path)});
}

}  // namespace pstrips::inline core
