#include "tests/support/appearance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace pstrips::test {
namespace {

Point unit(const Point& p) { return p * (1 / length(p)); }

using Colour = std::array<float, 3>;
constexpr Colour kGrey{0.5f, 0.5f, 0.5f};

double squared_distance(const Colour& a, const Colour& b) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += double{a[k] - b[k]} * (a[k] - b[k]) / 3;
  return sum;
}

double angle(const Point& a, const Point& b) {
  return std::acos(std::clamp(dot(a, b), -1.0, 1.0)) * 180 / std::numbers::pi;
}

double luminance(const Colour& c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; }

// The map from texture coordinates to a triangle.
struct TriangleStretch {
  double area = 0;        // of the triangle
  double squared = 0;     // mean over all directions; infinite without an area in the texture
  double maximum = 0;     // not squared
  bool mirrored = false;  // the texture runs clockwise
};

TriangleStretch stretch_of(const RenderMesh::Corner* c) {
  const Point e1 = c[1].position - c[0].position, e2 = c[2].position - c[0].position;
  const Point n = cross(e1, e2);
  TriangleStretch out{.area = std::sqrt(dot(n, n)) / 2};
  const double s1 = c[1].uv[0] - c[0].uv[0], t1 = c[1].uv[1] - c[0].uv[1];
  const double s2 = c[2].uv[0] - c[0].uv[0], t2 = c[2].uv[1] - c[0].uv[1];
  const double determinant = s1 * t2 - s2 * t1;
  // Below a billionth of what its sides could span it is rounding.
  if (std::abs(determinant) <= 1e-9 * (s1 * s1 + t1 * t1 + s2 * s2 + t2 * t2)) {
    out.squared = std::numeric_limits<double>::infinity();
    return out;
  }
  Point along_s, along_t;
  for (std::size_t k = 0; k < 3; ++k) {
    along_s[k] = (e1[k] * t2 - e2[k] * t1) / determinant;
    along_t[k] = (e2[k] * s1 - e1[k] * s2) / determinant;
  }
  const double ss = dot(along_s, along_s), tt = dot(along_t, along_t);
  const double st = dot(along_s, along_t);
  out.squared = (ss + tt) / 2;
  out.maximum = std::sqrt((ss + tt + std::sqrt((ss - tt) * (ss - tt) + 4 * st * st)) / 2);
  out.mirrored = determinant < 0;
  return out;
}

std::vector<TriangleStretch> stretches_of(const RenderMesh& mesh) {
  std::vector<TriangleStretch> out;
  for (std::size_t i = 0; i < mesh.corners.size(); i += 3)
    out.push_back(stretch_of(&mesh.corners[i]));
  return out;
}

// A mesh and what of it does not depend on the camera.
struct Side {
  const RenderMesh& mesh;
  std::vector<TriangleStretch> stretches;
  explicit Side(const RenderMesh& m) : mesh(m), stretches(stretches_of(m)) {}
};

// Sums over all pictures; the means at the end.
class Comparison {
 public:
  Comparison(const RenderMesh& original, const RenderMesh& other)
      : original_(original), other_(other) {}
  void add(const Picture& original, const Picture& other, const Camera& camera);
  Appearance result() const;

 private:
  void add_pixel(const Pixel& a, const Pixel& b, const Point& toward);
  void add_texture(const Pixel& a, const Pixel& b);
  double stretch_between(const Pixel& a, const Pixel& b) const;
  void add_structure(const Picture& original, const Picture& other, const Point& toward);

  const Side original_, other_;
  Appearance sums_;
  std::size_t covered_ = 0, either_ = 0, both_ = 0, same_ = 0, windows_ = 0;
};

void Comparison::add(const Picture& original, const Picture& other, const Camera& camera) {
  for (std::size_t i = 0; i < original.pixels.size(); ++i) {
    const Pixel &a = original.pixels[i], &b = other.pixels[i];
    add_pixel(a, b, camera.toward);
    if (a.is_covered() && b.is_covered() && a.from_behind == b.from_behind &&
        std::abs(a.depth - b.depth) < kSameSurface * camera.radius)
      add_texture(a, b);
  }
  add_structure(original, other, camera.toward);
}

void Comparison::add_pixel(const Pixel& a, const Pixel& b, const Point& toward) {
  if (!a.is_covered() && !b.is_covered()) return;
  ++either_;
  if (a.is_covered()) ++covered_;
  const auto colour = [&](const Pixel& p, const Colour& seen) {
    return p.is_covered() ? seen : kGrey;
  };
  sums_.unlit += squared_distance(colour(a, a.colour), colour(b, b.colour));
  sums_.face_lit += squared_distance(colour(a, lit(a, a.face_normal, toward)),
                                     colour(b, lit(b, b.face_normal, toward)));
  sums_.vertex_lit += squared_distance(colour(a, lit(a, a.vertex_normal, toward)),
                                       colour(b, lit(b, b.vertex_normal, toward)));
  if (!a.is_covered() || !b.is_covered()) {
    ++sums_.silhouette;
    return;
  }
  ++both_;
  sums_.depth += (a.depth - b.depth) * (a.depth - b.depth);
  sums_.face_normal += angle(a.face_normal, b.face_normal);
  sums_.vertex_normal += angle(a.vertex_normal, b.vertex_normal);
}

