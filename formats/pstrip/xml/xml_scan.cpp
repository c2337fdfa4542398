#include "formats/pstrip/xml/xml_scan.h"

#include <algorithm>
#include <charconv>
#include <vector>

#include "core/fault_list.h"
#include "core/text.h"
#include "formats/pstrip/xml/xml_text.h"

namespace pstrips::inline formats {
namespace {

bool is_name_start(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == ':' || (c & 0x80);
}
bool is_name(char c) { return is_name_start(c) || (c >= '0' && c <= '9') || c == '-' || c == '.'; }

/// A position that only moves forward; the first failure sticks and ends the document.
class Scanner {
 public:
  Scanner(std::string_view text, const Limits& limits) : text_(text), limits_(limits) {}

  Result<XmlExtent> scan() {
    at_ = text_.size() - without_utf8_mark(text_).size();
    constexpr std::string_view kDeclaration = "<?xml";
    if (rest().starts_with(kDeclaration))
      declaration();
    else if (kDeclaration.starts_with(rest()))
      ends_early();
    while (!error_ && (open_.empty() ? outside_root() : content())) {
    }
    if (error_) return tl::unexpected<Error>(*error_);
    return extent_;
  }

 private:
  std::string_view rest() const { return text_.substr(at_); }
  bool at_end() const { return at_ == text_.size(); }

  bool fail(Fault fault, const char* message) {
    if (error_) return false;
    const auto line = 1 + std::ranges::count(text_.substr(0, at_), '\n');
    error_ = Error{code_of(fault), message, at_, "line " + std::to_string(line), fault};
    return false;
  }
  bool ends_early() { return fail(Fault::truncated, "ends inside the document"); }

  void skip_space() {
    while (!at_end() && is_xml_space(text_[at_])) ++at_;
  }

  /// Passes `word`; an early end inside it is truncated, anything else corrupt.
  bool expect(std::string_view word, const char* message) {
    if (rest().starts_with(word)) {
      at_ += word.size();
      return true;
    }
    return word.starts_with(rest()) ? ends_early() : fail(Fault::xml_malformed, message);
  }

  /// Passes characters up to and with `end`.
  bool pass_until(std::string_view end) {
    while (!rest().starts_with(end))
      if (!pass_character()) return false;
    at_ += end.size();
    return true;
  }

  bool pass_character() {
    if (at_end()) return ends_early();
    const std::size_t n = character_bytes(rest().substr(0, 4));
    if (n == 0)
      return is_cut_character(rest().substr(0, 4))
                 ? ends_early()
                 : fail(Fault::xml_malformed, "byte that is no XML character in UTF-8");
    at_ += n;
    return true;
  }

  bool name(std::string_view& out) {
    if (at_end()) return ends_early();
    if (!is_name_start(text_[at_])) return fail(Fault::xml_malformed, "name expected");
    const std::size_t start = at_;
    while (!at_end() && is_name(text_[at_]))
      if (!pass_character()) return false;
    out = text_.substr(start, at_ - start);
    return true;
  }

  /// A reference to a character or to one of the entities that XML itself defines.
  bool entity() {
    const std::size_t start = at_++;
    std::size_t end = 0;  // of the name, which #x10ffff makes eight characters at most
    while (end < rest().size() && end <= 8 && (is_name(rest()[end]) || rest()[end] == '#')) ++end;
    if (end == rest().size()) return at_ = text_.size(), ends_early();
    if (rest()[end] != ';') return fail(Fault::xml_malformed, "entity does not end");
    const std::string_view word = rest().substr(0, end);
    constexpr std::string_view kDefined[] = {"amp", "lt", "gt", "quot", "apos"};
    const bool known = std::ranges::find(kDefined, word) != std::end(kDefined);
    if (!known && !is_character_reference(word)) {
      at_ = start;
      return fail(Fault::xml_malformed, "entity is not one that XML defines");
    }
    at_ += end + 1;
    return true;
  }

  static bool is_character_reference(std::string_view word) {
    if (!word.starts_with('#')) return false;
    const bool hex = word.size() > 1 && word[1] == 'x';
    const std::string_view digits = word.substr(hex ? 2 : 1);
    unsigned code = 0;
    const char* end = digits.data() + digits.size();
    const auto [at, error] = std::from_chars(digits.data(), end, code, hex ? 16 : 10);
    if (digits.empty() || error != std::errc{} || at != end) return false;
    if (code < 0x20) return code == 9 || code == 10 || code == 13;
    return code < 0xd800 || (code >= 0xe000 && code <= 0x10ffff && (code & ~1u) != 0xfffe);
  }

