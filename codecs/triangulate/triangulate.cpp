#include "codecs/triangulate/triangulate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "codecs/triangulate/clip_ears.h"
#include "codecs/triangulate/plane.h"
#include "core/gather.h"
#include "core/point.h"

namespace pstrips::inline codecs {
namespace {

class PolygonCutter {
 public:
  PolygonCutter(const Mesh& mesh, Triangulation& out)
      : mesh_(mesh), positions_(positions_as_double(mesh)), out_(out) {}

  void cut(Index face) {
    face_ = face;
    const std::span<const Index> loop = mesh_.face(face);
    if (loop.size() < 3) return;
    if (loop.size() == 3) return add(loop[0], loop[1], loop[2]);
    loop_.assign(loop.begin(), loop.end());
    if (loop_.size() == 4) return cut_quad();
    points_.clear();
    for (const Index wedge : loop) points_.push_back(at(wedge));
    const std::vector<Point2> flat = on_best_plane(points_);
    if (flat.empty() || is_convex(flat)) return zigzag();
    for (const auto& [a, b, c] : clip_ears(flat)) add(loop_[a], loop_[b], loop_[c]);
  }

 private:
  Point at(Index wedge) const {
    const double* p = positions_.data() + std::size_t{3} * mesh_.vertex_of(wedge);
    return {p[0], p[1], p[2]};
  }
  void add(Index a, Index b, Index c) {
    const Index va = mesh_.vertex_of(a), vb = mesh_.vertex_of(b), vc = mesh_.vertex_of(c);
    if (va == vb || vb == vc || va == vc) return;
    out_.corners.insert(out_.corners.end(), {a, b, c});
    out_.face.push_back(face_);
  }
  // Newell's normal: twice the vector area, robust for bent and concave loops.
  Point newell() const {
    Point n{0, 0, 0};
    const Point origin = at(loop_[0]);
    for (std::size_t i = 1; i + 1 < loop_.size(); ++i) {
      const Point c = cross(at(loop_[i]) - origin, at(loop_[i + 1]) - origin);
      for (std::size_t k = 0; k < 3; ++k) n[k] += c[k];
    }
    return n;
  }
  /// Signed area of a triangle seen along the normal.
  double area(Index a, Index b, Index c) const {
    return dot(normal_, cross(at(b) - at(a), at(c) - at(a)));
  }
  // Strictly, and once around.
  static bool is_convex(std::span<const Point2> loop) {
    const std::size_t n = loop.size();
    std::size_t turns_back = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const Point2 &a = loop[i], &b = loop[(i + 1) % n], &c = loop[(i + 2) % n];
      if (orient(a, b, c) <= 0) return false;
      const auto is_left = [](const Point2& p, const Point2& q) {
        return p.x < q.x || (p.x == q.x && p.y < q.y);
      };
      if (is_left(b, a) && is_left(b, c)) ++turns_back;
    }
    return turns_back == 1;
  }
  void zigzag() {
    std::size_t low = 0, high = loop_.size() - 1;
    for (bool from_low = true; high - low >= 2; from_low = !from_low) {
      if (from_low) {
        add(loop_[low], loop_[low + 1], loop_[high]);
        ++low;
      } else {
        add(loop_[low], loop_[high - 1], loop_[high]);
        --high;
      }
    }
  }
  void cut_quad() {
    normal_ = newell();
    const auto [a, b, c, d] = std::array{loop_[0], loop_[1], loop_[2], loop_[3]};
    const double across_ac = std::min(area(a, b, c), area(a, c, d));
    const double across_bd = std::min(area(b, c, d), area(b, d, a));
    const Point ac = at(c) - at(a), bd = at(d) - at(b);
    // Both ways are fine for a convex quad; the shorter diagonal then.
    const bool both = across_ac > 0 && across_bd > 0;
    if (both ? dot(ac, ac) <= dot(bd, bd) : !(across_bd > across_ac)) {
      add(a, b, c);
      add(a, c, d);
    } else {
      add(b, c, d);
      add(b, d, a);
    }
  }
  const Mesh& mesh_;
  std::vector<double> positions_;
  Triangulation& out_;
  Index face_ = 0;
  std::vector<Index> loop_;
  std::vector<Point> points_;  // of the loop
  Point normal_{};
};

Triangulation triangles_only(const Mesh& mesh) {
  Triangulation out;
  out.corners.reserve(mesh.corners.size());
  out.face.reserve(mesh.face_count());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const std::span<const Index> t = mesh.face(f);
    const Index a = mesh.vertex_of(t[0]), b = mesh.vertex_of(t[1]), c = mesh.vertex_of(t[2]);
    if (a == b || b == c || a == c || mesh.groups[mesh.group_of(f)].kind != FaceKind::polygons)
      continue;
    out.corners.insert(out.corners.end(), t.begin(), t.end());
    out.face.push_back(f);
  }
  return out;
}

}  // namespace

Triangulation triangulate(const Mesh& mesh) {
  if (mesh.face_first.empty()) return triangles_only(mesh);
  Triangulation out;
  PolygonCutter cutter(mesh, out);
  for (Index f = 0; f < mesh.face_count(); ++f)
    if (mesh.groups[mesh.group_of(f)].kind == FaceKind::polygons) cutter.cut(f);
  return out;
}

Mesh with_triangles(const Mesh& mesh) {
  if (mesh.face_first.empty()) return mesh;
  const Triangulation triangles = triangulate(mesh);
  Mesh out = mesh;
  out.corners.clear();
  out.face_first.assign(1, 0);
  out.face_group.clear();
  std::vector<Index> from;
  const auto add = [&](std::span<const Index> face, Index f) {
    out.corners.insert(out.corners.end(), face.begin(), face.end());
    out.face_first.push_back(static_cast<Index>(out.corners.size()));
    out.face_group.push_back(mesh.group_of(f));
    from.push_back(f);
  };
  std::size_t t = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (t == triangles.face.size() || triangles.face[t] != f) add(mesh.face(f), f);
    for (; t < triangles.face.size() && triangles.face[t] == f; ++t)
      add(std::span(triangles.corners).subspan(3 * t, 3), f);
  }
  for (Attribute& a : out.face_attributes) a = gather(a, from);
  canonicalize(out);
  return out;
}

}  // namespace pstrips::inline codecs
