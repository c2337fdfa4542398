#include "formats/text/decimal.h"

#include <fast_float/fast_float.h>

namespace pstrips::inline formats {
namespace {

template <class T>
bool parse(std::string_view token, T& value) {
  const char* const end = token.data() + token.size();
  const auto [stop, error] = fast_float::from_chars(token.data(), end, value);
  return error == std::errc() && stop == end;
}

}  // namespace

bool parse_decimal(std::string_view token, float& value) { return parse(token, value); }
bool parse_decimal(std::string_view token, double& value) { return parse(token, value); }

}  // namespace pstrips::inline formats
