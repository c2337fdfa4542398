#include "formats/gltf/mend.h"

#include <algorithm>
#include <cmath>

#include "core/point.h"

namespace pstrips::inline formats::gltf {
namespace {

/// By how much lengths and sums may miss 1, below what validators complain of.
constexpr double kLengthTolerance = 0.005, kSumTolerance = 2e-7;

std::string count_of(std::uint64_t n, const std::string& what) {
  return std::to_string(n) + " elements of " + what;
}

class Mender {
 public:
  Mender(const Mesh& mesh, bool from_gltf, std::vector<Fitted>& attributes, Notes& notes)
      : mesh_(mesh), from_gltf_(from_gltf), attributes_(attributes), notes_(notes) {}

  void mend() {
    std::erase_if(attributes_, [&](Fitted& fitted) { return !make_finite(fitted); });
    if (Fitted* normal = find("NORMAL", 3)) mend_normals(*normal);
    if (Fitted* tangent = find("TANGENT", 4)) mend_tangents(*tangent);
    for (Fitted& fitted : attributes_)
      if (fitted.target == kNone && fitted.name.starts_with("COLOR_")) clamp(fitted);
    mend_weights();
  }

 private:
  static bool is_float(const Fitted& fitted) {
    return fitted.attribute().type == ComponentType::f32;
  }
  /// The attribute, as one that may be changed.
  static Attribute& own(Fitted& fitted) {
    if (!fitted.converted) fitted.converted = *fitted.source;
    return *fitted.converted;
  }
  Fitted* find(const std::string& name, std::uint8_t components) {
    for (Fitted& fitted : attributes_)
      if (fitted.target == kNone && fitted.name == name && fitted.attribute().count == components)
        return &fitted;
    return nullptr;
  }
  void remove(const std::string& name) {
    std::erase_if(attributes_,
                  [&](const Fitted& f) { return f.target == kNone && f.name == name; });
  }
  /// For values that came from glTF: what is wrong is said and stays.
  bool stays(std::uint64_t wrong, const std::string& name, const char* how) {
    if (from_gltf_ && wrong > 0)
      notes_.converted.push_back(count_of(wrong, name) + how + ", kept as they are");
    return from_gltf_ || wrong == 0;
  }

  /// False when no element is a number.
  bool make_finite(Fitted& fitted) {
    const Attribute& in = fitted.attribute();
    if (in.type != ComponentType::f32) return true;
    std::vector<std::size_t> wrong;
    for (std::size_t i = 0; i < in.elements(); ++i)
      for (std::size_t c = 0; c < in.count; ++c)
        if (!std::isfinite(component(in, i, c))) {
          wrong.push_back(i);
          break;
        }
    if (wrong.empty()) return true;
    if (wrong.size() == in.elements()) {
      notes_.dropped.push_back("attribute " + fitted.name + ", which holds no numbers");
      return false;
    }
    Attribute& out = own(fitted);
    const double instead = fitted.name.starts_with("COLOR_") ? 1 : 0;
    for (const std::size_t i : wrong)
      for (std::size_t c = 0; c < out.count; ++c)
        if (!std::isfinite(component(out, i, c))) set_component(out, i, c, instead);
    notes_.converted.push_back(count_of(wrong.size(), fitted.name) +
                               " that are no numbers, written as " + (instead == 1 ? "1" : "0"));
    return true;
  }

  static Point direction_of(const Attribute& a, std::size_t i) {
    return {component(a, i, 0), component(a, i, 1), component(a, i, 2)};
  }
  static void set_direction(Attribute& a, std::size_t i, const Point& p) {
    for (std::size_t c = 0; c < 3; ++c) set_component(a, i, c, p[c]);
  }
  static bool is_unit(const Point& p) { return std::abs(length(p) - 1) <= kLengthTolerance; }

