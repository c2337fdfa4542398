#include "converters/inspect.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/option_groups.h"
#include "cli/output.h"
#include "codecs/triangulate/triangulate.h"
#include "formats/pstrip/container/chunks.h"
#include "formats/pstrip/container/parts.h"

namespace pstrips::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string input;
  FormatOption format;
  LimitOptions limits;
};

// All there is to report; the fields a broken or plain file does not have stay empty.
struct Report {
  std::string file, format, profile, strips_encoding;
  std::uint64_t bytes = 0;
  Inspection figures;
  std::array<std::uint64_t, kPartGroups> part_bytes{};
  bool has_parts = false;
  std::optional<MeshStatistics> statistics;  // of a plain model
  std::size_t meshes = 0, materials = 0, images = 0, nodes = 0;
  std::vector<std::string> attributes;
  bool complete = true;
  std::optional<Error> error;

  double bits_per_vertex(std::uint64_t of) const {
    return figures.vertices ? 8.0 * static_cast<double>(of) / static_cast<double>(figures.vertices)
                            : 0;
  }
};

std::string describe(const Attribute& a) {
  return fmt::format("{} {}x{}{}", a.semantic, a.count, name_of(a.type),
                     a.normalized ? " normalized" : "");
}

void add_attribute(Report& report, const Attribute& a) {
  const std::string text = describe(a);
  if (std::ranges::find(report.attributes, text) == report.attributes.end())
    report.attributes.push_back(text);
}

void add_scene(Report& report, const Scene& scene) {
  report.materials = scene.materials.size();
  report.images = scene.images.size();
  report.nodes = scene.nodes.size();
}

void add_strips(Report& report, const ProgressiveStrips& strips,
                const std::vector<std::uint64_t>& ends) {
  report.figures = inspect(strips, ends);
  report.meshes = strips.meshes.size();
  report.complete = strips.complete;
  report.profile = name_of(strips.profile);
  add_scene(report, strips.scene);
  for (const ProgressiveMesh& mesh : strips.meshes) {
    report.strips_encoding = mesh.encoding == MapEncoding::naive ? "naive" : "offset";
    add_attribute(report, mesh.position);
    for (const Attribute& a : mesh.wedge_attributes) add_attribute(report, a);
    for (const Attribute& a : mesh.face_attribute_formats) add_attribute(report, a);
  }
}

void add_model(Report& report, const Model& model) {
  report.meshes = model.meshes.size();
  report.statistics.emplace();
  add_scene(report, model.scene);
  for (const Mesh& mesh : model.meshes) {
    report.figures.vertices += mesh.vertex_count();
    report.figures.wedges += mesh.wedge_count();
    report.figures.faces += mesh.face_count();
    *report.statistics += mesh_statistics(mesh);
    report.figures.triangles += triangulate(mesh).face.size();
    add_attribute(report, mesh.position);
    for (const Attribute& a : mesh.wedge_attributes) add_attribute(report, a);
    for (const Attribute& a : mesh.face_attributes) add_attribute(report, a);
  }
}

// Bytes by part, and where the last base and each packet end.
std::vector<std::uint64_t> add_chunks(Report& report, ByteView bytes, const Limits& limits) {
  const ChunkList list = read_chunks(bytes);
  std::vector<std::uint64_t> ends;
  std::uint64_t base_end = 0;
  for (const Chunk& chunk : list.chunks) {
    if (chunk.type == kBaseChunk) base_end = chunk.offset + chunk.bytes();
    if (chunk.type == kPacketChunk) ends.push_back(chunk.offset + chunk.bytes());
  }
  ends.insert(ends.begin(), base_end);
  for (const PartSpan& span : list_parts(list, limits))
    report.part_bytes[static_cast<std::size_t>(group_of(span.part))] += span.bytes;
  report.has_parts = true;
  return ends;
}

