#include "codecs/triangulate/predicates.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

// Expansions need each operation rounded on its own: this file is compiled with
// -ffp-contract=off.

namespace pstrips::inline codecs::predicates {
namespace {

/// The sum of `size` doubles in ascending order of magnitude that do not overlap, none of them 0.
/// Arithmetic on it is exact as long as nothing over- or underflows. [Shewchuk97 §2]
template <int capacity>
struct Expansion {
  std::array<double, capacity> term;  // left uninitialized: 1,536 of them at most
  int size = 0;

  Expansion() {}  // NOLINT: = default would zero the terms wherever {} is written
  explicit Expansion(double value) { append(value); }

  void append(double value) {
    if (value != 0) term[static_cast<std::size_t>(size++)] = value;
  }
  double operator[](int i) const { return term[static_cast<std::size_t>(i)]; }
  int sign() const { return size == 0 ? 0 : (*this)[size - 1] > 0 ? 1 : -1; }
};

struct Rounded {
  double value, error;  // value + error is exact
};

Rounded two_sum(double a, double b) {  // [Shewchuk97 theorem 7]
  const double value = a + b;
  const double b_virtual = value - a, a_virtual = value - b_virtual;
  return {value, (a - a_virtual) + (b - b_virtual)};
}

Rounded fast_two_sum(double a, double b) {  // |a| >= |b| [Shewchuk97 theorem 6]
  const double value = a + b;
  return {value, b - (value - a)};
}

Rounded split(double a) {  // halves of 26 bits [Shewchuk97 theorem 17]
  const double c = (0x1p27 + 1) * a;
  const double high = c - (c - a);
  return {high, a - high};
}

Rounded two_product(double a, double b) {  // [Shewchuk97 theorem 18]
  const double value = a * b;
  const auto [ah, al] = split(a);
  const auto [bh, bl] = split(b);
  return {value, al * bl - (((value - ah * bh) - al * bh) - ah * bl)};
}

template <int n, int m>
Expansion<n + m> operator+(const Expansion<n>& e, const Expansion<m>& f) {
  Expansion<n + m> out;  // merged by magnitude, carrying what is not settled [Shewchuk97 fig. 8]
  int i = 0, j = 0;
  const auto next = [&] {
    if (j == f.size || (i < e.size && std::abs(e[i]) < std::abs(f[j]))) return e[i++];
    return f[j++];
  };
  if (e.size + f.size == 0) return out;
  double sum = next();
  for (bool first = true; i < e.size || j < f.size; first = false) {
    const double term = next();
    const auto [value, error] = first ? fast_two_sum(term, sum) : two_sum(sum, term);
    out.append(error);
    sum = value;
  }
  out.append(sum);
  return out;
}

template <int n>
Expansion<n> operator-(Expansion<n> e) {
  for (int i = 0; i < e.size; ++i)
    e.term[static_cast<std::size_t>(i)] = -e.term[static_cast<std::size_t>(i)];
  return e;
}

template <int n, int m>
Expansion<n + m> operator-(const Expansion<n>& e, const Expansion<m>& f) {
  return e + -f;
}

template <int n>
Expansion<2 * n> scaled(const Expansion<n>& e, double factor) {  // [Shewchuk97 fig. 13]
  Expansion<2 * n> out;
  if (e.size == 0) return out;
  auto [sum, rest] = two_product(e[0], factor);
  out.append(rest);
  for (int i = 1; i < e.size; ++i) {
    const auto [product, product_error] = two_product(e[i], factor);
    const auto [low, low_error] = two_sum(sum, product_error);
    out.append(low_error);
    const auto [high, high_error] = fast_two_sum(product, low);
    out.append(high_error);
    sum = high;
  }
  out.append(sum);
  return out;
}

template <int n, int m>
Expansion<2 * n * m> operator*(const Expansion<n>& e, const Expansion<m>& f) {
  Expansion<2 * n * m> out;
  for (int i = 0; i < f.size; ++i) {
    const auto sum = out + scaled(e, f[i]);
    out.size = sum.size;  // fits: there are at most 2 n terms more for each term of f
    std::copy_n(sum.term.begin(), sum.size, out.term.begin());
  }
  return out;
}

/// A whole number of any size: sign and magnitude, the least digit first, the last one not 0.
class Integer {
 public:
  Integer() = default;
  /// value / 2^-1074. Precondition: value is finite.
  explicit Integer(double value) : negative_(std::signbit(value)) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    const auto exponent = static_cast<unsigned>(bits >> 52 & 0x7ff);
    std::uint64_t mantissa = bits & 0xf'ffff'ffff'ffff;
    if (exponent != 0) mantissa |= std::uint64_t{1} << 52;
    const unsigned shift = exponent == 0 ? 0 : exponent - 1;
    digits_.resize(shift / 32);
    unsigned __int128 rest = static_cast<unsigned __int128>(mantissa) << shift % 32;
    for (; rest != 0; rest >>= 32) digits_.push_back(static_cast<std::uint32_t>(rest));
    trim();
  }