  void mend_normals(Fitted& fitted) {
    const Attribute& in = fitted.attribute();
    if (!is_float(fitted)) return;  // as near to unit length as its integers come
    std::uint64_t wrong = 0, without = 0;
    for (std::size_t i = 0; i < in.elements(); ++i) {
      const Point n = direction_of(in, i);
      if (length(n) == 0)
        ++without;
      else if (!is_unit(n))
        ++wrong;
    }
    if (stays(wrong + without, "NORMAL", " not of unit length")) return;
    if (without == in.elements()) {
      notes_.dropped.push_back("attribute NORMAL, all of length 0");
      return remove("NORMAL");
    }
    Attribute& out = own(fitted);
    if (wrong > 0)
      notes_.converted.push_back(count_of(wrong, "NORMAL") + " brought to unit length");
    for (std::size_t i = 0; i < out.elements(); ++i) {
      const Point n = direction_of(out, i);
      const double size = length(n);
      if (size > 0 && !is_unit(n)) set_direction(out, i, n * (1 / size));
    }
    if (without > 0) compute_normals(out);
  }

  /// Twice the area times the normal of a polygon.
  Point area_of(std::span<const Index> face) const {
    Point out{};
    const Attribute& position = mesh_.position;
    if (face.size() < 3 || position.count < 3) return out;
    const Point first = direction_of(position, mesh_.vertex_of(face[0]));
    for (std::size_t k = 1; k + 1 < face.size(); ++k)
      out = out + cross(direction_of(position, mesh_.vertex_of(face[k])) - first,
                        direction_of(position, mesh_.vertex_of(face[k + 1])) - first);
    return out;
  }

  /// Those of length 0.
  void compute_normals(Attribute& normals) {
    std::vector<Point> sum(normals.elements());
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      if (mesh_.groups[mesh_.group_of(f)].kind != FaceKind::polygons) continue;
      const Point area = area_of(mesh_.face(f));
      for (const Index w : mesh_.face(f)) sum[w] = sum[w] + area;
    }
    std::uint64_t computed = 0, unseen = 0;
    for (std::size_t i = 0; i < normals.elements(); ++i) {
      if (length(direction_of(normals, i)) != 0) continue;
      const Point n = sum[i] * (1 / length(sum[i]));
      const bool has_direction = is_finite(n) && is_unit(n);
      ++(has_direction ? computed : unseen);
      set_direction(normals, i, has_direction ? n : Point{0, 0, 1});
    }
    if (computed > 0)
      notes_.converted.push_back(count_of(computed, "NORMAL") +
                                 " of length 0, computed from the faces");
    if (unseen > 0)
      notes_.converted.push_back(count_of(unseen, "NORMAL") +
                                 " of length 0 at vertices that no face shows, written as 0 0 1");
  }

  void mend_tangents(Fitted& fitted) {
    if (!find("NORMAL", 3)) {
      notes_.dropped.push_back("attribute TANGENT, since there are no normals");
      return remove("TANGENT");
    }
    const Attribute& in = fitted.attribute();
    if (!is_float(fitted)) return;
    std::uint64_t wrong = 0;
    bool without = false;
    for (std::size_t i = 0; i < in.elements(); ++i) {
      const Point t = direction_of(in, i);
      const double sign = component(in, i, 3);
      if (!is_unit(t) || std::abs(sign) != 1) ++wrong;
      without |= length(t) == 0 || sign == 0;
    }
    if (stays(wrong, "TANGENT", " not of unit length, or of a sign other than 1 and -1")) return;
    if (without) {
      notes_.dropped.push_back("attribute TANGENT, which has elements without direction");
      return remove("TANGENT");
    }
    notes_.converted.push_back(count_of(wrong, "TANGENT") + " brought to unit length");
    Attribute& out = own(fitted);
    for (std::size_t i = 0; i < out.elements(); ++i) {
      const Point t = direction_of(out, i);
      set_direction(out, i, t * (1 / length(t)));
      set_component(out, i, 3, component(out, i, 3) < 0 ? -1 : 1);
    }
  }

