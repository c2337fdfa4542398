#include "formats/pstrip/payload/compact/octahedron.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace pstrips::inline formats {
namespace {

// Rounded down.
std::uint64_t square_root(std::uint64_t n) {
  auto root = static_cast<std::uint64_t>(std::sqrt(static_cast<double>(n)));
  while (root * root > n) --root;
  while ((root + 1) * (root + 1) <= n) ++root;
  return root;
}

std::int64_t with_sign_of(std::int64_t sign, std::int64_t size) { return sign < 0 ? -size : size; }

}  // namespace

Octahedron::Point Octahedron::placed(std::int64_t u, std::int64_t v) const {
  const std::int64_t most = reach_;
  u = std::clamp(u, -most, most);
  v = std::clamp(v, -most, most);
  if (std::abs(v) == most) u = std::abs(u);
  if (std::abs(u) == most) v = std::abs(v);
  return {static_cast<std::int32_t>(u), static_cast<std::int32_t>(v)};
}

Octahedron::Vector Octahedron::on_faces(Point p) const {
  const std::int64_t z = reach_ - std::abs(p.u) - std::abs(p.v);
  if (z >= 0) return {p.u, p.v, z};
  return {with_sign_of(p.u, reach_ - std::abs(p.v)), with_sign_of(p.v, reach_ - std::abs(p.u)), z};
}

Octahedron::Vector Octahedron::unit(Point p) const {
  Vector at = on_faces(p);
  std::int64_t square = 0;
  for (std::int64_t& c : at) {
    c *= std::int64_t{1} << (kMaxBits - bits_);
    square += c * c;
  }
  // In 2^-16 of what the components are counted in.
  const auto length =
      static_cast<std::int64_t>(square_root(static_cast<std::uint64_t>(square) << 32));
  for (std::int64_t& c : at) c = with_sign_of(c, ((std::abs(c) << 40) + length / 2) / length);
  return at;
}

Octahedron::Point Octahedron::near(const Vector& direction) const {
  const auto [x, y, z] = direction;
  const std::int64_t sum = std::abs(x) + std::abs(y) + std::abs(z);
  if (sum == 0) return {};
  const auto share = [&](std::int64_t c) {
    return with_sign_of(c, (2 * std::abs(c) * reach_ + sum) / (2 * sum));
  };
  const std::int64_t u = share(x), v = share(y);
  if (z >= 0) return placed(u, v);
  return placed(with_sign_of(x, reach_ - std::abs(v)), with_sign_of(y, reach_ - std::abs(u)));
}

Octahedron::Point Octahedron::turned(Point p) const {
  return placed(with_sign_of(p.u, reach_ - std::abs(p.v)),
                with_sign_of(p.v, reach_ - std::abs(p.u)));
}

bool Octahedron::is_below(Point p) const { return std::abs(p.u) + std::abs(p.v) > reach_; }

}  // namespace pstrips::inline formats