  int sign() const { return digits_.empty() ? 0 : negative_ ? -1 : 1; }

  friend Integer operator+(const Integer& a, const Integer& b) {
    if (a.negative_ == b.negative_) return add(a, b, a.negative_);
    return is_less(a, b) ? subtract(b, a, b.negative_) : subtract(a, b, a.negative_);
  }
  friend Integer operator-(const Integer& a, Integer b) {
    b.negative_ = !b.negative_;
    return a + b;
  }
  friend Integer operator*(const Integer& a, const Integer& b) {
    Integer out;
    out.negative_ = a.negative_ != b.negative_;
    out.digits_.resize(a.digits_.size() + b.digits_.size());
    for (std::size_t i = 0; i < a.digits_.size(); ++i) {
      std::uint64_t carry = 0;
      for (std::size_t j = 0; j < b.digits_.size(); ++j) {
        carry += std::uint64_t{a.digits_[i]} * b.digits_[j] + out.digits_[i + j];
        out.digits_[i + j] = static_cast<std::uint32_t>(carry);
        carry >>= 32;
      }
      out.digits_[i + b.digits_.size()] = static_cast<std::uint32_t>(carry);
    }
    out.trim();
    return out;
  }

 private:
  std::uint64_t digit(std::size_t i) const { return i < digits_.size() ? digits_[i] : 0; }
  void trim() {
    while (!digits_.empty() && digits_.back() == 0) digits_.pop_back();
  }

  // On magnitudes.
  static bool is_less(const Integer& a, const Integer& b) {
    if (a.digits_.size() != b.digits_.size()) return a.digits_.size() < b.digits_.size();
    return std::lexicographical_compare(a.digits_.rbegin(), a.digits_.rend(), b.digits_.rbegin(),
                                        b.digits_.rend());
  }
  static Integer add(const Integer& a, const Integer& b, bool negative) {
    Integer out;
    out.negative_ = negative;
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < std::max(a.digits_.size(), b.digits_.size()) || carry; ++i) {
      carry += a.digit(i) + b.digit(i);
      out.digits_.push_back(static_cast<std::uint32_t>(carry));
      carry >>= 32;
    }
    return out;
  }
  static Integer subtract(const Integer& a, const Integer& b, bool negative) {  // a >= b
    Integer out;
    out.negative_ = negative;
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < a.digits_.size(); ++i) {
      const std::uint64_t difference = a.digit(i) - b.digit(i) - borrow;
      out.digits_.push_back(static_cast<std::uint32_t>(difference));
      borrow = difference >> 63;
    }
    out.trim();
    return out;
  }

  bool negative_ = false;
  std::vector<std::uint32_t> digits_;
};

template <class Number>
int orient_sign(const Point2& a, const Point2& b, const Point2& c) {
  const Number cx(c.x), cy(c.y);
  const auto ax = Number(a.x) - cx, ay = Number(a.y) - cy;
  const auto bx = Number(b.x) - cx, by = Number(b.y) - cy;
  return (ax * by - ay * bx).sign();
}

template <class Number>
int in_circle_sign(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  const Number dx(d.x), dy(d.y);
  const auto ax = Number(a.x) - dx, ay = Number(a.y) - dy;
  const auto bx = Number(b.x) - dx, by = Number(b.y) - dy;
  const auto cx = Number(c.x) - dx, cy = Number(c.y) - dy;
  const auto minors_a = (ax * ax + ay * ay) * (bx * cy - cx * by);
  const auto minors_b = (bx * bx + by * by) * (cx * ay - ax * cy);
  const auto minors_c = (cx * cx + cy * cy) * (ax * by - bx * ay);
  return ((minors_a + minors_b) + minors_c).sign();
}

// So that a product of four differences stays between 2^-1074 and 2^1024, the last bits of its
// terms and the factor of split() included.
bool suits_expansions(double coordinate) {
  const double magnitude = std::abs(coordinate);
  return magnitude == 0 || (magnitude >= 0x1p-200 && magnitude <= 0x1p240);
}
template <class... Points>
bool suit_expansions(const Points&... points) {
  return ((suits_expansions(points.x) && suits_expansions(points.y)) && ...);
}

}  // namespace

int orient_exact(const Point2& a, const Point2& b, const Point2& c) {
  return suit_expansions(a, b, c) ? orient_sign<Expansion<1>>(a, b, c)
                                  : orient_sign<Integer>(a, b, c);
}

int in_circle_exact(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  return suit_expansions(a, b, c, d) ? in_circle_sign<Expansion<1>>(a, b, c, d)
                                     : in_circle_sign<Integer>(a, b, c, d);
}

}  // namespace pstrips::inline codecs::predicates
