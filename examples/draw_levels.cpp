// Draws the levels of a progressive file while it arrives, side by side in one picture.
//
//   draw_levels FILE.pstrip OUT.png
//
// Each panel is a level: what could be shown after so many bytes. Every strip has its colour.
// Meshes stand where their own coordinates put them; nodes of a scene do not move them.

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <span>
#include <vector>

#include "pstrips/decoder.h"
#include "pstrips/mesh.h"
#include "pstrips/strips.h"

namespace {

using pstrips::Index;
using Point = std::array<double, 3>;

struct Triangle {
  std::array<Point, 3> corners;
  std::size_t strip;  // which of the level's display strips it is of
};

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// The positions of a level as an attribute, whatever their type.
pstrips::Attribute positions_of(const pstrips::Level& level) {
  const pstrips::Attribute& format = level.mesh().position;
  const pstrips::ByteView bytes = level.positions();
  return {.semantic = format.semantic,
          .type = format.type,
          .count = format.count,
          .normalized = format.normalized,
          .data = pstrips::Bytes(bytes.begin(), bytes.end())};
}

Point point(const pstrips::Attribute& positions, Index vertex) {
  Point out{};
  for (std::size_t c = 0; c < std::min<std::size_t>(positions.count, 3); ++c)
    out[c] = pstrips::component(positions, vertex, c);
  return out;
}

// The triangles that the display strips of a mesh show.
void append_triangles(const pstrips::DisplayLevel& shown, std::vector<Triangle>& out) {
  const pstrips::Level& level = shown.level();
  const pstrips::Attribute positions = positions_of(level);
  pstrips::DisplayStrips strips;  // wedges, strips parted by kRestart
  shown.append_display(strips);
  const auto vertex_of = [&](Index wedge) { return level.vertex_of(wedge); };
  const auto corner = [&](Index wedge) { return point(positions, vertex_of(wedge)); };
  std::size_t first = 0;
  for (std::size_t strip = 0; first < strips.size(); ++strip) {
    const std::size_t end =
        static_cast<std::size_t>(std::find(strips.begin() + static_cast<std::ptrdiff_t>(first),
                                           strips.end(), pstrips::kRestart) -
                                 strips.begin());
    pstrips::for_each_triangle(std::span<const Index>(strips).subspan(first, end - first),
                               vertex_of, [&](Index a, Index b, Index c) {
                                 out.push_back({{corner(a), corner(b), corner(c)}, strip});
                               });
    first = end + 1;
  }
}

// Panels from left to right, a pixel three bytes.
class Picture {
 public:
  void add_panel(const std::vector<Triangle>& triangles);
  std::vector<unsigned char> png() const;

 private:
  static constexpr int kSide = 320;
  static constexpr std::size_t kPanelBytes = std::size_t{3} * kSide * kSide;
  using Screen = std::array<double, 3>;  // pixels, and how near

  void fit(const std::vector<Triangle>& triangles);
  Screen project(const Point& p) const;
  void draw(const Triangle& triangle, std::vector<double>& nearest);
  void shade(const Triangle& triangle, unsigned char* pixel) const;

  Point center_{};
  double scale_ = 0;  // 0: no panel yet
  std::vector<unsigned char> panels_;
};

// From above the front, turned a little to the side.
Picture::Screen Picture::project(const Point& p) const {
  const Point d = minus(p, center_);
  const double turn = 0.5, tilt = 0.35;
  const double x = std::cos(turn) * d[0] + std::sin(turn) * d[2];
  const double z = std::cos(turn) * d[2] - std::sin(turn) * d[0];
  const double y = std::cos(tilt) * d[1] - std::sin(tilt) * z;
  return {kSide / 2.0 + scale_ * x, kSide / 2.0 - scale_ * y,
          std::sin(tilt) * d[1] + std::cos(tilt) * z};
}

void Picture::fit(const std::vector<Triangle>& triangles) {
  Point low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (const Triangle& triangle : triangles)
    for (const Point& p : triangle.corners)
      for (std::size_t c = 0; c < 3; ++c) {
        low[c] = std::min(low[c], p[c]);
        high[c] = std::max(high[c], p[c]);
      }
  for (std::size_t c = 0; c < 3; ++c) center_[c] = (low[c] + high[c]) / 2;
  const Point size = minus(high, low);
  const double diagonal = std::hypot(size[0], size[1], size[2]);
  scale_ = std::isfinite(diagonal) && diagonal > 0 ? kSide / diagonal : 1;
}

void Picture::shade(const Triangle& triangle, unsigned char* pixel) const {
  const auto& [a, b, c] = triangle.corners;
  const Point n = cross(minus(b, a), minus(c, a));
  const double length = std::hypot(n[0], n[1], n[2]);
  const double light = length > 0 ? std::abs(0.4 * n[0] + 0.6 * n[1] + 0.7 * n[2]) / length : 0;
  for (int channel = 0; channel < 3; ++channel) {
    // Hues a golden angle apart are far from one another.
    const double hue = 2.4 * static_cast<double>(triangle.strip) + 2.1 * channel;
    pixel[channel] = static_cast<unsigned char>((0.3 + 0.65 * light) * (185 + 60 * std::cos(hue)));
  }
}

void Picture::draw(const Triangle& triangle, std::vector<double>& nearest) {
  const Screen a = project(triangle.corners[0]), b = project(triangle.corners[1]),
               c = project(triangle.corners[2]);
  const double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  if (!(std::abs(area) > 0) || !std::isfinite(area)) return;
  const auto bound = [](double x) { return static_cast<int>(std::clamp(x, 0.0, double{kSide})); };
  unsigned char* panel = panels_.data() + (panels_.size() - kPanelBytes);
  for (int y = bound(std::min({a[1], b[1], c[1]})); y < bound(std::max({a[1], b[1], c[1]}) + 1);
       ++y)
    for (int x = bound(std::min({a[0], b[0], c[0]})); x < bound(std::max({a[0], b[0], c[0]}) + 1);
         ++x) {
      const double px = x + 0.5, py = y + 0.5;
      const double u = ((b[0] - px) * (c[1] - py) - (b[1] - py) * (c[0] - px)) / area;
      const double v = ((c[0] - px) * (a[1] - py) - (c[1] - py) * (a[0] - px)) / area;
      const double w = 1 - u - v;
      const double near = u * a[2] + v * b[2] + w * c[2];
      const std::size_t at = static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x);
      if (u < 0 || v < 0 || w < 0 || near <= nearest[at]) continue;
      nearest[at] = near;
      shade(triangle, panel + 3 * at);
    }
}

