#include "formats/obj/mtl_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/text.h"
#include "formats/obj/names.h"
#include "formats/obj/numbers.h"

namespace pstrips::inline formats::obj {
namespace {

/// An option of a texture map: its values, which are numbers or words.
struct Option {
  std::string_view word;
  std::size_t most = 1;
  bool numeric = false;
};
constexpr Option kOptions[] = {
    {"-blendu"},      {"-blendv"},         {"-cc"},         {"-clamp"},     {"-mm", 2, true},
    {"-o", 3, true},  {"-s", 3, true},     {"-t", 3, true}, {"-texres"},    {"-imfchan"},
    {"-bm", 1, true}, {"-boost", 1, true}, {"-type"},       {"-colorspace"}};

struct Values {
  std::array<double, 3> number{};
  std::size_t count = 0;
  std::string_view word;
};

/// Takes an option's values off `text`; numbers stop where there is none, so that a file of any
/// name may follow.
Values take_values(const Option& option, std::string_view& text) {
  Values out;
  std::string_view rest = text;
  for (std::size_t i = 0; i < option.most; ++i) {
    const std::string_view word = next_word(rest);
    Number number;
    if (option.numeric) {
      if (word.empty() || !parse_number(word.data(), word.data() + word.size(), number)) break;
      out.number[out.count++] = std::isfinite(number.value) ? number.value : 0;
    }
    out.word = word;
    text = rest;
  }
  return out;
}

void apply(const Option& option, const Values& values, MapStatement& out) {
  const std::size_t pair = std::min<std::size_t>(values.count, 2);
  if (option.word == "-o") std::copy_n(values.number.begin(), pair, out.map.offset.begin());
  if (option.word == "-s") std::copy_n(values.number.begin(), pair, out.map.scale.begin());
  if (option.word == "-bm" && values.count > 0) out.map.strength = values.number[0];
  if (option.word == "-imfchan" && values.word.size() == 1) out.channel = values.word.front();
}

void append_numbers(std::string& out, std::string_view option, std::span<const double> values) {
  (out += ' ') += option;
  for (const double value : values) append_number(out += ' ', value);
}

}  // namespace

MapStatement parse_map(std::string_view text) {
  MapStatement out;
  for (;;) {
    text = trimmed(text);
    std::string_view rest = text;
    const std::string word = lower_case(next_word(rest));
    const auto* const option = std::ranges::find(kOptions, word, &Option::word);
    if (option == std::end(kOptions)) break;
    const Values values = take_values(*option, rest);
    apply(*option, values, out);
    text = rest;
  }
  out.file = clean_name(text);
  std::ranges::replace(out.file, '\\', '/');
  return out;
}

std::string map_line(std::string_view word, const MapStatement& statement) {
  const TextureMap& map = statement.map;
  std::string out(word);
  if (map.offset != TextureMap{}.offset) append_numbers(out, "-o", map.offset);
  if (map.scale != TextureMap{}.scale) append_numbers(out, "-s", map.scale);
  if (map.strength != 1) append_numbers(out, "-bm", std::span(&map.strength, 1));
  if (statement.channel != '\0') (out += " -imfchan ") += statement.channel;
  // A file must not look like an option.
  out += statement.file.starts_with('-') ? " ./" : " ";
  return out + statement.file + '\n';
}

}  // namespace pstrips::inline formats::obj
