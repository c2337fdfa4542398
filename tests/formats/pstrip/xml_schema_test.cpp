// The layout of the XML variant (formats/pstrip/xml/xml_layout.h), its schema and the tables of
// spec/xml.md name the same elements, attributes and words.

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include "formats/pstrip/xml/xml_layout.h"
#include "tests/support/paths.h"
#include "tests/support/progressive.h"

namespace pstrips {
namespace {

using tinyxml2::XMLElement;

using Lines = std::set<std::string>;

struct AttributeKind {
  std::string type;         ///< name of the schema's type, or its words with '|' between them
  std::string absent = {};  ///< what absence means, where that is a value
  bool optional = false;
};

enum class Occurs : std::uint8_t { once, at_most_once, any_number };

struct ElementKind {
  std::map<std::string, AttributeKind> attributes;
  std::vector<std::pair<std::string, Occurs>> children;  ///< in file order
  std::set<std::string> text;                            ///< types of its content
};

/// By "parent/name", the root by its name.
using Elements = std::map<std::string, ElementKind>;

/// "base: positions, wedge_vertex ?, values *, map"
std::string children_line(const std::string& element, const ElementKind& kind) {
  std::string line = element + ":";
  for (const auto& [name, occurs] : kind.children) {
    line += (line.back() == ':' ? " " : ", ") + name;
    if (occurs != Occurs::once) line += occurs == Occurs::any_number ? " *" : " ?";
  }
  return line;
}

/// "vsplit @values ?"; "mesh/position @normalized ? false"
std::string attribute_line(const std::string& element, const std::string& name,
                           const AttributeKind& kind) {
  std::string line = element + " @" + name;
  if (kind.optional) line += " ?";
  if (!kind.absent.empty()) line += " " + kind.absent;
  return line;
}

Lines lines_of(const Elements& elements, bool with_types) {
  Lines lines;
  for (const auto& [element, kind] : elements) {
    if (!kind.children.empty()) lines.insert(children_line(element, kind));
    for (const auto& [name, attribute] : kind.attributes)
      lines.insert(attribute_line(element, name, attribute) +
                   (with_types ? " is " + attribute.type : ""));
    if (with_types)
      for (const std::string& type : kind.text) lines.insert(element + " holds " + type);
  }
  return lines;
}

/// What only one of the two says.
Lines differences(const Lines& page, const Lines& layout) {
  Lines out;
  for (const std::string& line : page)
    if (!layout.contains(line)) out.insert("not in the layout: " + line);
  for (const std::string& line : layout)
    if (!page.contains(line)) out.insert("only in the layout: " + line);
  return out;
}

std::string joined(std::span<const std::string_view> words) {
  std::string out;
  for (const std::string_view word : words) out.append(out.empty() ? "" : "|").append(word);
  return out;
}

/// What visits of the elements of a few models say of the elements of all.
class Gathered {
 public:
  struct Visit {
    std::map<std::string, AttributeKind> attributes;
    std::vector<std::pair<std::string, Occurs>> children;
    std::string text;
  };

  void add(const std::string& element, const Visit& visit) {
    ElementKind& kind = elements_[element];
    const bool first = visits_[element]++ == 0;
    for (auto& [name, attribute] : kind.attributes)
      attribute.optional = attribute.optional || !visit.attributes.contains(name);
    for (const auto& [name, attribute] : visit.attributes)
      if (kind.attributes.emplace(name, attribute).second && !first)
        kind.attributes[name].optional = true;
    add_children(kind, visit, first);
    if (!visit.text.empty()) kind.text.insert(visit.text);
  }
  const Elements& elements() const { return elements_; }