void Picture::add_panel(const std::vector<Triangle>& triangles) {
  if (scale_ == 0) fit(triangles);
  panels_.resize(panels_.size() + kPanelBytes, 250);
  std::vector<double> nearest(std::size_t{kSide} * kSide, -std::numeric_limits<double>::infinity());
  for (const Triangle& triangle : triangles) draw(triangle, nearest);
}

void append_u32(std::vector<unsigned char>& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8)
    out.push_back(static_cast<unsigned char>(value >> shift));
}

void append_chunk(std::vector<unsigned char>& out, const char* type,
                  const std::vector<unsigned char>& data) {
  append_u32(out, static_cast<std::uint32_t>(data.size()));
  const std::size_t checked = out.size();
  out.insert(out.end(), type, type + 4);
  out.insert(out.end(), data.begin(), data.end());
  append_u32(out, static_cast<std::uint32_t>(
                      crc32(0, out.data() + checked, static_cast<uInt>(out.size() - checked))));
}

std::vector<unsigned char> Picture::png() const {
  const std::size_t panels = panels_.size() / kPanelBytes;
  std::vector<unsigned char> rows;
  for (std::size_t y = 0; y < kSide; ++y) {
    rows.push_back(0);  // not filtered
    for (std::size_t panel = 0; panel < panels; ++panel) {
      const unsigned char* row = panels_.data() + panel * kPanelBytes + 3 * y * kSide;
      rows.insert(rows.end(), row, row + std::size_t{3} * kSide);
    }
  }
  uLongf packed_bytes = compressBound(rows.size());
  std::vector<unsigned char> packed(packed_bytes), header;
  compress(packed.data(), &packed_bytes, rows.data(), rows.size());
  packed.resize(packed_bytes);
  append_u32(header, static_cast<std::uint32_t>(panels * kSide));
  append_u32(header, kSide);
  header.insert(header.end(), {8, 2, 0, 0, 0});  // 8 bits, red green blue
  std::vector<unsigned char> out{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  append_chunk(out, "IHDR", header);
  append_chunk(out, "IDAT", packed);
  append_chunk(out, "IEND", {});
  return out;
}

// A panel for the base, for each level of four times the triangles, and for the last.
class Viewer {
 public:
  void draw(const pstrips::StreamDecoder& decoder) {
    if (drawn_ == 0 || decoder.totals().triangles >= 4 * drawn_) draw_panel(decoder);
  }
  void draw_last(const pstrips::StreamDecoder& decoder) {
    if (decoder.changes() != drawn_changes_) draw_panel(decoder);
  }
  const Picture& picture() const { return picture_; }

 private:
  void draw_panel(const pstrips::StreamDecoder& decoder) {
    const pstrips::StreamDecoder::Totals totals = decoder.totals();
    drawn_ = totals.triangles;
    drawn_changes_ = decoder.changes();
    std::vector<Triangle> triangles;
    for (Index i = 0; i < decoder.strips().meshes.size(); ++i)
      append_triangles(decoder.mesh(i), triangles);
    picture_.add_panel(triangles);
    std::printf("%10llu bytes: %8zu triangles in %7llu strips, error at most %g\n",
                static_cast<unsigned long long>(decoder.bytes_taken()), triangles.size(),
                static_cast<unsigned long long>(totals.strips), totals.error);
  }

  std::uint64_t drawn_ = 0;
  std::size_t drawn_changes_ = 0;
  Picture picture_;
};

int report(const pstrips::Error& error) {
  std::fprintf(stderr, "draw_levels: %s\n", error.message.c_str());
  return 1;
}

int draw_levels(std::FILE* file, std::FILE* out) {
  std::array<std::byte, 64> slice;
  Viewer viewer;
  pstrips::StreamDecoder decoder;
  while (const std::size_t arrived = std::fread(slice.data(), 1, slice.size(), file)) {
    if (auto fed = decoder.feed(std::span(slice).first(arrived)); !fed) return report(fed.error());
    if (decoder.update()) viewer.draw(decoder);
  }
  if (const auto error = decoder.end()) return report(*error);
  viewer.draw_last(decoder);
  const std::vector<unsigned char> png = viewer.picture().png();
  return std::fwrite(png.data(), 1, png.size(), out) == png.size() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: draw_levels FILE.pstrip OUT.png\n");
    return 2;
  }
  std::FILE* file = std::fopen(argv[1], "rb");
  std::FILE* out = file ? std::fopen(argv[2], "wb") : nullptr;
  if (!out) {
    std::perror(file ? argv[2] : argv[1]);
    return 2;
  }
  const int status = draw_levels(file, out);
  std::fclose(file);
  return std::fclose(out) == 0 ? status : 1;
}
