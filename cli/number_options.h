#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class Option;
}

namespace pstrips::cli {

/// "12", "64k", "1.5M", "2G" in powers of 1000, "64Ki", "2Gi" in powers of 1024; nothing for other
/// words and for what does not fit.
std::optional<std::uint64_t> parse_count(std::string_view word);
/// 8589934592 as "8Gi", 1000 as "1000": what parse_count() reads back.
std::string count_word(std::uint64_t count);

/// A number, plain or as a share of something.
struct Amount {
  double number = 0;
  bool is_share = false;  ///< "12.5%" is 0.125 of it
};
/// "12.5%" or, as a number, whatever strtod reads of plain decimals; nothing for other words, for
/// negative numbers and for infinities.
std::optional<Amount> parse_amount(std::string_view word);

// What an option accepts: anything else is refused with a sentence that names the bounds. The
// option shows `value` in its help.

void takes_count(CLI::Option* option, std::uint64_t least = 0,
                 std::uint64_t most = std::numeric_limits<std::uint64_t>::max());
void takes_count_or_share(CLI::Option* option);
void takes_number(CLI::Option* option);  ///< from 0 on
void takes_number_or_share(CLI::Option* option);
void takes_one_of(CLI::Option* option, const std::vector<std::string>& words);

}  // namespace pstrips::cli