 private:
  static void add_children(ElementKind& kind, const Visit& visit, bool first) {
    for (auto& [name, occurs] : kind.children)
      if (std::ranges::find(visit.children, name, &std::pair<std::string, Occurs>::first) ==
          visit.children.end())
        occurs = std::max(occurs, Occurs::at_most_once);
    auto after = kind.children.begin();
    for (const auto& [name, occurs] : visit.children) {
      const auto same =
          std::ranges::count(visit.children, name, &std::pair<std::string, Occurs>::first);
      const Occurs now = same > 1 ? Occurs::any_number : occurs;
      auto found = std::ranges::find(kind.children, name, &std::pair<std::string, Occurs>::first);
      if (found == kind.children.end())
        found =
            kind.children.insert(after, {name, first ? now : std::max(now, Occurs::at_most_once)});
      found->second = std::max(found->second, now);
      after = found + 1;
    }
  }

  Elements elements_;
  std::map<std::string, std::size_t> visits_;
};

/// The Io of the layout functions that gathers what they name.
class DescribeIo {
 public:
  static constexpr bool kReads = false;

  DescribeIo(Gathered& gathered, std::string name) : gathered_(gathered), name_(std::move(name)) {}

  template <class Fields>
  void visit(const std::string& path, const std::string& name, Fields&& fields) {
    DescribeIo io(gathered_, name);
    fields(io);
    gathered_.add(path, io.visit_);
  }

  void version(const char* name, Index) {
    note(name, {std::to_string(kXmlVersionMajor) + "\\.[0-9]+"});
  }
  void profile(const char* name, Profile) {
    std::string names;
    for (const ProfileName& p : kProfiles) names.append(names.empty() ? "" : "|").append(p.name);
    note(name, {names});
  }
  void constant(const char* name, std::string_view value, Fault) {
    note(name, {std::string(value)});
  }
  void string(const char* name, std::string_view) { note(name, {"string"}); }
  void index(const char* name, Index) { note(name, {"index"}); }
  void index_or_none(const char* name, Index) { note(name, {"index", "", true}); }
  void component_count(const char* name, std::uint8_t) { note(name, {"componentCount"}); }
  void real(const char* name, double) { note(name, {"number"}); }
  void reals(const char* name, std::span<const double> v) {
    note(name, {"numbers" + std::to_string(v.size())});
  }
  void integers(const char* name, std::span<const std::int64_t> v) {
    note(name, {"integers" + std::to_string(v.size())});
  }
  void flag(const char* name, bool) { note(name, {"xs:boolean"}); }
  void flag_unless(const char* name, bool, bool absent) {
    note(name, {"xs:boolean", absent ? "true" : "false", true});
  }
  template <class E>
  void word(const char* name, E, std::span<const std::string_view> words, Fault) {
    note(name, {joined(words)});
  }
  void letters(const char* name, std::span<const char>, Fault) { note(name, {"chunkType"}); }
  void indices(const char* name, std::span<const Index>) { note(name, {"indices"}); }
  void run(const char* name, std::span<const Index>, std::size_t, Index) {
    note(name, {"indices"});
  }
  void run_unless_empty(const char* name, std::span<const Index>, std::size_t, Index) {
    note(name, {"indices", "", true});
  }
  void run_to_bound(const char* name, std::span<const Index>, std::span<const Index>, std::size_t) {
    note(name, {"indices"});
  }
  void element(const char* name, const Attribute&, ByteView, std::size_t) {
    note(name, {"numbers"});
  }
  void values(const char* name, std::span<const Attribute> attributes, std::size_t) {
    if (!attributes.empty()) note(name, {"numbers"});
  }

