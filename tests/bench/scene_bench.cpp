// What a scene of 100 meshes is worth at each length of its file: packets interleaved by what a
// viewer sees, by object-space error, and mesh after mesh. CSV on standard output; with a file
// name, an SVG plot of the largest error there.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "converters/encode.h"
#include "tests/support/scenes.h"

namespace pstrips {
namespace {

constexpr int kSteps = 50, kRowEvery = 5;

struct Order {
  const char* name;
  const char* color;
  std::vector<test::ScenePoint> points;
};

// As if every mesh stood there unscaled.
ProgressiveStrips by_object_error(Model model) {
  Scene scene = std::exchange(model.scene, {});
  ProgressiveStrips out = encode(model, {.packet_min = 24}).value();
  out.scene = std::move(scene);
  return out;
}

std::string plot(const std::vector<Order>& orders) {
  constexpr double kWidth = 640, kHeight = 400, kDecades = 5;
  const double top = orders.back().points.front().max;
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-60 -20 {} {}\" "
      "font-family=\"sans-serif\" "
      "font-size=\"12\">\n<rect width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"gray\"/>\n",
      kWidth + 80, kHeight + 70, kWidth, kHeight);
  for (int decade = 0; decade <= kDecades; ++decade)
    out += fmt::format("<text x=\"-8\" y=\"{}\" text-anchor=\"end\">{:.0e}</text>\n",
                       kHeight * decade / kDecades + 4, top * std::pow(10, -decade));
  out += fmt::format(
      "<text x=\"0\" y=\"{}\">largest scaled error over the share of the packets' "
      "bytes</text>\n",
      kHeight + 18);
  double legend = 0;
  for (const Order& order : orders) {
    out += fmt::format("<text x=\"{}\" y=\"{}\" fill=\"{}\">{}</text>\n", legend, kHeight + 36,
                       order.color, order.name);
    legend += 200;
    out += fmt::format("<polyline fill=\"none\" stroke=\"{}\" points=\"", order.color);
    for (const test::ScenePoint& p : order.points) {
      const double decades = p.max > 0 ? std::log10(top / p.max) : kDecades;
      out += fmt::format("{:.1f},{:.1f} ", kWidth * p.share,
                         kHeight * std::min(decades, kDecades) / kDecades);
    }
    out += "\"/>\n";
  }
  return out + "</svg>\n";
}

void run(const char* svg) {
  const Model model = test::scene_of_tori(100);
  const ProgressiveStrips ours = encode(model, {.packet_min = 24}).value();
  const std::vector<Order> orders = {
      {"scaled error", "#06c", test::error_over_bytes(ours, kSteps)},
      {"object error", "#c60", test::error_over_bytes(by_object_error(model), kSteps)},
      {"mesh after mesh", "#666", test::error_over_bytes(test::mesh_after_mesh(ours), kSteps)}};
  fmt::print("share of bytes");
  for (const Order& o : orders) fmt::print(",{0} max,{0} sum", o.name);
  fmt::print("\n");
  for (int step = kRowEvery - 1; step < kSteps; step += kRowEvery) {
    const auto row = static_cast<std::size_t>(step);
    fmt::print("{:.2f}", orders[0].points[row].share);
    for (const Order& o : orders)
      fmt::print(",{:.3g},{:.3g}", o.points[row].max, o.points[row].sum);
    fmt::print("\n");
  }
  if (svg) std::ofstream(svg) << plot(orders);
}

}  // namespace
}  // namespace pstrips

int main(int argc, char** argv) { pstrips::run(argc > 1 ? argv[1] : nullptr); }
