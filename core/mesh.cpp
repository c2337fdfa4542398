#include "core/mesh.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

namespace pstrips::inline core {
namespace {

template <class T>
double load(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return static_cast<double>(value);
}

double load(ComponentType type, const std::byte* at) {
  switch (type) {
    case ComponentType::i8:
      return load<std::int8_t>(at);
    case ComponentType::u8:
      return load<std::uint8_t>(at);
    case ComponentType::i16:
      return load<std::int16_t>(at);
    case ComponentType::u16:
      return load<std::uint16_t>(at);
    case ComponentType::i32:
      return load<std::int32_t>(at);
    case ComponentType::u32:
      return load<std::uint32_t>(at);
    case ComponentType::f32:
      return load<float>(at);
    case ComponentType::f64:
      return load<double>(at);
  }
  return 0;
}

template <class T>
void store(std::byte* at, double value) {
  if constexpr (std::is_integral_v<T>) {
    constexpr double kLeast = std::numeric_limits<T>::min(), kMax = std::numeric_limits<T>::max();
    value = std::isnan(value) ? 0 : std::clamp(std::nearbyint(value), kLeast, kMax);
  } else if constexpr (std::is_same_v<T, float>) {
    constexpr double kMax = std::numeric_limits<float>::max();
    if (std::isfinite(value)) value = std::clamp(value, -kMax, kMax);
  }
  const T stored = static_cast<T>(value);
  std::memcpy(at, &stored, sizeof stored);
}

void store(ComponentType type, std::byte* at, double value) {
  switch (type) {
    case ComponentType::i8:
      return store<std::int8_t>(at, value);
    case ComponentType::u8:
      return store<std::uint8_t>(at, value);
    case ComponentType::i16:
      return store<std::int16_t>(at, value);
    case ComponentType::u16:
      return store<std::uint16_t>(at, value);
    case ComponentType::i32:
      return store<std::int32_t>(at, value);
    case ComponentType::u32:
      return store<std::uint32_t>(at, value);
    case ComponentType::f32:
      return store<float>(at, value);
    case ComponentType::f64:
      return store<double>(at, value);
  }
}

// The integer that stands for 1.
double normalized_unit(ComponentType type) {
  switch (type) {
    case ComponentType::i8:
      return 127;
    case ComponentType::u8:
      return 255;
    case ComponentType::i16:
      return 32767;
    case ComponentType::u16:
      return 65535;
    case ComponentType::i32:
      return 2147483647;
    case ComponentType::u32:
      return 4294967295.0;
    default:
      return 1;
  }
}

bool is_iota(const std::vector<Index>& list) {
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list[i] != i) return false;
  return true;
}

bool wrong_size(const std::vector<Attribute>& attributes, Index elements) {
  return std::ranges::any_of(attributes, [&](const Attribute& a) {
    return a.count == 0 || a.data.size() != a.element_bytes() * elements;
  });
}

}  // namespace

std::string_view name_of(ComponentType type) {
  constexpr std::string_view kNames[] = {"i8", "u8", "i16", "u16", "i32", "u32", "f32", "f64"};
  return kNames[static_cast<std::size_t>(type)];
}

bool Attribute::same_format(const Attribute& other) const {
  return semantic == other.semantic && type == other.type && count == other.count &&
         normalized == other.normalized;
}

double component(const Attribute& attribute, std::size_t i, std::size_t c) {
  const std::byte* at =
      attribute.data.data() + i * attribute.element_bytes() + c * size_of(attribute.type);
  const double value = load(attribute.type, at);
  if (!attribute.normalized || attribute.type >= ComponentType::f32) return value;
  return std::max(value / normalized_unit(attribute.type), -1.0);
}

void set_component(Attribute& attribute, std::size_t i, std::size_t c, double value) {
  std::byte* at =
      attribute.data.data() + i * attribute.element_bytes() + c * size_of(attribute.type);
  const bool scaled = attribute.normalized && attribute.type < ComponentType::f32;
  store(attribute.type, at, scaled ? value * normalized_unit(attribute.type) : value);
}

void canonicalize(Mesh& mesh) {
  if (mesh.groups.empty()) mesh.groups.emplace_back();
  if (mesh.wedge_vertex.size() == mesh.vertex_count() && is_iota(mesh.wedge_vertex))
    mesh.wedge_vertex = {};
  bool triangles = mesh.corners.size() == std::size_t{3} * mesh.face_count();
  for (std::size_t i = 0; triangles && i < mesh.face_first.size(); ++i)
    triangles = mesh.face_first[i] == 3 * i;
  if (triangles) mesh.face_first = {};
  if (std::ranges::all_of(mesh.face_group, [](Index g) { return g == 0; })) mesh.face_group = {};
}

std::string find_inconsistency(const Mesh& mesh) {
  if (mesh.groups.empty()) return "no group";
  if (mesh.position.count == 0 || mesh.position.data.size() % mesh.position.element_bytes() != 0)
    return "position data is not a whole number of elements";
  const Index vertices = mesh.vertex_count(), wedges = mesh.wedge_count();
  if (!mesh.wedge_vertex.empty()) {
    std::vector<bool> has_wedge(vertices);
    for (const Index v : mesh.wedge_vertex) {
      if (v >= vertices) return "wedge names a vertex past the end";
      has_wedge[v] = true;
    }
    if (std::ranges::find(has_wedge, false) != has_wedge.end()) return "vertex without a wedge";
  }
  if (wrong_size(mesh.wedge_attributes, wedges)) return "wedge attribute of the wrong length";
  if (mesh.face_first.empty() && mesh.corners.size() % 3 != 0) return "corners are not triples";
  if (!mesh.face_first.empty() &&
      (mesh.face_first.front() != 0 || mesh.face_first.back() != mesh.corners.size() ||
       !std::ranges::is_sorted(mesh.face_first)))
    return "face bounds do not partition the corners";
  for (const Index w : mesh.corners)
    if (w >= wedges) return "corner names a wedge past the end";
  if (wrong_size(mesh.face_attributes, mesh.face_count()))
    return "face attribute of the wrong length";
  if (!mesh.face_group.empty() && mesh.face_group.size() != mesh.face_count())
    return "face groups of the wrong length";
  for (const Index g : mesh.face_group)
    if (g >= mesh.groups.size()) return "face names a group past the end";
  return {};
}

std::vector<double> positions_as_double(const Mesh& mesh) {
  const Attribute& p = mesh.position;
  std::vector<double> out(std::size_t{3} * mesh.vertex_count());
  const std::size_t used = std::min<std::size_t>(p.count, 3);
  if (p.type == ComponentType::f32 && p.count == 3) {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = load<float>(p.data.data() + 4 * i);
    return out;
  }
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    for (std::size_t c = 0; c < used; ++c) out[3 * v + c] = component(p, v, c);
  return out;
}

}  // namespace pstrips::inline core
