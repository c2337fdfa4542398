#include "formats/pstrip/numbers.h"
#include "formats/pstrip/xml/xml.h"
#include "formats/pstrip/xml/xml_layout.h"

namespace pstrips::inline formats {
namespace {

/// The Io of the layout functions that writes: elements with their attributes, one a line,
/// indented by their depth. [formats/pstrip/xml/xml_layout.h]
class XmlWriteIo {
 public:
  static constexpr bool kReads = false;

  XmlWriteIo() { out_.text("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"); }
  Bytes take() && { return std::move(out_).take(); }

  template <class Fields>
  void write(const char* name, Fields&& fields) {
    indent();
    out_.character('<');
    out_.text(name);
    content_ = Content::none;
    fields(*this);
    end(name);
  }

  // Attributes.
  void version(const char* name, Index minor) {
    string(name, std::to_string(kXmlVersionMajor) + "." + std::to_string(minor));
  }
  void profile(const char* name, Profile v) { string(name, name_of(v)); }
  void constant(const char* name, std::string_view value, Fault) { string(name, value); }
  void string(const char* name, std::string_view v) {
    attribute(name, [&] { write_string(out_, v); });
  }
  void index(const char* name, Index v) {
    attribute(name, [&] { out_.integer(v); });
  }
  void index_or_none(const char* name, Index v) {
    if (v != kNone) index(name, v);
  }
  void component_count(const char* name, std::uint8_t v) { index(name, v); }
  template <class T>
  void real(const char* name, T v) {
    attribute(name, [&] { out_.real(v); });
  }
  void reals(const char* name, std::span<const double> values) {
    attribute(name, [&] { spaced(values, [&](double v) { out_.real(v); }); });
  }
  void integers(const char* name, std::span<const std::int64_t> values) {
    attribute(name, [&] { spaced(values, [&](std::int64_t v) { out_.integer(v); }); });
  }
  void flag(const char* name, bool v) { string(name, v ? "true" : "false"); }
  void flag_unless(const char* name, bool v, bool absent) {
    if (v != absent) flag(name, v);
  }
  template <class E>
  void word(const char* name, E v, std::span<const std::string_view> words, Fault) {
    string(name, words[static_cast<std::size_t>(v)]);
  }
  void letters(const char* name, std::span<const char> v, Fault) {
    string(name, {v.data(), v.size()});
  }
  void indices(const char* name, std::span<const Index> list) {
    attribute(name, [&] { spaced(list, [&](Index v) { out_.integer(v); }); });
  }
  void run(const char* name, std::span<const Index> list, std::size_t first, Index count) {
    indices(name, list.subspan(first, count));
  }
  void run_unless_empty(const char* name, std::span<const Index> list, std::size_t first,
                        Index count) {
    if (count > 0) run(name, list, first, count);
  }
  void run_to_bound(const char* name, std::span<const Index> list, std::span<const Index> bounds,
                    std::size_t i) {
    run(name, list, bounds[i], bounds[i + 1] - bounds[i]);
  }
  void element(const char* name, const Attribute& format, ByteView data, std::size_t i) {
    const std::size_t bytes = format.element_bytes();
    attribute(name, [&] { out_.element(format, data.subspan(i * bytes, bytes)); });
  }
  void values(const char* name, std::span<const Attribute> attributes, std::size_t i) {
    if (attributes.empty()) return;
    attribute(name, [&] {
      spaced(attributes, [&](const Attribute& a) { out_.element(a, a.element(i)); });
    });
  }

  // Content.
  void content(bool any = true) {
    if (!any) return;
    out_.text(">\n");
    content_ = Content::elements;
    ++depth_;
  }
  template <class Fields>
  void child(const char* name, const char*, Fields&& fields) {
    write(name, fields);
  }
  template <class Fields>
  void child_if(bool there, const char* name, const char*, Fields&& fields) {
    if (there) write(name, fields);
  }
  template <class T, class Fields>
  void children(const char* name, const char*, const std::vector<T>& list, Fields&& fields) {
    for (const T& item : list) write(name, [&](XmlWriteIo& io) { fields(io, item); });
  }
  template <class Fields>
  std::size_t each(const char* name, const char*, std::size_t count, Fields&& fields) {
    for (std::size_t i = 0; i < count; ++i) write(name, fields);
    return count;
  }
  template <class T, class... Parts>
  void parts(const char* attribute, const char*, const std::vector<T>& items,
             const Parts&... parts) {
    for (Index i = 0; i < items.size(); ++i) (write_part(attribute, i, items[i], parts), ...);
  }