  bool attribute_value(std::string_view& out) {
    if (at_end()) return ends_early();
    const char quote = text_[at_];
    if (quote != '"' && quote != '\'') return fail(Fault::xml_malformed, "quote expected");
    const std::size_t start = ++at_;
    while (!at_end() && text_[at_] != quote) {
      if (text_[at_] == '<') return fail(Fault::xml_malformed, "'<' inside an attribute");
      if (text_[at_] == '&' ? !entity() : !pass_character()) return false;
    }
    if (at_end()) return ends_early();
    out = text_.substr(start, at_++ - start);
    return true;
  }

  bool attribute(std::string_view& key, std::string_view& value) {
    if (!name(key)) return false;
    skip_space();
    if (!expect("=", "'=' expected")) return false;
    skip_space();
    return attribute_value(value);
  }

  bool declaration() {
    at_ += 5;
    for (;;) {
      skip_space();
      if (at_end()) return ends_early();
      if (text_[at_] == '?') return expect("?>", "end of the declaration expected");
      const std::size_t start = at_;
      std::string_view key, value;
      if (!attribute(key, value)) return false;
      const bool utf8 = value == "UTF-8" || value == "utf-8" || value == "US-ASCII";
      if (key == "encoding" ? utf8 : key != "version" || value == "1.0") continue;
      at_ = start;
      return fail(Fault::xml_unsupported, "neither XML 1.0 nor in UTF-8");
    }
  }

  /// One step before or after the root. False at the end of the document.
  bool outside_root() {
    skip_space();
    if (at_end()) return root_seen_ ? false : ends_early();
    if (text_[at_] != '<') {
      if (character_bytes(rest().substr(0, 4)) == 0) return pass_character();
      return fail(Fault::xml_malformed, "text outside the root element");
    }
    return markup();
  }

  /// One run of text or one piece of markup inside an element.
  bool content() {
    if (at_end()) return ends_early();
    if (text_[at_] == '<') return markup();
    bool space = true;
    while (!at_end() && text_[at_] != '<') {
      space = space && is_xml_space(text_[at_]);
      if (text_[at_] == '&' ? !entity() : !pass_character()) return false;
    }
    if (!space) ++extent_.texts;
    return true;
  }

  bool markup() {
    if (rest().starts_with("<!--")) {
      at_ += 4;
      ++extent_.texts;
      return pass_until("-->");
    }
    constexpr std::string_view kCharacterData = "<![CDATA[";
    if (!open_.empty() && rest().starts_with(kCharacterData)) {
      at_ += kCharacterData.size();
      ++extent_.texts;
      return pass_until("]]>");
    }
    if (rest() == "<" || std::string_view("<!--").starts_with(rest()) ||
        kCharacterData.starts_with(rest()))
      return at_ = text_.size(), ends_early();
    if (text_[at_ + 1] == '!')
      return fail(Fault::xml_declaration, "document type declarations are not allowed");
    if (text_[at_ + 1] == '?')
      return fail(Fault::xml_declaration, "processing instructions are not allowed");
    return text_[at_ + 1] == '/' ? end_tag() : start_tag();
  }

  bool start_tag() {
    if (open_.empty() && root_seen_) return fail(Fault::xml_malformed, "second root element");
    if (open_.size() >= limits_.xml_depth)
      return fail(Fault::over_limit, "elements nest deeper than the limit");
    ++at_;
    root_seen_ = true;
    ++extent_.elements;
    std::string_view tag;
    if (!name(tag)) return false;
    open_.push_back(tag);
    for (;;) {
      const bool space = !at_end() && is_xml_space(text_[at_]);
      skip_space();
      if (at_end()) return ends_early();
      if (text_[at_] == '>') return ++at_, true;
      if (text_[at_] == '/') {
        open_.pop_back();
        return expect("/>", "'/>' expected");
      }
      if (!space) return fail(Fault::xml_malformed, "white space expected before an attribute");
      ++extent_.attributes;
      std::string_view key, value;
      if (!attribute(key, value)) return false;
    }
  }

  bool end_tag() {
    const std::size_t start = at_;
    at_ += 2;
    std::string_view tag;
    if (!name(tag)) return false;
    skip_space();
    if (at_end()) return ends_early();
    if (open_.empty() || tag != open_.back()) {
      at_ = start;
      return fail(Fault::xml_malformed, "end tag does not match the start tag");
    }
    open_.pop_back();
    return expect(">", "'>' expected");
  }

  std::string_view text_;
  const Limits& limits_;
  std::size_t at_ = 0;
  bool root_seen_ = false;
  std::vector<std::string_view> open_;  // tags
  XmlExtent extent_;
  std::optional<Error> error_;
};

}  // namespace

Result<XmlExtent> scan_xml(ByteView document, const Limits& limits) {
  return Scanner(as_text(document), limits).scan();
}

std::uint64_t offset_of_line(ByteView document, std::uint64_t line) {
  const std::string_view text = as_text(document);
  std::size_t at = 0;
  for (std::uint64_t i = 1; i < line && at < text.size(); ++i)
    at = std::min(text.find('\n', at), text.size() - 1) + 1;
  return at;
}

}  // namespace pstrips::inline formats
