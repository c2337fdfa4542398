#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/bytes.h"

namespace pstrips::inline core {

// Bytes as text. [RFC4648 §4]

/// Four digits for three bytes, "=" for those that are missing at the end.
std::string base64(ByteView bytes);

enum class Base64 : std::uint8_t {
  strict,   ///< each value in the one way that base64() writes it
  lenient,  ///< padding is optional, bits that it cuts off may be set
};

/// The bytes that the digits stand for, without any space between them; nothing when they stand
/// for none.
std::optional<Bytes> parse_base64(std::string_view digits, Base64 form = Base64::strict);

}  // namespace pstrips::inline core