Report make_report(const Options& options) {
  Report report;
  report.file = options.input;
  auto bytes = read_file(options.input, options.limits.limits.memory_bytes);
  if (!bytes) {
    report.error = bytes.error();
    return report;
  }
  report.bytes = bytes->view().size();
  const auto format = detect_format(bytes->view(), options.input);
  if (format) report.format = name_of(*format);
  std::vector<std::uint64_t> ends;
  if (format == FileFormat::pstrip) ends = add_chunks(report, bytes->view(), options.limits.limits);
  auto file = load(*bytes, options.input,
                   {.limits = options.limits.limits, .allow_prefix = true, .text_options = {}});
  if (!file)
    report.error = file.error();
  else if (file->is_progressive())
    add_strips(report, std::get<ProgressiveStrips>(file->content), ends);
  else
    add_model(report, std::get<Model>(file->content));
  return report;
}

void print_totals(std::ostream& out, const Report& r) {
  const Inspection& f = r.figures;
  out << escaped(r.file) << ": " << r.format;
  if (!r.profile.empty())
    out << ", " << r.profile << " profile, " << r.strips_encoding << " strips";
  if (!r.complete) out << ", ends early";
  out << "\n";
  Table table({"", ""});
  const auto add = [&](const char* label, std::uint64_t n) { table.add({label, grouped(n)}); };
  add("meshes", r.meshes);
  add("vertices", f.vertices);
  add("wedges", f.wedges);
  add("faces", f.faces);
  add("triangles", f.triangles);
  if (!f.levels.empty()) {
    add("strips", f.strips);
    add("index-map entries", f.map_entries);
    add("vsplits", f.vsplits);
    table.add({"map offsets a vsplit (u)", fmt::format("{:.2f}", f.places_per_vsplit)});
  }
  if (r.materials) add("materials", r.materials);
  if (r.images) add("images", r.images);
  if (r.nodes) add("nodes", r.nodes);
  add("bytes", r.bytes);
  table.add({"bits per vertex", fmt::format("{:.1f}", r.bits_per_vertex(r.bytes))});
  table.print(out);
  if (r.statistics) print_mesh_statistics(out, *r.statistics, false);
  for (const std::string& a : r.attributes) out << "attribute " << escaped(a) << "\n";
}

void print_text(std::ostream& out, const Report& r) {
  print_totals(out, r);
  if (r.has_parts) {
    out << "\n";
    Table table({"part", "bytes", "bits per vertex", "% of file"});
    for (std::size_t g = 0; g < kPartGroups; ++g)
      table.add(
          {std::string(name_of(static_cast<PartGroup>(g)).label), grouped(r.part_bytes[g]),
           fmt::format("{:.2f}", r.bits_per_vertex(r.part_bytes[g])),
           fmt::format("{:.1f}", 100.0 * static_cast<double>(r.part_bytes[g]) /
                                     static_cast<double>(std::max<std::uint64_t>(r.bytes, 1)))});
    table.print(out);
  }
  if (r.figures.levels.empty()) return;
  out << "\n";
  Table levels({"packet", "bytes so far", "vertices", "triangles", "strips", "vertices sent",
                "error", "one-sided error"});
  for (const InspectedLevel& l : r.figures.levels)
    levels.add({std::to_string(l.packet), l.bytes_so_far ? grouped(l.bytes_so_far) : "-",
                grouped(l.vertices), grouped(l.triangles), grouped(l.strips),
                grouped(l.vertices_sent), figure(l.error), figure(l.one_sided_error)});
  levels.print(out);
  if (r.figures.strip_lengths.empty()) return;
  out << "\n";
  const std::uint64_t most = *std::ranges::max_element(r.figures.strip_lengths);
  Table histogram({"entries a strip", "strips", ""});
  for (std::size_t bin = 0; bin < r.figures.strip_lengths.size(); ++bin) {
    const std::uint64_t n = r.figures.strip_lengths[bin];
    histogram.add({strip_length_bin(bin), grouped(n),
                   std::string(static_cast<std::size_t>(n * 40 / most), '#')});
  }
  histogram.print(out);
}

