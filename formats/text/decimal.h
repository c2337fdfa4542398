#pragma once

#include <string_view>

namespace pstrips::inline formats {

/// Reads all of `token` as a number of any length, correctly rounded: a minus sign, digits with or
/// without a point, an exponent; "inf", "infinity" and "nan" in any case. What is too large is
/// infinite, what is too small is 0. False when it is no number.
bool parse_decimal(std::string_view token, float& value);
bool parse_decimal(std::string_view token, double& value);

}  // namespace pstrips::inline formats