void Comparison::add_texture(const Pixel& a, const Pixel& b) {
  ++same_;
  const double u = a.uv[0] - b.uv[0], v = a.uv[1] - b.uv[1];
  sums_.uv += std::min(u * u + v * v, kMaxUv * kMaxUv);
  sums_.stretch += std::pow(stretch_between(a, b), 2);
}

// As a power of two.
double Comparison::stretch_between(const Pixel& a, const Pixel& b) const {
  const TriangleStretch &x = original_.stretches[a.triangle], &y = other_.stretches[b.triangle];
  if (std::isinf(x.squared)) return 0;
  if (std::isinf(y.squared) || x.mirrored != y.mirrored) return kMaxStretch;
  return std::min(std::abs(std::log2(y.squared / x.squared)) / 2, kMaxStretch);
}

// Windows half over one another; those without a pixel of either mesh say nothing.
void Comparison::add_structure(const Picture& original, const Picture& other, const Point& toward) {
  constexpr Index kWindow = 8;
  constexpr double kLuminanceTerm = 0.01 * 0.01, kContrastTerm = 0.03 * 0.03;
  const auto luminances = [&](const Picture& picture) {
    std::vector<double> out;
    for (const Pixel& p : picture.pixels)
      out.push_back(luminance(p.is_covered() ? lit(p, p.vertex_normal, toward) : kGrey));
    return out;
  };
  const std::vector<double> x = luminances(original), y = luminances(other);
  const Index size = original.size;
  for (Index top = 0; top + kWindow <= size; top += kWindow / 2)
    for (Index left = 0; left + kWindow <= size; left += kWindow / 2) {
      double sx = 0, sy = 0, sxx = 0, syy = 0, sxy = 0;
      bool any = false;
      for (Index row = top; row < top + kWindow; ++row)
        for (Index column = left; column < left + kWindow; ++column) {
          const std::size_t i = std::size_t{row} * size + column;
          any |= original.pixels[i].is_covered() || other.pixels[i].is_covered();
          sx += x[i], sy += y[i];
          sxx += x[i] * x[i], syy += y[i] * y[i], sxy += x[i] * y[i];
        }
      if (!any) continue;
      constexpr double n = kWindow * kWindow;
      const double mx = sx / n, my = sy / n;
      const double vx = sxx / n - mx * mx, vy = syy / n - my * my, vxy = sxy / n - mx * my;
      const double ssim = (2 * mx * my + kLuminanceTerm) * (2 * vxy + kContrastTerm) /
                          ((mx * mx + my * my + kLuminanceTerm) * (vx + vy + kContrastTerm));
      sums_.structure += 1 - ssim;
      ++windows_;
    }
}

Appearance Comparison::result() const {
  const auto mean = [](double sum, std::size_t n) {
    return n > 0 ? sum / static_cast<double>(n) : 0;
  };
  return {.silhouette = mean(sums_.silhouette, covered_),
          .depth = std::sqrt(mean(sums_.depth, both_)),
          .face_normal = mean(sums_.face_normal, both_),
          .vertex_normal = mean(sums_.vertex_normal, both_),
          .unlit = std::sqrt(mean(sums_.unlit, either_)),
          .face_lit = std::sqrt(mean(sums_.face_lit, either_)),
          .vertex_lit = std::sqrt(mean(sums_.vertex_lit, either_)),
          .structure = mean(sums_.structure, windows_),
          .uv = std::sqrt(mean(sums_.uv, same_)),
          .stretch = std::sqrt(mean(sums_.stretch, same_))};
}

}  // namespace

Texture checker_texture(Index size, Index checks) {
  Texture out{size, size, {}};
  for (Index y = 0; y < size; ++y)
    for (Index x = 0; x < size; ++x) {
      const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(size);
      const float v = (static_cast<float>(y) + 0.5f) / static_cast<float>(size);
      const float check = (x * checks / size + y * checks / size) % 2 == 0 ? 1.f : 0.6f;
      out.texels.push_back({u * check, v * check, (1 - u) * check});
    }
  return out;
}

std::array<Camera, 12> icosahedron_cameras(const Point& centre, double radius) {
  std::array<Camera, 12> out;
  std::size_t i = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const double one : {-1.0, 1.0})
      for (const double golden : {-std::numbers::phi, std::numbers::phi}) {
        Point corner{};
        corner[axis] = one;
        corner[(axis + 1) % 3] = golden;
        // Parallel to no corner.
        const Point right = unit(cross({0.1, 1, 0.2}, corner));
        const Point toward = unit(corner);
        out[i++] = {right, cross(toward, right), toward, centre, radius};
      }
  return out;
}

Appearance compare_appearance(const RenderMesh& original, const RenderMesh& other,
                              std::span<const Texture> textures, std::span<const Camera> cameras,
                              Index size) {
  Comparison sum(original, other);
  for (const Camera& camera : cameras)
    sum.add(render(original, textures, camera, size), render(other, textures, camera, size),
            camera);
  return sum.result();
}

Stretch stretch(const RenderMesh& mesh) {
  Stretch out;
  double squares = 0, all = 0, counted = 0;
  for (const TriangleStretch& t : stretches_of(mesh)) {
    if (t.area == 0) continue;
    all += t.area;
    if (std::isinf(t.squared)) {
      out.collapsed += t.area;
      continue;
    }
    squares += t.squared * t.area;
    counted += t.area;
    out.maximum = std::max(out.maximum, t.maximum);
  }
  if (counted > 0) out.l2 = std::sqrt(squares / counted);
  if (all > 0) out.collapsed /= all;
  return out;
}

}  // namespace pstrips::test