Json statistics_json(const MeshStatistics& statistics) {
  Json json = Json::object();
  for (const MeshStatisticKind& kind : mesh_statistic_kinds()) {
    std::string key(kind.name);
    std::ranges::replace_if(
        key, [](char c) { return c == ' ' || c == '-'; }, '_');
    json[key] = statistics.*kind.count;
  }
  return json;
}

void print_json(std::ostream& out, const Report& r) {
  Json json;
  json["schema"] = "pstrips-inspect-1";
  json["file"] = escaped(r.file);
  json["format"] = r.format;
  json["profile"] = r.profile;
  json["strips_encoding"] = r.strips_encoding;
  json["complete"] = r.complete && !r.error;
  json["error"] = nullptr;
  if (r.error) json["error"] = json_of<Json>(*r.error);
  const Inspection& f = r.figures;
  json["meshes"] = r.meshes;
  json["vertices"] = f.vertices;
  json["wedges"] = f.wedges;
  json["faces"] = f.faces;
  json["triangles"] = f.triangles;
  json["strips"] = f.strips;
  json["map_entries"] = f.map_entries;
  json["vsplits"] = f.vsplits;
  json["places_per_vsplit"] = f.places_per_vsplit;
  json["materials"] = r.materials;
  json["images"] = r.images;
  json["nodes"] = r.nodes;
  json["attributes"] = Json::array();
  for (const std::string& a : r.attributes) json["attributes"].push_back(escaped(a));
  json["survey"] = r.statistics ? statistics_json(*r.statistics) : Json();
  json["bytes"] = r.bytes;
  json["bits_per_vertex"] = r.bits_per_vertex(r.bytes);
  json["parts"] = Json::object();
  if (r.has_parts)
    for (std::size_t g = 0; g < kPartGroups; ++g)
      json["parts"][std::string(name_of(static_cast<PartGroup>(g)).key)] = {
          {"bytes", r.part_bytes[g]}, {"bits_per_vertex", r.bits_per_vertex(r.part_bytes[g])}};
  json["packets"] = Json::array();
  for (const InspectedLevel& l : f.levels)
    json["packets"].push_back({{"packet", l.packet},
                               {"mesh", l.mesh},
                               {"bytes_so_far", l.bytes_so_far},
                               {"vertices", l.vertices},
                               {"triangles", l.triangles},
                               {"strips", l.strips},
                               {"vertices_sent", l.vertices_sent},
                               {"error", l.error},
                               {"one_sided_error", l.one_sided_error}});
  json["strip_lengths"] = Json::array();
  for (std::size_t bin = 0; bin < f.strip_lengths.size(); ++bin)
    json["strip_lengths"].push_back(
        {{"entries", strip_length_bin(bin)}, {"strips", f.strip_lengths[bin]}});
  out << json.dump(2) << "\n";
}

void print_csv(std::ostream& out, const Report& r) {
  out << "packet,mesh,bytes_so_far,vertices,triangles,strips,vertices_sent,error,one_sided_error\n";
  for (const InspectedLevel& l : r.figures.levels)
    out << fmt::format("{},{},{},{},{},{},{},{},{}\n", l.packet, l.mesh, l.bytes_so_far, l.vertices,
                       l.triangles, l.strips, l.vertices_sent, l.error, l.one_sided_error);
}

ExitCode run(const Options& options, const Streams& io) {
  const Report report = make_report(options);
  if (options.format.json()) print_json(io.out, report);
  if (report.error) return complain(io, *report.error, options.input);
  if (options.format.csv())
    print_csv(io.out, report);
  else if (!options.format.json())
    print_text(io.out, report);
  return kOk;
}

}  // namespace

Command add_inspect(CLI::App& root) {
  auto options = std::make_shared<Options>();
  CLI::App* app = root.add_subcommand("inspect", "Show what a file holds and what each part costs");
  app->add_option("input", options->input, "Model or progressive file; - is standard input")
      ->required();
  options->format.add_to(*app, {"text", "json", "csv"});
  options->limits.add_to(*app);
  return {app, [options](Streams io) { return run(*options, io); }};
}

}  // namespace pstrips::cli
