#include "cli/number_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "cli/table.h"

namespace pstrips::cli {
namespace {

struct Suffix {
  std::string_view word;
  double factor;
};
constexpr std::array<Suffix, 6> kSuffixes = {{{"Ki", 1024.0},
                                              {"Mi", 1024.0 * 1024},
                                              {"Gi", 1024.0 * 1024 * 1024},
                                              {"k", 1e3},
                                              {"M", 1e6},
                                              {"G", 1e9}}};

constexpr double kPastCounts = 18446744073709551616.0;  // 2^64

std::optional<double> parse_number(std::string_view word) {
  double number = 0;
  const auto [rest, code] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (code != std::errc{} || rest != word.data() + word.size()) return {};
  if (!std::isfinite(number) || number < 0) return {};
  return number;
}

std::string describe_bounds(std::uint64_t least, std::uint64_t most) {
  const std::string from = fmt::format("a whole number from {}", grouped(least));
  return most == std::numeric_limits<std::uint64_t>::max()
             ? from + ", perhaps with k, M, G, Ki, Mi or Gi"
             : fmt::format("{} to {}", from, grouped(most));
}

// Checks a word and puts another in its place. CLI11 prints the name of the option before.
template <class Check>
void add_check(CLI::Option* option, const char* value, Check check) {
  option->type_name(value);
  option->transform(CLI::Validator([check](std::string& word) { return check(word); }, ""));
}

}  // namespace

std::optional<std::uint64_t> parse_count(std::string_view word) {
  std::uint64_t whole = 0;
  const char* end = word.data() + word.size();
  if (const auto [rest, code] = std::from_chars(word.data(), end, whole);
      code == std::errc{} && rest == end)
    return whole;
  double factor = 1;
  for (const Suffix& suffix : kSuffixes)
    if (word.ends_with(suffix.word)) {
      factor = suffix.factor;
      word.remove_suffix(suffix.word.size());
      break;
    }
  const auto number = parse_number(word);
  if (!number) return {};
  const double count = *number * factor;
  if (count >= kPastCounts || count != std::floor(count)) return {};
  return static_cast<std::uint64_t>(count);
}

std::string count_word(std::uint64_t count) {
  for (const auto& [word, shift] : {std::pair{"Gi", 30}, std::pair{"Mi", 20}, std::pair{"Ki", 10}})
    if (count >> shift != 0 && (count >> shift) << shift == count)
      return std::to_string(count >> shift) + word;
  return std::to_string(count);
}

std::optional<Amount> parse_amount(std::string_view word) {
  const bool is_share = word.ends_with('%');
  if (is_share) word.remove_suffix(1);
  const auto number = parse_number(word);
  if (!number) return {};
  return Amount{is_share ? *number / 100 : *number, is_share};
}

void takes_count(CLI::Option* option, std::uint64_t least, std::uint64_t most) {
  add_check(option, "N", [least, most](std::string& word) -> std::string {
    const auto count = parse_count(word);
    if (!count || *count < least || *count > most)
      return fmt::format("{} is not {}", word, describe_bounds(least, most));
    word = std::to_string(*count);
    return {};
  });
}

void takes_count_or_share(CLI::Option* option) {
  add_check(option, "N|N%", [](std::string& word) -> std::string {
    if (const auto count = parse_count(word)) {
      word = std::to_string(*count);
      return {};
    }
    const auto amount = parse_amount(word);
    if (amount && amount->is_share && amount->number <= 1) return {};
    return word + " is neither a whole number nor a percentage up to 100%";
  });
}

void takes_number(CLI::Option* option) {
  add_check(option, "X", [](std::string& word) -> std::string {
    return parse_number(word) ? "" : word + " is not a number from 0 on";
  });
}

void takes_number_or_share(CLI::Option* option) {
  add_check(option, "X|X%", [](std::string& word) -> std::string {
    return parse_amount(word) ? "" : word + " is neither a number from 0 on nor a percentage";
  });
}

void takes_one_of(CLI::Option* option, const std::vector<std::string>& words) {
  const std::string list = fmt::format("{}", fmt::join(words, ", "));
  add_check(option, "", [words, list](std::string& word) -> std::string {
    return std::ranges::find(words, word) != words.end()
               ? ""
               : fmt::format("{} is none of {}", word, list);
  });
  option->type_name(fmt::format("{}", fmt::join(words, "|")));
}

}  // namespace pstrips::cli