  void clamp(Fitted& fitted) {
    const Attribute& in = fitted.attribute();
    if (!is_float(fitted)) return;
    std::uint64_t wrong = 0;
    for (std::size_t i = 0; i < in.elements(); ++i)
      for (std::size_t c = 0; c < in.count; ++c) {
        const double x = component(in, i, c);
        if (x < 0 || x > 1) ++wrong;
      }
    if (stays(wrong, fitted.name, " beyond 0 to 1")) return;
    notes_.converted.push_back(count_of(wrong, fitted.name) + " beyond 0 to 1, clamped");
    Attribute& out = own(fitted);
    for (std::size_t i = 0; i < out.elements(); ++i)
      for (std::size_t c = 0; c < out.count; ++c)
        set_component(out, i, c, std::clamp(component(out, i, c), 0.0, 1.0));
  }

  /// The sets of weights; those without joints, and joints without them, go.
  std::vector<Fitted*> weight_sets() {
    std::vector<std::string> alone;
    for (const Fitted& f : attributes_) {
      const bool is_joints = f.name.starts_with("JOINTS_"),
                 is_weights = f.name.starts_with("WEIGHTS_");
      if (f.target != kNone || (!is_joints && !is_weights)) continue;
      const std::string set = f.name.substr(f.name.find('_'));
      if (!find((is_joints ? "WEIGHTS" : "JOINTS") + set, 4)) alone.push_back(f.name);
    }
    for (const std::string& name : alone) {
      notes_.dropped.push_back("attribute " + name + ", since joints and weights need each other");
      remove(name);
    }
    std::vector<Fitted*> out;
    for (int n = 0; Fitted* set = find("WEIGHTS_" + std::to_string(n), 4); ++n) out.push_back(set);
    return out;
  }

  void mend_weights() {
    const std::vector<Fitted*> sets = weight_sets();
    if (sets.empty() || !std::ranges::all_of(sets, [](Fitted* f) { return is_float(*f); })) return;
    std::uint64_t wrong = 0;
    bool hopeless = false;
    std::vector<double> sums(sets.front()->attribute().elements());
    for (std::size_t i = 0; i < sums.size(); ++i) {
      std::size_t used = 0;
      for (const Fitted* set : sets)
        for (std::size_t c = 0; c < 4; ++c) {
          const double weight = component(set->attribute(), i, c);
          sums[i] += weight;
          used += weight != 0 ? 1 : 0;
          hopeless |= weight < 0;
        }
      if (std::abs(sums[i] - 1) > kSumTolerance * static_cast<double>(used)) ++wrong;
      hopeless |= sums[i] <= 0;
    }
    if (stays(wrong, "WEIGHTS", " whose sum is not 1")) return;
    if (hopeless) {
      notes_.dropped.push_back("joints and weights: some are negative or have no sum");
      std::erase_if(attributes_, [](const Fitted& f) {
        return f.target == kNone &&
               (f.name.starts_with("JOINTS_") || f.name.starts_with("WEIGHTS_"));
      });
      return;
    }
    notes_.converted.push_back(count_of(wrong, "WEIGHTS") + " scaled to the sum 1");
    for (Fitted* set : sets) {
      Attribute& out = own(*set);
      for (std::size_t i = 0; i < sums.size(); ++i)
        for (std::size_t c = 0; c < 4; ++c)
          set_component(out, i, c, component(out, i, c) / sums[i]);
    }
  }

  const Mesh& mesh_;
  bool from_gltf_;
  std::vector<Fitted>& attributes_;
  Notes& notes_;
};

}  // namespace

void mend_values(const Mesh& mesh, bool from_gltf, std::vector<Fitted>& attributes, Notes& notes) {
  Mender(mesh, from_gltf, attributes, notes).mend();
}

}  // namespace pstrips::inline formats::gltf
