#include "tests/support/tetra_meshes.h"

#include <algorithm>
#include <map>

#include "codecs/stripify/random.h"

namespace pstrips::test {
namespace {

using Whole = __int128;
using Vector = std::array<std::int64_t, 3>;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Whole determinant(const Vector& a, const Vector& b, const Vector& c) {
  const auto minor = [&](std::size_t i, std::size_t j) {
    return static_cast<Whole>(b[i]) * c[j] - static_cast<Whole>(b[j]) * c[i];
  };
  return a[0] * minor(1, 2) + a[1] * minor(2, 0) + a[2] * minor(0, 1);
}
Whole square(const Vector& a) {
  return static_cast<Whole>(a[0]) * a[0] + static_cast<Whole>(a[1]) * a[1] +
         static_cast<Whole>(a[2]) * a[2];
}

class Bowyer {
 public:
  explicit Bowyer(std::vector<Vector> points) : points_(std::move(points)) {
    const auto first = static_cast<Index>(points_.size());
    constexpr std::int64_t kFar = 1 << 23;
    points_.insert(points_.end(),
                   {{-kFar, -kFar, -kFar}, {kFar, -kFar, -kFar}, {0, kFar, -kFar}, {0, 0, kFar}});
    tetrahedra_.push_back({first, first + 1, first + 2, first + 3});
    for (Index p = 0; p < first; ++p) insert(p);
    std::erase_if(tetrahedra_, [&](const Tetra& t) { return std::ranges::max(t) >= first; });
  }
  std::vector<Tetra> take() { return std::move(tetrahedra_); }

 private:
  bool is_in_sphere(const Tetra& t, Index p) const {
    std::array<Vector, 4> v;
    for (std::size_t i = 0; i < 4; ++i) v[i] = minus(points_[t[i]], points_[p]);
    const Whole value = square(v[0]) * determinant(v[1], v[2], v[3]) -
                        square(v[1]) * determinant(v[0], v[2], v[3]) +
                        square(v[2]) * determinant(v[0], v[1], v[3]) -
                        square(v[3]) * determinant(v[0], v[1], v[2]);
    return value > 0;
  }

  void insert(Index p) {
    std::map<std::array<Index, 3>, std::array<Index, 3>> border;  // sorted face: as it is wound
    const auto meet = [&](const std::array<Index, 3>& face) {
      std::array<Index, 3> key = face;
      std::ranges::sort(key);
      if (!border.emplace(key, face).second) border.erase(key);
    };
    std::erase_if(tetrahedra_, [&](const Tetra& t) {
      if (!is_in_sphere(t, p)) return false;
      const auto [a, b, c, d] = t;
      for (const auto& face : {std::array{b, c, d}, {a, d, c}, {a, b, d}, {a, c, b}}) meet(face);
      return true;
    });
    for (const auto& [key, face] : border) tetrahedra_.push_back({p, face[0], face[1], face[2]});
  }

  std::vector<Vector> points_;
  std::vector<Tetra> tetrahedra_;
};

}  // namespace

TetraMesh delaunay_tetrahedra(std::uint32_t seed, Index points) {
  Random random(seed);
  std::vector<Vector> at(points);
  TetraMesh mesh;
  for (Vector& p : at)
    for (std::int64_t& x : p) {
      x = static_cast<std::int64_t>(random.below(1 << 19)) - (1 << 18);
      mesh.positions.push_back(static_cast<double>(x));
    }
  for (const Tetra& t : Bowyer(std::move(at)).take())
    mesh.tetrahedra.insert(mesh.tetrahedra.end(), t.begin(), t.end());
  return mesh;
}

TetraMesh random_tetrahedra(std::uint32_t seed, Index vertices, Index tetrahedra) {
  Random random(seed);
  TetraMesh mesh;
  mesh.positions.resize(std::size_t{3} * vertices);
  for (double& x : mesh.positions) x = random.below(1000);
  mesh.tetrahedra.resize(std::size_t{4} * tetrahedra);
  for (Index& v : mesh.tetrahedra) v = random.below(vertices);
  return mesh;
}

}  // namespace pstrips::test
