#include "formats/ply/ply_layout.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <map>
#include <optional>

namespace pstrips::inline formats::ply {
namespace {

enum class Meaning : std::uint8_t { normal, color, texcoord };

/// Names that stand for one attribute together. A fourth name is optional.
struct NameSet {
  Meaning meaning;
  std::array<std::string_view, 4> names;
  std::size_t required() const { return meaning == Meaning::texcoord ? 2 : 3; }
};

constexpr NameSet kNameSets[] = {
    {Meaning::normal, {"nx", "ny", "nz"}},
    {Meaning::color, {"red", "green", "blue", "alpha"}},
    {Meaning::color, {"diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha"}},
    {Meaning::color, {"r", "g", "b", "a"}},
    {Meaning::texcoord, {"s", "t"}},
    {Meaning::texcoord, {"u", "v"}},
    {Meaning::texcoord, {"texture_u", "texture_v"}},
    {Meaning::texcoord, {"s0", "t0"}},
    {Meaning::texcoord, {"u0", "v0"}},
    {Meaning::texcoord, {"s1", "t1"}},
    {Meaning::texcoord, {"u1", "v1"}},
    {Meaning::texcoord, {"s2", "t2"}},
    {Meaning::texcoord, {"u2", "v2"}},
    {Meaning::texcoord, {"s3", "t3"}},
    {Meaning::texcoord, {"u3", "v3"}},
};

constexpr std::string_view kAxes[] = {"x", "y", "z"};

bool fits(Meaning meaning, ComponentType type) {
  if (!is_integer(type)) return true;
  if (meaning == Meaning::normal) return type == ComponentType::i8 || type == ComponentType::i16;
  return type == ComponentType::u8 || type == ComponentType::u16;
}

/// What a property's name says in the form NAME[3] or, normalized, NAME[3]n.
struct Indexed {
  std::string base;
  unsigned index = 0;
  bool normalized = false;
};

std::optional<Indexed> parse_indexed(std::string_view name) {
  Indexed out;
  if (name.ends_with("]n")) {
    out.normalized = true;
    name.remove_suffix(1);
  }
  const std::size_t open = name.rfind('[');
  if (open == std::string_view::npos || !name.ends_with(']')) return std::nullopt;
  const std::string_view digits = name.substr(open + 1, name.size() - open - 2);
  const auto [end, failed] =
      std::from_chars(digits.data(), digits.data() + digits.size(), out.index);
  if (failed != std::errc{} || end != digits.data() + digits.size() || out.index > 254 ||
      std::to_string(out.index) != digits)
    return std::nullopt;
  name = name.substr(0, open);
  for (std::size_t i = 0; i < name.size(); ++i) {
    unsigned code = 0;
    if (name[i] != '%') {
      out.base += name[i];
    } else if (i + 2 < name.size() &&
               std::from_chars(&name[i + 1], &name[i + 1] + 2, code, 16).ptr == &name[i + 1] + 2) {
      out.base += static_cast<char>(code);
      i += 2;
    } else {
      return std::nullopt;
    }
  }
  return out;
}

bool needs_escape(char c) {
  return static_cast<unsigned char>(c) <= ' ' || c == '%' || c == '\x7f';
}

std::string indexed_name(const Attribute& attribute, unsigned index) {
  constexpr char kHex[] = "0123456789abcdef";
  std::string out;
  for (const char c : attribute.semantic) {
    if (!needs_escape(c)) {
      out += c;
      continue;
    }
    const auto code = static_cast<unsigned char>(c);
    out += {'%', kHex[code >> 4], kHex[code & 15]};
  }
  out += '[' + std::to_string(index) + ']';
  return attribute.normalized ? out + 'n' : out;
}

/// A name that no rule reads as anything but itself.
bool is_plain_name(std::string_view name) {
  if (name.empty() || std::ranges::any_of(name, needs_escape) || parse_indexed(name)) return false;
  if (name == kWedgeVertex || name == "list" || std::ranges::count(kAxes, name) != 0) return false;
  return std::ranges::none_of(
      kNameSets, [&](const NameSet& set) { return std::ranges::count(set.names, name) != 0; });
}

/// Builds a layout in one walk over the properties.
class LayoutBuilder {
 public:
  explicit LayoutBuilder(const Element& element) : properties_(element.properties) {
    layout_.places.resize(properties_.size());
    taken_.resize(properties_.size());
    for (std::size_t i = 0; i < properties_.size(); ++i)
      if (!properties_[i].is_list()) by_name_.emplace(properties_[i].name, i);
  }

