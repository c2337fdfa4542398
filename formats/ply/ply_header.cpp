#include "formats/ply/ply_header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

namespace pstrips::inline formats::ply {
namespace {

struct TypeWord {
  std::string_view word;
  ComponentType type;
};

// Both vocabularies in use; the first word for a type is the one we write. [Turk94, PLY 1.0]
constexpr TypeWord kTypeWords[] = {
    {"char", ComponentType::i8},     {"uchar", ComponentType::u8},
    {"short", ComponentType::i16},   {"ushort", ComponentType::u16},
    {"int", ComponentType::i32},     {"uint", ComponentType::u32},
    {"float", ComponentType::f32},   {"double", ComponentType::f64},
    {"int8", ComponentType::i8},     {"uint8", ComponentType::u8},
    {"int16", ComponentType::i16},   {"uint16", ComponentType::u16},
    {"int32", ComponentType::i32},   {"uint32", ComponentType::u32},
    {"float32", ComponentType::f32}, {"float64", ComponentType::f64},
};

constexpr std::string_view kBlanks = " \t\v\f\r";

std::optional<ComponentType> type_of(std::string_view word) {
  const auto* found = std::ranges::find(kTypeWords, word, &TypeWord::word);
  if (found == std::end(kTypeWords)) return std::nullopt;
  return found->type;
}

/// The first words of a line; `count` is 7 when there are more than six, which no line needs.
struct Words {
  std::array<std::string_view, 7> word;
  std::size_t count = 0;
};

Words split(std::string_view line) {
  Words out;
  while (out.count < out.word.size()) {
    const std::size_t start = line.find_first_not_of(kBlanks);
    if (start == std::string_view::npos) break;
    line.remove_prefix(start);
    const std::size_t size = std::min(line.find_first_of(kBlanks), line.size());
    out.word[out.count++] = line.substr(0, size);
    line.remove_prefix(size);
  }
  return out;
}

class HeaderParser {
 public:
  HeaderParser(ByteView file, const Limits& limits)
      : file_(file), text_(as_text(file)), limits_(limits) {}

  Result<Header> run() {
    if (!signature()) return error();
    while (!ended_) {
      if (!next_line()) return error();
      if (!read_line()) return error();
    }
    header_.last_remarks = std::move(remarks_);
    header_.body = next_;
    return std::move(header_);
  }

 private:
  tl::unexpected<Error> error() { return tl::unexpected<Error>(std::move(error_)); }
  bool refuse(ErrorCode code, std::string_view message, std::size_t offset) {
    error_ = {code, std::string(message), offset, line_of(file_, offset)};
    return false;
  }
  bool corrupt(std::string_view message) {
    return refuse(ErrorCode::corrupt, message, line_start_);
  }

  bool signature() {
    constexpr std::string_view kMagic = "ply";
    const std::string_view start = text_.substr(0, kMagic.size());
    if (!kMagic.starts_with(start)) return corrupt("does not start with \"ply\"");
    const std::size_t end = text_.find_first_of("\r\n");
    const std::size_t past_magic = text_.find_first_not_of(" \t\v\f", kMagic.size());
    if (past_magic != std::string_view::npos && past_magic != end)
      return corrupt("does not start with \"ply\"");
    if (end == std::string_view::npos || end + 1 == text_.size())
      return refuse(ErrorCode::truncated, "ends inside the header", text_.size());
    cr_only_ = text_[end] == '\r' && text_[end + 1] != '\n';
    next_ = end + (text_[end] == '\r' && !cr_only_ ? 2 : 1);
    return true;
  }

  bool next_line() {
    line_start_ = next_;
    const std::string_view rest = text_.substr(next_);
    const std::size_t size = cr_only_ ? rest.find_first_of("\r\n") : rest.find('\n');
    line_ = rest.substr(0, std::min(size, rest.size()));
    if (line_.size() > limits_.string_bytes)
      return refuse(ErrorCode::over_limit, "header line longer than the limit", line_start_);
    if (size == std::string_view::npos) {
      // Only the last line may do without its end.
      const Words words = split(line_);
      if (words.count != 1 || words.word[0] != "end_header")
        return refuse(ErrorCode::truncated, "ends inside the header", text_.size());
      next_ = text_.size();
    } else {
      next_ += size + 1;
    }
    while (line_.ends_with('\r')) line_.remove_suffix(1);
    line_.remove_prefix(std::min(line_.find_first_not_of(kBlanks), line_.size()));
    return true;
  }

  bool read_line() {
    const Words words = split(line_);
    if (words.count == 0) return true;
    const std::string_view keyword = words.word[0];
    if (keyword == "comment" || keyword == "obj_info") {
      remarks_.emplace_back(line_);
      return true;
    }
    if (keyword == "format") return read_format(words);
    if (keyword == "element") return read_element(words);
    if (keyword == "property") return read_property(words);
    if (keyword == "end_header") return read_end(words);
    if (!header_.elements.empty()) return corrupt("unknown keyword");
    remarks_.emplace_back(line_);
    return true;
  }

