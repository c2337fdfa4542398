#pragma once

#include <cstddef>
#include <string_view>

namespace pstrips::inline validators {

/// Where the text stops being UTF-8 (RFC 3629: shortest form, no surrogates, at most U+10FFFF);
/// its size when it never does.
std::size_t first_not_utf8(std::string_view text);

}  // namespace pstrips::inline validators