  void content(bool = true) {}
  template <class Fields>
  void child(const char* name, const char*, Fields&& fields) {
    has(name, Occurs::once);
    visit(path(name), name, fields);
  }
  template <class Fields>
  void child_if(bool there, const char* name, const char*, Fields&& fields) {
    has(name, Occurs::at_most_once);
    if (there) visit(path(name), name, fields);
  }
  template <class T, class Fields>
  void children(const char* name, const char*, const std::vector<T>& list, Fields&& fields) {
    has(name, Occurs::any_number);
    for (const T& item : list) visit(path(name), name, [&](DescribeIo& io) { fields(io, item); });
  }
  template <class Fields>
  std::size_t each(const char* name, const char*, std::size_t count, Fields&& fields) {
    has(name, Occurs::any_number);
    for (std::size_t i = 0; i < count; ++i) visit(path(name), name, fields);
    return count;
  }
  template <class T, class... Parts>
  void parts(const char* attribute, const char*, const std::vector<T>& items,
             const Parts&... parts) {
    (part(attribute, items, parts), ...);
  }
  void elements(const char* name, const Attribute&, std::size_t) { list(name, "numbers"); }
  template <class T>
  void numbers(const char* name, const char*, const std::vector<T>&) {
    list(name, "indices");
  }
  template <class T>
  void numbers(const char* name, const char*, const std::vector<T>&, std::size_t) {
    list(name, "indices");
  }
  void map_entries(const char* name, const char*, std::span<const Index>, MapEncoding) {
    list(name, "mapEntries");
  }
  void hexadecimal(ByteView, std::size_t) { visit_.text = "sha256"; }
  void base64(ByteView) { visit_.text = "xs:base64Binary"; }
  void text(ByteView) { visit_.text = "xs:string"; }

  bool demand(bool holds, Fault, const char*, const char* = nullptr) { return holds; }
  void announce(const XmlTotals&) {}
  void shape_is(Fault) {}
  void belongs_to(const char*, std::size_t) {}

 private:
  std::string path(const char* name) const { return name_ + "/" + name; }
  void note(const char* name, AttributeKind kind) {
    EXPECT_TRUE(visit_.attributes.emplace(name, std::move(kind)).second) << name_ << " " << name;
  }
  void has(const char* name, Occurs occurs) { visit_.children.emplace_back(name, occurs); }
  void list(const char* name, const char* type) {
    has(name, Occurs::once);
    visit(path(name), name, [&](DescribeIo& io) { io.visit_.text = type; });
  }
  template <class T, class Part>
  void part(const char* attribute, const std::vector<T>& items, const Part& part) {
    has(part.name, Occurs::any_number);
    for (const T& item : items)
      if (part.has(item))
        visit(path(part.name), part.name, [&](DescribeIo& io) {
          io.index(attribute, 0);
          part.fields(io, item);
        });
  }

  Gathered& gathered_;
  std::string name_;
  Gathered::Visit visit_;
};

void gather(Gathered& gathered, const ProgressiveStrips& strips) {
  DescribeIo(gathered, "").visit(kRootName, kRootName, [&](DescribeIo& io) {
    xml_layout::document_fields(io, strips);
  });
}

/// What the layout says of every element, from models of all kinds.
Elements layout_elements() {
  Gathered gathered;
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    ProgressiveStrips strips = test::random_progressive_of_any_kind(seed);
    gather(gathered, strips);
    // No wedge attributes, and two face attributes where there was one.
    for (ProgressiveMesh& mesh : strips.meshes) {
      mesh.wedge_attributes.clear();
      const std::vector<Attribute> more = mesh.faces.attributes;
      mesh.faces.attributes.insert(mesh.faces.attributes.end(), more.begin(), more.end());
    }
    gather(gathered, strips);
    strips.profile = Profile::compact;
    gather(gathered, strips);
  }
  Elements elements = gathered.elements();
  // Its form says which of the two it is.
  elements["pstrips/foreign"].text = {"xs:string"};
  return elements;
}

std::filesystem::path spec() { return test::data_dir().parent_path().parent_path() / "spec"; }

/// The schema, as far as ours goes: named types, sequences, choices, attribute groups.
class Schema {
 public:
  Schema() {
    EXPECT_EQ(dom_.LoadFile((spec() / "schemas/pstripx.xsd").c_str()), tinyxml2::XML_SUCCESS);
    root_ = dom_.RootElement();
  }