  bool read_format(const Words& words) {
    constexpr std::string_view kNames[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    if (has_format_) return corrupt("second format line");
    if (words.count != 3) return corrupt("format line does not have three words");
    const auto* name = std::ranges::find(kNames, words.word[1]);
    if (name == std::end(kNames)) return corrupt("unknown format");
    if (words.word[2] != "1.0")
      return refuse(ErrorCode::unsupported, "version is not 1.0", line_start_);
    header_.encoding = static_cast<Encoding>(name - std::begin(kNames));
    has_format_ = true;
    return true;
  }

  bool read_element(const Words& words) {
    if (!has_format_) return corrupt("element before the format line");
    if (words.count != 3) return corrupt("element line does not have three words");
    Element element;
    element.name = words.word[1];
    const std::string_view digits = words.word[2];
    const auto [end, failed] =
        std::from_chars(digits.data(), digits.data() + digits.size(), element.count);
    if (failed != std::errc{} || end != digits.data() + digits.size())
      return corrupt("element count is not a number");
    const bool ours =
        element.name == "vertex" || element.name == "face" || element.name == "tristrips";
    if (ours && header_.find(element.name) != nullptr) return corrupt("element defined twice");
    element.remarks = std::exchange(remarks_, {});
    header_.elements.push_back(std::move(element));
    return true;
  }

  bool read_property(const Words& words) {
    if (header_.elements.empty()) return corrupt("property before the first element");
    const bool list = words.count > 1 && words.word[1] == "list";
    if (words.count != (list ? 5u : 3u))
      return corrupt("property line has the wrong number of words");
    Property property;
    property.name = words.word[words.count - 1];
    property.word = words.word[words.count - 2];
    const auto type = type_of(property.word);
    if (!type) return corrupt("unknown type");
    property.type = *type;
    if (list) {
      property.count_word = words.word[2];
      const auto count_type = type_of(property.count_word);
      if (!count_type) return corrupt("unknown type");
      if (!is_integer(*count_type)) return corrupt("list count is not of an integer type");
      property.count_type = *count_type;
    }
    property.remarks = std::exchange(remarks_, {});
    header_.elements.back().properties.push_back(std::move(property));
    return true;
  }

  bool read_end(const Words& words) {
    if (words.count != 1) return corrupt("end_header is not alone on its line");
    if (!has_format_) return corrupt("no format line");
    ended_ = true;
    return true;
  }

  ByteView file_;
  std::string_view text_;
  const Limits& limits_;
  Header header_;
  std::vector<std::string> remarks_;  // since the last element or property
  std::string_view line_;
  std::size_t line_start_ = 0, next_ = 0;
  bool cr_only_ = false, has_format_ = false, ended_ = false;
  Error error_;
};

}  // namespace

Property* Element::find(std::string_view property) {
  const auto found = std::ranges::find(properties, property, &Property::name);
  return found == properties.end() ? nullptr : &*found;
}

Element* Header::find(std::string_view element) {
  const auto found = std::ranges::find(elements, element, &Element::name);
  return found == elements.end() ? nullptr : &*found;
}

Result<Header> parse_header(ByteView file, const Limits& limits) {
  return HeaderParser(file, limits).run();
}

std::string format_header(const Header& header) {
  constexpr std::string_view kNames[] = {"ascii", "binary_little_endian", "binary_big_endian"};
  std::string out = "ply\nformat ";
  out += kNames[static_cast<std::size_t>(header.encoding)];
  out += " 1.0\n";
  const auto add_remarks = [&](const std::vector<std::string>& remarks) {
    for (const std::string& remark : remarks) (out += remark) += '\n';
  };
  for (const Element& element : header.elements) {
    add_remarks(element.remarks);
    out += "element " + element.name + ' ' + std::to_string(element.count) + '\n';
    for (const Property& property : element.properties) {
      add_remarks(property.remarks);
      out += "property ";
      if (property.is_list()) out += "list " + property.count_word + ' ';
      out += property.word + ' ' + property.name + '\n';
    }
  }
  add_remarks(header.last_remarks);
  return out += "end_header\n";
}

std::string_view word_of(ComponentType type) {
  return std::ranges::find(kTypeWords, type, &TypeWord::type)->word;
}

Property scalar_property(std::string name, ComponentType type) {
  Property out;
  out.name = std::move(name);
  out.word = word_of(type);
  out.type = type;
  return out;
}

Property list_property(std::string name, ComponentType count_type, ComponentType type) {
  Property out = scalar_property(std::move(name), type);
  out.count_word = word_of(count_type);
  out.count_type = count_type;
  return out;
}

std::string line_of(ByteView file, std::uint64_t offset) {
  const std::string_view text = as_text(file);
  std::size_t line = 1;
  for (std::size_t i = 0; i < std::min<std::uint64_t>(offset, text.size()); ++i)
    line += text[i] == '\n' || (text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n'));
  return "line " + std::to_string(line);
}

}  // namespace pstrips::inline formats::ply
