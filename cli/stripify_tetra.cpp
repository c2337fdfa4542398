#include "cli/stripify_tetra.h"

#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <ostream>

#include "cli/output_option.h"
#include "cli/report.h"
#include "cli/table.h"
#include "codecs/stripify/tetra_multi_path.h"
#include "converters/files.h"
#include "formats/medit/medit.h"

namespace pstrips::cli {
namespace {

struct Metrics {
  TetraStripStats stats;
  double milliseconds = 0;

  double per_strip() const {
    return stats.strips == 0
               ? 0
               : static_cast<double>(stats.tetrahedra) / static_cast<double>(stats.strips);
  }
};

void print_text(std::ostream& out, const Metrics& f, const TetraJob& job) {
  const TetraStripStats& s = f.stats;
  Table table({"", ""});
  table.add({"tetrahedra", grouped(s.tetrahedra)});
  table.add({"strips", grouped(s.strips)});
  table.add({"of one tetrahedron", grouped(s.singletons)});
  table.add({"tetrahedra a strip", fmt::format("{:.1f}", f.per_strip())});
  table.add({"longest", grouped(s.longest)});
  table.add({"vertices sent", grouped(s.entries)});
  table.add({"in sequence", grouped(s.in_sequence)});
  table.add({"milliseconds", fmt::format("{:.1f}", f.milliseconds)});
  out << escaped(job.input) << ": " << kTetraStripifier << "\n";
  table.print(out);
}

void print_json(std::ostream& out, const Metrics& f, const Error* error, const TetraJob& job) {
  using Json = nlohmann::ordered_json;
  const TetraStripStats& s = f.stats;
  Json json;
  json["schema"] = "pstrips-stripify-tetra-1";
  json["file"] = escaped(job.input);
  json["error"] = error ? json_of<Json>(*error) : Json();
  json["algorithm"] = kTetraStripifier;
  json["tetrahedra"] = s.tetrahedra;
  json["strips"] = s.strips;
  json["singletons"] = s.singletons;
  json["longest"] = s.longest;
  json["entries"] = s.entries;
  json["in_sequence"] = s.in_sequence;
  json["milliseconds"] = f.milliseconds;
  out << json.dump(2) << "\n";
}

}  // namespace

ExitCode stripify_tetra(const FileBytes& file, const TetraJob& job, const Streams& io) {
  const auto mesh = load_tetra_mesh(file, job.limits);
  if (!mesh) {
    if (job.json) print_json(io.out, {}, &mesh.error(), job);
    return report(io, mesh.error(), job.input);
  }
  const auto start = std::chrono::steady_clock::now();
  const TetraStrips strips =
      tetra_multi_path(mesh->tetrahedra, mesh->vertex_count(), job.strip_options);
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
  const std::string fault = find_tetra_strip_fault(mesh->tetrahedra, strips);
  if (!fault.empty()) return report(io, {ErrorCode::corrupt, fault}, job.input);
  if (!job.output.empty()) {
    const Bytes text = write_tetra_strips(strips);
    const auto written = write_files({{job.output, text}});
    if (!written) return report(io, written.error(), job.output);
    list_written(io, {{job.output, text.size()}});
  }
  const Metrics metrics{tetra_strip_stats(strips), time.count()};
  std::ostream& out = job.output == "-" ? io.err : io.out;
  if (job.json)
    print_json(out, metrics, nullptr, job);
  else
    print_text(out, metrics, job);
  return kOk;
}

}  // namespace pstrips::cli