  void take(std::size_t property, Layout::Role role, std::size_t component = 0) {
    layout_.places[property] = {role, static_cast<std::uint8_t>(component), 0};
    taken_[property] = true;
  }

  void position() {
    std::array<std::size_t, 3> at{};
    for (std::size_t c = 0; c < 3; ++c) {
      const auto found = by_name_.find(kAxes[c]);
      if (found == by_name_.end()) return;
      at[c] = found->second;
    }
    layout_.has_position = true;
    layout_.position_type = properties_[at[0]].type;
    for (std::size_t c = 0; c < 3; ++c) {
      take(at[c], Layout::Role::position, c);
      if (properties_[at[c]].type != properties_[at[0]].type)
        layout_.position_type = ComponentType::f64;
    }
  }

  void wedge_vertex() {
    const auto found = by_name_.find(kWedgeVertex);
    if (found == by_name_.end()) return;
    const Property& property = properties_[found->second];
    if (property.type == ComponentType::u32 &&
        std::ranges::count(property.remarks, kWedgeRemark) != 0)
      take(found->second, Layout::Role::wedge_vertex);
  }

  Layout run(bool texcoords, unsigned first_texcoord) {
    next_texcoord_ = first_texcoord;
    if (first_texcoord != 0) uses_["TEXCOORD_0"] = 1;  // the faces' own
    for (std::size_t i = 0; i < properties_.size(); ++i) {
      if (taken_[i]) continue;
      if (properties_[i].is_list()) {
        take(i, Layout::Role::kept);
      } else if (!take_set(i, texcoords) && !take_indexed(i)) {
        add({.semantic = properties_[i].name,
             .type = properties_[i].type,
             .count = 1,
             .normalized = false,
             .data = {}},
            {&i, 1});
      }
    }
    return std::move(layout_);
  }

 private:
  void add(Attribute attribute, std::span<const std::size_t> properties) {
    attribute.semantic = unique(attribute.semantic);
    for (std::size_t c = 0; c < properties.size(); ++c) {
      layout_.places[properties[c]] = {Layout::Role::attribute, static_cast<std::uint8_t>(c),
                                       static_cast<std::uint32_t>(layout_.attributes.size())};
      taken_[properties[c]] = true;
    }
    layout_.attributes.push_back(std::move(attribute));
  }

  std::string unique(const std::string& semantic) {
    unsigned& uses = uses_[semantic];
    if (uses == 0) {
      uses = 1;
      return semantic;
    }
    while (true) {
      std::string numbered = semantic + '~' + std::to_string(++uses);
      if (uses_.try_emplace(numbered, 1).second) return numbered;
    }
  }

  bool take_set(std::size_t first, bool texcoords) {
    for (const NameSet& set : kNameSets) {
      if (set.meaning == Meaning::texcoord && !texcoords) continue;
      if (std::ranges::count(set.names, properties_[first].name) == 0) continue;
      std::array<std::size_t, 4> at{};
      std::size_t count = 0;
      for (; count < 4 && !set.names[count].empty(); ++count) {
        const auto found = by_name_.find(set.names[count]);
        if (found == by_name_.end() || taken_[found->second] ||
            properties_[found->second].type != properties_[first].type)
          break;
        at[count] = found->second;
      }
      const auto used = std::span(at).first(count);
      if (count < set.required() || std::ranges::count(used, first) == 0 ||
          !fits(set.meaning, properties_[first].type))
        continue;
      add({.semantic = semantic(set.meaning),
           .type = properties_[first].type,
           .count = static_cast<std::uint8_t>(count),
           .normalized = is_integer(properties_[first].type),
           .data = {}},
          used);
      return true;
    }
    return false;
  }

