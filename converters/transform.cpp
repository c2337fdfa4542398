#include "converters/transform.h"

#include <algorithm>
#include <cmath>

#include "core/point.h"

namespace pstrips::inline converters {
namespace {

/// The linear part of a matrix and what follows from it.
struct Linear {
  Point columns[3];
  Point cofactors[3];  ///< columns of the inverse transpose, times the determinant
  double determinant;

  explicit Linear(const Matrix4& m)
      : columns{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}},
        cofactors{cross(columns[1], columns[2]), cross(columns[2], columns[0]),
                  cross(columns[0], columns[1])},
        determinant(dot(columns[0], cofactors[0])) {}

  bool is_identity() const {
    return columns[0] == Point{1, 0, 0} && columns[1] == Point{0, 1, 0} &&
           columns[2] == Point{0, 0, 1};
  }
  bool mirrors() const { return determinant < 0; }
  Point move(const Point& v) const {
    return columns[0] * v[0] + columns[1] * v[1] + columns[2] * v[2];
  }
  /// What keeps the length of a normal that turn_normal() turned, where all axes scale alike.
  double normal_share() const {
    return determinant == 0 ? 0 : std::pow(std::abs(determinant), -2.0 / 3);
  }
  /// By the inverse transpose but for the length.
  Point turn_normal(const Point& v) const {
    const Point out = cofactors[0] * v[0] + cofactors[1] * v[1] + cofactors[2] * v[2];
    return mirrors() ? out * -1 : out;
  }
};

Point element_of(const Attribute& a, std::size_t i) {
  return {component(a, i, 0), component(a, i, 1), component(a, i, 2)};
}

/// With the length of `model`; that itself where `v` has no direction.
Point with_length_of(const Point& model, const Point& v) {
  const double scale = length(model) / length(v);
  const Point out = v * scale;
  return is_finite(out) ? out : model;
}

/// Floats instead of integers, which scaled values would not fit.
void make_float(Attribute& a, ComponentType wanted) {
  if (a.type == wanted) return;
  Attribute out{a.semantic, wanted, a.count, false, {}};
  out.data.resize(a.elements() * out.element_bytes());
  for (std::size_t i = 0; i < a.elements(); ++i)
    for (std::size_t c = 0; c < a.count; ++c) set_component(out, i, c, component(a, i, c));
  a = std::move(out);
}

template <class Change>
void change_elements(Attribute& a, Change&& change) {
  if (a.type != ComponentType::f64) make_float(a, ComponentType::f32);
  for (std::size_t i = 0; i < a.elements(); ++i) {
    const Point moved = change(element_of(a, i));
    for (std::size_t c = 0; c < 3; ++c) set_component(a, i, c, moved[c]);
  }
}

void move_positions(Attribute& position, const Linear& linear, const Point& by) {
  if (position.count < 3) return;
  make_float(position, ComponentType::f64);
  change_elements(position, [&](const Point& p) { return linear.move(p) + by; });
}

void turn_attribute(Attribute& a, const Linear& linear) {
  if (a.count < 3) return;
  const bool is_target = a.semantic.starts_with("TARGET_");
  const std::string_view name =
      is_target ? std::string_view(a.semantic)
                      .substr(std::min(a.semantic.find('/') + 1, a.semantic.size()))
                : std::string_view(a.semantic);
  if (name == "NORMAL" && !is_target)
    change_elements(a, [&](const Point& n) { return with_length_of(n, linear.turn_normal(n)); });
  else if (name == "NORMAL")
    change_elements(a, [&, share = linear.normal_share()](const Point& n) {
      return linear.turn_normal(n) * share;
    });
  else if (name == "TANGENT" && !is_target)
    change_elements(a, [&](const Point& t) { return with_length_of(t, linear.move(t)); });
  else if (is_target && (name == "POSITION" || name == "TANGENT"))
    change_elements(a, [&](const Point& p) { return linear.move(p); });
  if (a.semantic == "TANGENT" && a.count == 4 && linear.mirrors())
    for (std::size_t i = 0; i < a.elements(); ++i) set_component(a, i, 3, -component(a, i, 3));
}

void turn_over(Mesh& mesh) {
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (mesh.groups[mesh.group_of(f)].kind != FaceKind::polygons) continue;
    const std::size_t first = mesh.face_first.empty() ? std::size_t{3} * f : mesh.face_first[f];
    const auto corners = std::span(mesh.corners).subspan(first, mesh.face(f).size());
    if (corners.size() > 1) std::reverse(corners.begin() + 1, corners.end());
  }
}

}  // namespace

void transform(Mesh& mesh, const Matrix4& matrix) {
  if (matrix == kIdentity4) return;
  const Linear linear(matrix);
  move_positions(mesh.position, linear, {matrix[12], matrix[13], matrix[14]});
  if (linear.is_identity()) return;
  for (Attribute& attribute : mesh.wedge_attributes) turn_attribute(attribute, linear);
  if (linear.mirrors()) turn_over(mesh);
}

}  // namespace pstrips::inline converters
