#include "formats/gltf/fit.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <set>

#include "core/color_range.h"
#include "core/gather.h"
#include "core/texture_origin.h"
#include "formats/gltf/local_origin.h"

namespace pstrips::inline formats::gltf {
namespace {

constexpr unsigned bit(ComponentType type, bool normalized) {
  return 1u << (2 * static_cast<unsigned>(type) + (normalized ? 1 : 0));
}
constexpr unsigned kFloat = bit(ComponentType::f32, false);
constexpr unsigned kUnsignedNorm = bit(ComponentType::u8, true) | bit(ComponentType::u16, true);
constexpr unsigned kSignedNorm = bit(ComponentType::i8, true) | bit(ComponentType::i16, true);
constexpr unsigned kUnsigned = bit(ComponentType::u8, false) | bit(ComponentType::u16, false);
constexpr unsigned kSigned = bit(ComponentType::i8, false) | bit(ComponentType::i16, false);
constexpr unsigned kSmallIntegers = kUnsignedNorm | kSignedNorm | kUnsigned | kSigned;

/// The attributes that glTF gives a meaning. [glTF 2.0 §3.7.2.1, KHR_mesh_quantization]
struct Semantic {
  std::string_view name;  ///< a trailing '_' stands for a set number
  std::uint8_t least, most;
  unsigned plain;      ///< types of plain glTF
  unsigned quantized;  ///< those that KHR_mesh_quantization adds
};
constexpr Semantic kSemantics[] = {
    {"POSITION", 3, 3, kFloat, kSmallIntegers},
    {"NORMAL", 3, 3, kFloat, kSignedNorm},
    {"TANGENT", 4, 4, kFloat, kSignedNorm},
    {"TEXCOORD_", 2, 2, kFloat | kUnsignedNorm, kSmallIntegers},
    {"COLOR_", 3, 4, kFloat | kUnsignedNorm, 0},
    {"JOINTS_", 4, 4, kUnsigned, 0},
    {"WEIGHTS_", 4, 4, kFloat | kUnsignedNorm, 0},
};

const Semantic* find_semantic(std::string_view name) {
  for (const Semantic& semantic : kSemantics) {
    if (!name.starts_with(semantic.name)) continue;
    const std::string_view set = name.substr(semantic.name.size());
    const bool has_set =
        !set.empty() && std::ranges::all_of(set, [](char c) { return c >= '0' && c <= '9'; });
    if (semantic.name.ends_with('_') ? has_set : set.empty()) return &semantic;
  }
  return nullptr;
}

/// "TARGET_3/NORMAL" -> 3 and "NORMAL", when the number is below `targets`.
void split_target(Fitted& out, std::size_t targets) {
  constexpr std::string_view kPrefix = "TARGET_";
  if (!out.name.starts_with(kPrefix)) return;
  Index k = 0;
  const char* end = out.name.data() + out.name.size();
  const auto [after, error] = std::from_chars(out.name.data() + kPrefix.size(), end, k);
  if (error != std::errc{} || after == end || *after != '/' || k >= targets) return;
  out.target = k;
  out.name = std::string(after + 1, end);
}

Attribute as_float(const Attribute& in, std::uint8_t count) {
  Attribute out{in.semantic, ComponentType::f32, count, false, {}};
  out.data.resize(in.elements() * out.element_bytes());
  std::byte* at = out.data.data();
  for (std::size_t i = 0; i < in.elements(); ++i)
    for (std::uint8_t c = 0; c < count; ++c, at += sizeof(float)) {
      const float value = c < in.count ? static_cast<float>(component(in, i, c)) : 0.f;
      std::memcpy(at, &value, sizeof value);
    }
  return out;
}

Attribute per_wedge(const Mesh& mesh) { return gather(mesh.position, mesh.wedge_vertex); }

std::string custom_name(std::string name) {
  for (char& c : name)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return name.starts_with('_') ? name : '_' + name;
}

/// Names and types of other formats become glTF's.
void fit(Fitted& out, Notes& notes) {
  const Attribute in = out.attribute().format();
  const Semantic* semantic = find_semantic(out.name);
  const bool fits_count = semantic && in.count >= semantic->least && in.count <= semantic->most;
  const unsigned type = bit(in.type, in.normalized);
  if (fits_count && ((semantic->plain | semantic->quantized) & type)) return;
  const bool keeps_name = fits_count && (semantic->plain & kFloat);
  if (!keeps_name && !(out.name.starts_with('_') && custom_name(out.name) == out.name)) {
    out.name = custom_name(out.name);
    notes.converted.push_back("the name of attribute " + in.semantic + ", written as " + out.name);
  }
  if (keeps_name || !((kSmallIntegers | kFloat) & type)) {
    out.converted = as_float(out.attribute(), in.count);
    notes.converted.push_back("the type " + std::string(name_of(in.type)) + " of attribute " +
                              in.semantic + ", written as f32");
  }
}

/// Texture coordinates from the lower left, and colours of 8 or 16 bits.
void convert_values(Fitted& out, const FitOptions& options, Notes& notes) {
  const Attribute& in = *out.source;
  if (options.turns_texcoords && is_texcoord(in.semantic)) out.converted = turned(in);
  if (options.from_gltf || !in.semantic.starts_with("COLOR_")) return;
  const double range = color_range(in);
  if (range == 1) return;
  notes.converted.push_back("colours of " + in.semantic + ", divided by " +
                            std::to_string(static_cast<int>(range)));
  out.converted = color_shares(in);
}

/// False when no accessor type has this many components.
bool set_type(Fitted& out, bool is_mat2) {
  switch (out.attribute().count) {
    case 1:
      out.type = "SCALAR";
      return true;
    case 2:
      out.type = "VEC2";
      return true;
    case 3:
      out.type = "VEC3";
      return true;
    case 4:
      out.type = is_mat2 ? "MAT2" : "VEC4";
      out.rows = is_mat2 ? 2 : 0;
      return true;
    case 9:
      out.type = "MAT3";
      out.rows = 3;
      return true;
    case 16:
      out.type = "MAT4";
      out.rows = 4;
      return true;
    default:
      return false;
  }
}

/// As f32, counted from an origin.
Attribute from_origin(const Attribute& in, const Point& origin) {
  Attribute out{in.semantic, ComponentType::f32, 3, false, {}};
  out.data.resize(in.elements() * out.element_bytes());
  for (std::size_t i = 0; i < in.elements(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      set_component(out, i, c, (c < in.count ? component(in, i, c) : 0) - origin[c]);
  return out;
}

Fitted fit_position(const Mesh& mesh, const Point& origin, Notes& notes) {
  Fitted out{.name = "POSITION", .type = "VEC3", .source = &mesh.position, .converted = {}};
  if (!mesh.wedge_vertex.empty()) out.converted = per_wedge(mesh);
  const Attribute& in = out.attribute();
  const bool is_held = bit(in.type, in.normalized) & (kFloat | kSmallIntegers);
  if (in.count == 3 && is_held && origin == Point{}) return out;
  if (in.type != ComponentType::f32) {
    char text[32];
    const double error = rounding_of(mesh, origin);
    const auto end = std::to_chars(text, std::end(text), error, std::chars_format::general, 3).ptr;
    notes.converted.push_back("the type " + std::string(name_of(in.type)) +
                              " of positions, written as f32, at most " + std::string(text, end) +
                              " away");
  }
  if (in.count > 3) notes.dropped.push_back("components of positions beyond the third");
  out.converted = from_origin(in, origin);
  return out;
}

using Names = std::set<std::pair<Index, std::string>>;

void make_unique(Fitted& out, Names& taken) {
  const std::string base = out.name;
  for (int n = 2; !taken.emplace(out.target, out.name).second; ++n)
    out.name = base + '_' + std::to_string(n);
}

}  // namespace

bool Fitted::needs_quantization() const {
  const Semantic* semantic = find_semantic(name);
  const unsigned type_bit = bit(attribute().type, attribute().normalized);
  return semantic && (semantic->quantized & ~semantic->plain & type_bit);
}

std::vector<Fitted> fit_attributes(const Mesh& mesh, const FitOptions& options, Notes& notes) {
  std::vector<Fitted> out;
  out.push_back(fit_position(mesh, options.origin, notes));
  Names taken{{kNone, out.front().name}};
  for (const Attribute& attribute : mesh.wedge_attributes) {
    Fitted fitted{.name = attribute.semantic, .type = {}, .source = &attribute, .converted = {}};
    split_target(fitted, options.from_gltf ? options.targets : mesh.wedge_attributes.size());
    if (fitted.target == kNone) convert_values(fitted, options, notes);
    const bool wide = attribute.type == ComponentType::f64 || attribute.type == ComponentType::i32;
    if (wide || (!options.from_gltf && fitted.target == kNone)) fit(fitted, notes);
    const bool is_mat2 =
        options.mat2 && std::ranges::find(*options.mat2, attribute.semantic) != options.mat2->end();
    if (!set_type(fitted, is_mat2)) {
      notes.dropped.push_back("attribute " + attribute.semantic + " of " +
                              std::to_string(attribute.count) + " components");
      continue;
    }
    make_unique(fitted, taken);
    out.push_back(std::move(fitted));
  }
  return out;
}

}  // namespace pstrips::inline formats::gltf