  std::string semantic(Meaning meaning) {
    if (meaning == Meaning::normal) return "NORMAL";
    if (meaning == Meaning::color) return "COLOR_" + std::to_string(next_color_++);
    return "TEXCOORD_" + std::to_string(next_texcoord_++);
  }

  bool take_indexed(std::size_t first) {
    const auto head = parse_indexed(properties_[first].name);
    if (!head || head->index != 0) return false;
    std::vector<std::size_t> run{first};
    for (std::size_t i = first + 1; i < properties_.size() && !taken_[i]; ++i) {
      const Property& property = properties_[i];
      const auto next = property.is_list() ? std::nullopt : parse_indexed(property.name);
      if (!next || next->base != head->base || next->index != run.size() ||
          next->normalized != head->normalized || property.type != properties_[first].type)
        break;
      run.push_back(i);
    }
    add({.semantic = head->base,
         .type = properties_[first].type,
         .count = static_cast<std::uint8_t>(run.size()),
         .normalized = head->normalized,
         .data = {}},
        run);
    return true;
  }

  const std::vector<Property>& properties_;
  Layout layout_;
  std::vector<bool> taken_;
  std::map<std::string_view, std::size_t> by_name_;        // scalars; the first of each name
  std::map<std::string, unsigned> uses_{{"POSITION", 1}};  // of each semantic
  unsigned next_color_ = 0, next_texcoord_ = 0;
};

bool is_corner_list(const Property& property) {
  return property.is_list() &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}
bool is_texcoord_list(const Property& property) {
  return property.is_list() && property.name == "texcoord" && !is_integer(property.type);
}

}  // namespace

bool Layout::has(Role role) const {
  return std::ranges::any_of(places, [&](const Place& place) { return place.role == role; });
}

Layout vertex_layout(const Element& vertex, bool faces_have_texcoords) {
  LayoutBuilder builder(vertex);
  builder.position();
  builder.wedge_vertex();
  return builder.run(true, faces_have_texcoords ? 1 : 0);
}

Layout face_layout(const Element& face) {
  LayoutBuilder builder(face);
  const auto& properties = face.properties;
  const auto corners = std::ranges::find_if(properties, is_corner_list);
  const auto texcoord = std::ranges::find_if(properties, is_texcoord_list);
  if (corners != properties.end())
    builder.take(static_cast<std::size_t>(corners - properties.begin()), Layout::Role::corners);
  if (texcoord != properties.end())
    builder.take(static_cast<std::size_t>(texcoord - properties.begin()), Layout::Role::texcoord);
  return builder.run(false, 0);
}

bool has_texcoord_list(const Element& face) {
  return std::ranges::any_of(face.properties, is_texcoord_list);
}

std::vector<Property> properties_for(const Attribute& attribute, bool usual) {
  const auto set = std::ranges::find_if(kNameSets, [&](const NameSet& s) {
    const std::string_view semantic = s.meaning == Meaning::normal  ? "NORMAL"
                                      : s.meaning == Meaning::color ? "COLOR_0"
                                                                    : "TEXCOORD_0";
    const bool full =
        attribute.count == s.required() || (s.meaning == Meaning::color && attribute.count == 4);
    return attribute.semantic == semantic && full && fits(s.meaning, attribute.type) &&
           attribute.normalized == is_integer(attribute.type);
  });
  std::vector<Property> out;
  const bool plain =
      attribute.count == 1 && !attribute.normalized && is_plain_name(attribute.semantic);
  for (unsigned c = 0; c < attribute.count; ++c) {
    std::string name = usual && set != std::end(kNameSets) ? std::string(set->names[c])
                       : usual && plain                    ? attribute.semantic
                                                           : indexed_name(attribute, c);
    out.push_back(scalar_property(std::move(name), attribute.type));
  }
  return out;
}

}  // namespace pstrips::inline formats::ply
