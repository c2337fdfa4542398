#include <algorithm>
#include <array>

#include "core/text.h"
#include "formats/obj/names.h"
#include "formats/obj/obj.h"

namespace pstrips::inline formats {
namespace {

// Of all parts of the format, those included that read_obj passes over. [WavefrontB1]
constexpr auto kWords = std::to_array<std::string_view>(
    {"bevel",     "bmat",  "bsp",    "bzp",    "c_interp",   "call", "cdc",    "con",  "csh",
     "cstype",    "ctech", "curv",   "curv2",  "d_interp",   "deg",  "end",    "f",    "fo",
     "g",         "hole",  "l",      "lod",    "maplib",     "mg",   "mtllib", "o",    "p",
     "parm",      "res",   "s",      "scrv",   "shadow_obj", "sp",   "stech",  "step", "surf",
     "trace_obj", "trim",  "usemap", "usemtl", "v",          "vn",   "vp",     "vt"});
static_assert(std::ranges::is_sorted(kWords));

}  // namespace

bool obj::is_statement(std::string_view word) { return std::ranges::binary_search(kWords, word); }

bool looks_like_obj(ByteView file) {
  std::string_view text = without_utf8_mark(as_text(file));
  if (text.substr(0, 4096).find('\0') != text.npos) return false;
  const char line_end = text.find('\n') == text.npos ? '\r' : '\n';
  while (!text.empty()) {
    std::string_view line = text.substr(0, text.find(line_end));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    const std::string_view word = obj::next_word(line);
    if (!word.empty() && !word.starts_with('#')) return obj::is_statement(word);
  }
  return false;
}

}  // namespace pstrips::inline formats