  Elements elements() {
    const XMLElement* top = root_->FirstChildElement("xs:element");
    add(text(*top, "name"), text(*top, "name"), *top->FirstChildElement("xs:complexType"));
    return std::move(elements_);
  }

 private:
  static std::string text(const XMLElement& e, const char* attribute) {
    const char* value = e.Attribute(attribute);
    return value == nullptr ? "" : value;
  }
  const XMLElement* named(const char* what, const std::string& name) const {
    for (auto* e = root_->FirstChildElement(what); e != nullptr; e = e->NextSiblingElement(what))
      if (text(*e, "name") == name) return e;
    return nullptr;
  }

  void add(const std::string& path, const std::string& name, const XMLElement& type) {
    ElementKind& kind = elements_[path];
    add_attributes(kind, type);
    if (const XMLElement* content = type.FirstChildElement("xs:simpleContent")) {
      const XMLElement& extension = *content->FirstChildElement("xs:extension");
      kind.text.insert(text(extension, "base"));
      add_attributes(kind, extension);
    }
    if (const XMLElement* sequence = type.FirstChildElement("xs:sequence"))
      add_children(name, kind, *sequence, false);
  }

  void add_children(const std::string& name, ElementKind& kind, const XMLElement& list,
                    bool repeats) {
    for (auto* e = list.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      const bool many = repeats || text(*e, "maxOccurs") == "unbounded";
      if (std::string_view(e->Name()) == "xs:choice") {
        add_children(name, kind, *e, many);
        continue;
      }
      const std::string child = text(*e, "name"), type = text(*e, "type");
      const bool optional = text(*e, "minOccurs") == "0";
      kind.children.emplace_back(child, many       ? Occurs::any_number
                                        : optional ? Occurs::at_most_once
                                                   : Occurs::once);
      if (const XMLElement* complex = named("xs:complexType", type))
        add(name + "/" + child, child, *complex);
      else
        elements_[name + "/" + child].text.insert(type);
    }
  }

  void add_attributes(ElementKind& kind, const XMLElement& parent) {
    for (auto* e = parent.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      if (std::string_view(e->Name()) == "xs:attributeGroup")
        add_attributes(kind, *named("xs:attributeGroup", text(*e, "ref")));
      if (std::string_view(e->Name()) == "xs:attribute")
        kind.attributes[text(*e, "name")] = {type_of(*e), text(*e, "default"),
                                             text(*e, "use") != "required"};
    }
  }

  /// The words or pattern of a type that has them, else its name.
  std::string type_of(const XMLElement& attribute) const {
    if (const std::string fixed = text(attribute, "fixed"); !fixed.empty()) return fixed;
    const std::string name = text(attribute, "type");
    const XMLElement* simple = attribute.FirstChildElement("xs:simpleType");
    if (simple == nullptr) simple = named("xs:simpleType", name);
    const XMLElement* restriction =
        simple == nullptr ? nullptr : simple->FirstChildElement("xs:restriction");
    if (restriction == nullptr) return name;
    if (name == "version") return text(*restriction->FirstChildElement("xs:pattern"), "value");
    std::string words;
    for (auto* e = restriction->FirstChildElement("xs:enumeration"); e != nullptr;
         e = e->NextSiblingElement("xs:enumeration"))
      words += (words.empty() ? "" : "|") + text(*e, "value");
    return words.empty() ? name : words;
  }

  tinyxml2::XMLDocument dom_;
  const XMLElement* root_ = nullptr;
  Elements elements_;
};

/// Without these characters at its ends.
std::string stripped(const std::string& text, const char* characters) {
  const std::size_t first = text.find_first_not_of(characters);
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(characters) - first + 1);
}
std::string trimmed(const std::string& text) { return stripped(text, " "); }
std::string bare(const std::string& text) { return stripped(text, " `"); }

