#include "codecs/filter/display_strips.h"

#include <algorithm>

namespace pstrips::inline codecs {
namespace {

constexpr NamedFilter kFilters[] = {
    {"none", "[Kim04 §5]", Filter::none},
    {"stss", "[Kim04 §2.3]", Filter::stss},
    {"dtfs", "[Kim04 §4]", Filter::dtfs},
};

void start_strip(DisplayStrips& out) {
  if (!out.empty()) out.push_back(kRestart);
}

template <class VertexOf>
void append_degenerate_free(std::span<const Index> strip, VertexOf&& vertex_of,
                            DisplayStrips& out) {
  // The last valid triangle stands at entries last … last + 2. What was appended for it has its
  // order and, as to position within the display strip, its parity.
  constexpr std::size_t kNoTriangle = ~std::size_t{0};
  std::size_t last = kNoTriangle;
  if (strip.size() < 3) return;
  Index va = vertex_of(strip[0]), vb = vertex_of(strip[1]);
  for (std::size_t i = 0; i + 2 < strip.size(); ++i) {
    const Index d = strip[i], e = strip[i + 1], f = strip[i + 2];
    const Index vd = va, ve = vb, vf = vertex_of(f);
    va = ve;
    vb = vf;
    if (vd == ve || ve == vf || vd == vf) continue;
    if (last != kNoTriangle) {
      const Index b = strip[last + 1], c = strip[last + 2];
      const bool alternates = (i - last) % 2 == 1;
      last = i;
      if (alternates && b == d && c == e) {
        out.push_back(f);
        continue;
      }
      if (!alternates && b == e && c == d) {
        out.insert(out.end(), {b, f});
        continue;
      }
    }
    last = i;
    start_strip(out);
    if (i % 2 == 1) out.push_back(d);
    out.insert(out.end(), {d, e, f});
  }
}

void append_unfiltered(std::span<const Index> strip, DisplayStrips& out) {
  if (strip.size() < 3) return;
  start_strip(out);
  out.insert(out.end(), strip.begin(), strip.end());
}

void append_simple_scan(std::span<const Index> strip, DisplayStrips& out) {
  if (strip.size() < 3) return;
  const std::size_t before = out.size();
  start_strip(out);
  const std::size_t start = out.size();
  for (const Index entry : strip) {
    out.push_back(entry);
    const std::size_t n = out.size();
    if (n - start >= 4 && out[n - 4] == out[n - 2] && out[n - 3] == out[n - 1]) out.resize(n - 2);
  }
  if (out.size() - start < 3) out.resize(before);
}

}  // namespace

std::span<const NamedFilter> display_filters() { return kFilters; }

std::optional<Filter> find_display_filter(std::string_view name) {
  const auto* found = std::ranges::find(kFilters, name, &NamedFilter::name);
  return found == std::end(kFilters) ? std::nullopt : std::optional(found->filter);
}

void append_filtered(Filter filter, std::span<const Index> strip,
                     std::span<const Index> wedge_vertex, DisplayStrips& out) {
  switch (filter) {
    case Filter::none:
      return append_unfiltered(strip, out);
    case Filter::stss:
      return append_simple_scan(strip, out);
    case Filter::dtfs:
      if (wedge_vertex.empty())
        append_degenerate_free(
            strip, [](Index w) { return w; }, out);
      else
        append_degenerate_free(
            strip, [&](Index w) { return wedge_vertex[w]; }, out);
      return;
  }
}

DisplayStrips filter_strips(std::span<const Index> resolved, std::span<const Index> wedge_vertex,
                            Filter filter) {
  DisplayStrips out;
  while (!resolved.empty()) {
    const auto restart = std::find(resolved.begin(), resolved.end(), kRestart);
    const auto length = static_cast<std::size_t>(restart - resolved.begin());
    append_filtered(filter, resolved.first(length), wedge_vertex, out);
    resolved = resolved.subspan(std::min(length + 1, resolved.size()));
  }
  return out;
}

DisplayCost display_cost(std::span<const Index> display) {
  const auto restarts = static_cast<std::uint64_t>(std::ranges::count(display, kRestart));
  return {display.size() - restarts, restarts};
}

}  // namespace pstrips::inline codecs
