#include "cli/bits_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

#include "cli/report.h"
#include "cli/table.h"

namespace pstrips::cli {
namespace {

// Of all meshes together.
struct Quantized {
  unsigned bits = 0, meshes = 0, kept = 0;
  double error = 0;
  std::string why_kept;  // the first time
};

std::map<std::string, Quantized> quantized(const std::vector<SimplifyReport>& meshes) {
  std::map<std::string, Quantized> out;
  for (const SimplifyReport& mesh : meshes)
    for (const QuantizedAttribute& a : mesh.quantized) {
      Quantized& all = out[a.semantic];
      all.bits = a.bits;
      all.error = std::max(all.error, a.error);
      ++all.meshes;
      if (a.kept.empty()) continue;
      ++all.kept;
      if (all.why_kept.empty()) all.why_kept = a.kept;
    }
  return out;
}

bool is_direction(const std::string& semantic) {
  return semantic == "NORMAL" || semantic == "TANGENT";
}

void report_attributes(const Streams& io, const std::vector<SimplifyReport>& meshes) {
  for (const auto& [semantic, q] : quantized(meshes)) {
    if (q.kept < q.meshes)
      io.err << fmt::format("pstrips: {} {} by at most {:.3g}{} for {} bits\n", escaped(semantic),
                            is_direction(semantic) ? "turned" : "changed", q.error,
                            is_direction(semantic) ? " degrees" : "", q.bits);
    if (q.kept == 0) continue;
    io.err << fmt::format("pstrips: {} stays as it is{}: it {}\n", escaped(semantic),
                          q.meshes > 1 ? fmt::format(" in {} of {} meshes", q.kept, q.meshes) : "",
                          q.why_kept);
  }
}

}  // namespace

void report_bits(const Streams& io, const EncodeOptions& options,
                 const std::vector<SimplifyReport>& meshes, std::uint64_t below,
                 std::uint64_t bytes) {
  if (io.quiet) return;
  if (options.position_bits > 0) {
    double moved = 0;
    for (const SimplifyReport& r : meshes) moved = std::max(moved, r.moved);
    io.err << fmt::format("pstrips: positions moved by at most {:.3g} to a grid of {} bits\n",
                          moved, options.position_bits);
  }
  report_attributes(io, meshes);
  if (options.position_bits > 0 || options.attribute_bits.any() || below == 0) return;
  io.err << fmt::format(
      "pstrips: lossless: {} of {} bytes are for the bits below 12 or 13 of each number; about so "
      "much --position-bits 12 --normal-bits 12 --uv-bits 12 and the like would save\n",
      grouped(below), grouped(bytes));
}

}  // namespace pstrips::cli