  void elements(const char* name, const Attribute& a, std::size_t count) {
    text_element(name, [&] {
      for (std::size_t i = 0; i < count; ++i) {
        if (i > 0) out_.character('\n');
        out_.element(a, a.element(i));
      }
    });
  }
  template <class T>
  void numbers(const char* name, const char* part, const std::vector<T>& list) {
    numbers(name, part, list, list.size());
  }
  template <class T>
  void numbers(const char* name, const char*, const std::vector<T>& list, std::size_t count) {
    constexpr std::size_t kPerLine = 16;
    text_element(name, [&] {
      for (std::size_t i = 0; i < count; ++i) {
        if (i > 0) out_.character(i % kPerLine == 0 ? '\n' : ' ');
        out_.integer(std::uint32_t{list[i]});
      }
    });
  }
  /// One strip a line.
  void map_entries(const char* name, const char*, std::span<const Index> map,
                   MapEncoding encoding) {
    const bool whole = encoding == MapEncoding::triangles;
    text_element(name, [&] {
      for (std::size_t i = 0; i < map.size(); ++i) {
        const bool starts = whole ? i % 3 == 0 : i > 0 && map[i - 1] == kRestart;
        if (i > 0) out_.character(starts ? '\n' : ' ');
        if (is_wedge(map[i]))
          out_.integer(map[i]);
        else
          out_.text(name_of_marker(map[i]));
      }
    });
  }
  void hexadecimal(ByteView bytes, std::size_t) {
    begin_text();
    constexpr char kDigits[] = "0123456789abcdef";
    for (const std::byte b : bytes) {
      out_.character(kDigits[std::to_integer<unsigned>(b) >> 4]);
      out_.character(kDigits[std::to_integer<unsigned>(b) & 15]);
    }
  }
  void base64(ByteView bytes) {
    begin_text();
    write_base64_lines(out_, bytes);
  }
  void text(ByteView bytes) {
    begin_text();
    write_content(out_, bytes);
  }

  // What only a reader has to know.
  bool demand(bool, Fault, const char*, const char* = nullptr) { return true; }
  void announce(const XmlTotals&) {}
  void shape_is(Fault) {}
  void belongs_to(const char*, std::size_t) {}

 private:
  enum class Content : std::uint8_t { none, elements, text };

  void indent() {
    for (int i = 0; i < depth_; ++i) out_.character(' ');
  }
  /// Ends the element that was begun last; what encloses it holds elements.
  void end(const char* name) {
    if (content_ == Content::elements) {
      --depth_;
      indent();
    }
    if (content_ == Content::none) {
      out_.text("/>\n");
    } else {
      out_.text("</");
      out_.text(name);
      out_.text(">\n");
    }
    content_ = Content::elements;
  }
  void begin_text() {
    out_.character('>');
    content_ = Content::text;
  }
  template <class Value>
  void attribute(const char* name, Value&& value) {
    out_.character(' ');
    out_.text(name);
    out_.text("=\"");
    value();
    out_.character('"');
  }
  template <class List, class Item>
  void spaced(const List& list, Item&& item) {
    bool first = true;
    for (const auto& v : list) {
      if (!first) out_.character(' ');
      first = false;
      item(v);
    }
  }
  template <class Text>
  void text_element(const char* name, Text&& text) {
    write(name, [&](XmlWriteIo& io) {
      io.begin_text();
      text();
    });
  }
  template <class T, class Part>
  void write_part(const char* attribute, Index i, const T& item, const Part& part) {
    if (!part.has(item)) return;
    write(part.name, [&](XmlWriteIo& io) {
      io.index(attribute, i);
      part.fields(io, item);
    });
  }

  TextWriter out_;
  int depth_ = 0;
  Content content_ = Content::none;  // of the element that was begun last
};

}  // namespace

Bytes write_xml(const ProgressiveStrips& strips) {
  XmlWriteIo xml;
  xml.write(kRootName, [&](XmlWriteIo& io) { xml_layout::document_fields(io, strips); });
  return std::move(xml).take();
}

}  // namespace pstrips::inline formats