std::vector<std::string> split(const std::string& text, char at) {
  std::istringstream in(text);
  std::vector<std::string> out;
  for (std::string item; std::getline(in, item, at);) out.push_back(trimmed(item));
  return out;
}

/// The cells of each row of the table whose first column has that title.
std::vector<std::vector<std::string>> table(const std::string& title) {
  std::ifstream page(spec() / "xml.md");
  std::vector<std::vector<std::string>> rows;
  bool inside = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("| " + title + " |")) inside = true;
    if (!line.starts_with('|')) inside = false;
    if (!inside || line.starts_with("|--") || line.starts_with("| " + title)) continue;
    rows.push_back(split(line.substr(1), '|'));
  }
  return rows;
}

Occurs occurs_of(char mark) {
  if (mark == '?') return Occurs::at_most_once;
  return mark == '*' || mark == '+' ? Occurs::any_number : Occurs::once;
}

/// "`values` *" is the child values, any number of times.
std::pair<std::string, Occurs> child_of(const std::string& text) {
  const Occurs occurs = occurs_of(text.back());
  return {bare(occurs == Occurs::once ? text : text.substr(0, text.size() - 1)), occurs};
}

/// "normalized? (false)" is the attribute normalized; what is in brackets may be other than a
/// value.
std::pair<std::string, AttributeKind> attribute_of(const std::string& text) {
  const std::size_t mark = text.find('?'), bracket = text.find('(');
  AttributeKind kind;
  kind.optional = mark != std::string::npos;
  if (bracket != std::string::npos) {
    const std::string value = text.substr(bracket + 1, text.find(')') - bracket - 1);
    if (value == "true" || value == "false") kind.absent = value;
  }
  return {trimmed(text.substr(0, std::min(mark, bracket))), kind};
}

/// The table of spec/xml.md §2, without types.
Elements page_elements() {
  Elements elements;
  for (const std::vector<std::string>& row : table("element")) {
    EXPECT_EQ(row.size(), 4u) << row.front();
    for (const std::string& cell : split(row[0], ',')) {
      const auto [element, occurs] = child_of(cell);
      const std::string& parent = row[1];
      ElementKind& kind = elements[parent.empty() ? element : parent + "/" + element];
      for (const std::string& attribute : split(row[2], ','))
        kind.attributes.insert(attribute_of(attribute));
      if (parent == kRootName) elements[kRootName].children.emplace_back(element, occurs);
      if (!row[3].starts_with('`')) continue;  // what the text of the element holds
      for (const std::string& child : split(row[3], ',')) kind.children.push_back(child_of(child));
    }
  }
  return elements;
}

constexpr std::size_t kElements = 40;

TEST(XmlSchema, NamesWhatTheLayoutNames) {
  const Elements layout = layout_elements();
  EXPECT_EQ(layout.size(), kElements);
  EXPECT_EQ(differences(lines_of(Schema().elements(), true), lines_of(layout, true)), Lines{});
}

TEST(XmlPage, NamesWhatTheLayoutNames) {
  const Elements page = page_elements();
  EXPECT_EQ(page.size(), kElements);
  EXPECT_EQ(differences(lines_of(page, false), lines_of(layout_elements(), false)), Lines{});
}

TEST(XmlPage, HasTheWordsOfTheLayout) {
  Lines page, layout;
  for (const std::vector<std::string>& row : table("attribute")) {
    std::string words = row[1];
    std::erase_if(words, [](char c) { return c == '`' || c == ','; });
    page.insert(split(row[0], ' ').front() + ": " + words);
  }
  for (const auto& [element, kind] : layout_elements())
    for (const auto& [name, attribute] : kind.attributes)
      if (attribute.type.find('|') != std::string::npos) {
        std::string words = attribute.type;
        std::ranges::replace(words, '|', ' ');
        layout.insert(name + ": " + words);
      }
  EXPECT_EQ(page.size(), 10u);
  EXPECT_EQ(differences(page, layout), Lines{});
}

}  // namespace
}  // namespace pstrips
