#include "converters/inspect.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/help.h"
#include "cli/option_groups.h"
#include "cli/part_table.h"
#include "cli/report.h"
#include "cli/table.h"
#include "codecs/triangulate/triangulate.h"
#include "converters/bounding_box.h"
#include "converters/files.h"
#include "formats/pstrip/container/chunks.h"

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
  Inspection metrics;
  PartTable parts;
  std::optional<MeshStatistics> statistics;  // of a plain model
  std::size_t meshes = 0, materials = 0, images = 0, nodes = 0;
  std::vector<std::string> attributes;
  std::vector<std::string> notes;  // of the reader
  BoundingBox box;
  bool complete = true;
  std::optional<Error> error;

  double bits_per_vertex(double of) const {
    return metrics.vertices ? 8 * of / static_cast<double>(metrics.vertices) : 0;
  }
};

std::string_view encoding_name(MapEncoding encoding) {
  switch (encoding) {
    case MapEncoding::naive:
      return "naive";
    case MapEncoding::offset:
      return "offset";
    case MapEncoding::triangles:
      return "triangles";
  }
  return "";
}

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

void add_strips(Report& report, const ProgressiveStrips& strips) {
  report.metrics = inspect(strips, report.parts.ends());
  report.meshes = strips.meshes.size();
  report.complete = strips.complete;
  report.profile = name_of(strips.profile);
  if (const auto model = decode(strips)) report.box = bounding_box(*model);
  add_scene(report, strips.scene);
  for (const ProgressiveMesh& mesh : strips.meshes) {
    report.strips_encoding = encoding_name(mesh.encoding);
    add_attribute(report, mesh.position);
    for (const Attribute& a : mesh.wedge_attributes) add_attribute(report, a);
    for (const Attribute& a : mesh.face_attribute_formats) add_attribute(report, a);
  }
}

void add_model(Report& report, const Model& model) {
  report.meshes = model.meshes.size();
  report.statistics.emplace();
  report.box = bounding_box(model);
  add_scene(report, model.scene);
  for (const Mesh& mesh : model.meshes) {
    report.metrics.vertices += mesh.vertex_count();
    report.metrics.wedges += mesh.wedge_count();
    report.metrics.faces += mesh.face_count();
    *report.statistics += mesh_statistics(mesh);
    report.metrics.triangles += triangulate(mesh).face.size();
    add_attribute(report, mesh.position);
    for (const Attribute& a : mesh.wedge_attributes) add_attribute(report, a);
    for (const Attribute& a : mesh.face_attributes) add_attribute(report, a);
  }
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
  if (format == FileFormat::pstrip)
    report.parts = PartTable(read_chunks(bytes->view()), options.limits.limits);
  auto file = load(*bytes, options.input,
                   {.limits = options.limits.limits, .allow_prefix = true, .text_options = {}});
  if (file) report.notes = file->notes;
  if (!file)
    report.error = file.error();
  else if (file->is_progressive())
    add_strips(report, std::get<ProgressiveStrips>(file->content));
  else
    add_model(report, std::get<Model>(file->content));
  return report;
}

void print_heading(std::ostream& out, const Report& r) {
  out << escaped(r.file) << ": " << r.format;
  if (!r.profile.empty())
    out << ", " << r.profile << " profile, "
        << (r.strips_encoding == encoding_name(MapEncoding::triangles) ? "derived"
                                                                       : r.strips_encoding)
        << " strips";
  if (!r.complete) out << ", ends early";
  out << "\n";
}

void print_totals(std::ostream& out, const Report& r) {
  const Inspection& m = r.metrics;
  Table table({"", ""});
  const auto add = [&](const char* label, std::uint64_t n) { table.add({label, grouped(n)}); };
  add("meshes", r.meshes);
  add("vertices", m.vertices);
  add("wedges", m.wedges);
  add("faces", m.faces);
  add("triangles", m.triangles);
  if (!m.levels.empty()) {
    add("strips", m.strips);
    add("index-map entries", m.map_entries);
    add("vsplits", m.vsplits);
    table.add({"map offsets a vsplit (u)", fmt::format("{:.2f}", m.places_per_vsplit)});
  }
  if (r.materials) add("materials", r.materials);
  if (r.images) add("images", r.images);
  if (r.nodes) add("nodes", r.nodes);
  add("bytes", r.bytes);
  table.add(
      {"bits per vertex", fmt::format("{:.1f}", r.bits_per_vertex(static_cast<double>(r.bytes)))});
  table.print(out);
}

void print_box(std::ostream& out, const BoundingBox& box) {
  if (box.is_empty()) return;
  constexpr std::array kAxes = {"x", "y", "z"};
  for (std::size_t axis = 0; axis < 3; ++axis)
    out << fmt::format("{} from {} to {}\n", kAxes[axis], four_digits(box.min[axis]),
                       four_digits(box.max[axis]));
  out << "diagonal " << four_digits(box.diagonal()) << "\n";
}

void print_levels(std::ostream& out, const Report& r) {
  Table levels(
      {"packet", "bytes", "vertices", "triangles", "strips", "sent", "error", "one-sided"});
  for (const InspectedLevel& l : r.metrics.levels)
    levels.add({std::to_string(l.packet), l.bytes_so_far ? grouped(l.bytes_so_far) : "-",
                grouped(l.vertices), grouped(l.triangles), grouped(l.strips),
                grouped(l.vertices_sent), four_digits(l.error), four_digits(l.one_sided_error)});
  out << "\n";
  levels.print(out);
  out << wrapped(fmt::format("bytes: of the file up to there; sent: vertices, to draw the strips; "
                             "errors: in model units, of which the diagonal has {}",
                             four_digits(r.box.diagonal())),
                 0, 0)
      << "\n";
}

void print_strip_lengths(std::ostream& out, const std::vector<std::uint64_t>& lengths) {
  const std::uint64_t most = *std::ranges::max_element(lengths);
  Table histogram({"entries a strip", "strips", ""});
  for (std::size_t bin = 0; bin < lengths.size(); ++bin)
    histogram.add({strip_length_bin(bin), grouped(lengths[bin]),
                   std::string(static_cast<std::size_t>(lengths[bin] * 40 / most), '#')});
  out << "\n";
  histogram.print(out);
}

void print_text(std::ostream& out, const Report& r) {
  print_heading(out, r);
  print_totals(out, r);
  print_box(out, r.box);
  if (r.statistics) print_mesh_statistics(out, *r.statistics, false);
  for (const std::string& a : r.attributes) out << "attribute " << escaped(a) << "\n";
  if (!r.parts.empty()) {
    out << "\n";
    r.parts.print(out, r.metrics);
  }
  if (!r.metrics.levels.empty()) print_levels(out, r);
  if (!r.metrics.strip_lengths.empty()) print_strip_lengths(out, r.metrics.strip_lengths);
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

Json box_json(const BoundingBox& box) {
  if (box.is_empty()) return nullptr;
  return {{"min", box.min}, {"max", box.max}, {"diagonal", box.diagonal()}};
}

Json parts_json(const Report& r) {
  Json json = Json::object();
  for (std::size_t g = 0; !r.parts.empty() && g < kPartGroups; ++g) {
    const double bits = r.parts.all()[g];
    json[std::string(name_of(static_cast<PartGroup>(g)).key)] = {
        {"bits", bits}, {"bytes", bits / 8}, {"bits_per_vertex", r.bits_per_vertex(bits / 8)}};
  }
  return json;
}

Json packet_json(const PartTable& parts, std::size_t packet) {
  if (packet >= parts.packets().size()) return nullptr;
  Json json = Json::object();
  for (std::size_t g = 0; g < kPartGroups; ++g)
    json[std::string(name_of(static_cast<PartGroup>(g)).key)] = parts.packets()[packet][g];
  return json;
}

Json levels_json(const Report& r) {
  Json json = Json::array();
  for (const InspectedLevel& l : r.metrics.levels) {
    json.push_back({{"packet", l.packet},
                    {"mesh", l.mesh},
                    {"bytes_so_far", l.bytes_so_far},
                    {"vertices", l.vertices},
                    {"triangles", l.triangles},
                    {"strips", l.strips},
                    {"vertices_sent", l.vertices_sent},
                    {"error", l.error},
                    {"one_sided_error", l.one_sided_error}});
    json.back()["bits"] = packet_json(r.parts, l.packet);
  }
  return json;
}

void add_counts(Json& json, const Report& r) {
  const Inspection& m = r.metrics;
  json["meshes"] = r.meshes;
  json["vertices"] = m.vertices;
  json["wedges"] = m.wedges;
  json["faces"] = m.faces;
  json["triangles"] = m.triangles;
  json["strips"] = m.strips;
  json["map_entries"] = m.map_entries;
  json["vsplits"] = m.vsplits;
  json["places_per_vsplit"] = m.places_per_vsplit;
  json["materials"] = r.materials;
  json["images"] = r.images;
  json["nodes"] = r.nodes;
}

void print_json(std::ostream& out, const Report& r) {
  Json json;
  json["schema"] = "pstrips-inspect-1";
  json["file"] = escaped(r.file);
  json["format"] = r.format;
  json["profile"] = r.profile;
  json["strips_encoding"] = r.strips_encoding;
  json["complete"] = r.complete && !r.error;
  json["error"] = r.error ? json_of<Json>(*r.error) : Json();
  add_counts(json, r);
  json["bounding_box"] = box_json(r.box);
  json["attributes"] = Json::array();
  for (const std::string& a : r.attributes) json["attributes"].push_back(escaped(a));
  json["survey"] = r.statistics ? statistics_json(*r.statistics) : Json();
  json["bytes"] = r.bytes;
  json["bits_per_vertex"] = r.bits_per_vertex(static_cast<double>(r.bytes));
  json["parts"] = parts_json(r);
  json["packets"] = levels_json(r);
  json["strip_lengths"] = Json::array();
  for (std::size_t bin = 0; bin < r.metrics.strip_lengths.size(); ++bin)
    json["strip_lengths"].push_back(
        {{"entries", strip_length_bin(bin)}, {"strips", r.metrics.strip_lengths[bin]}});
  out << json.dump(2) << "\n";
}

// A row a level; of a model, which has none, one row.
void print_csv(std::ostream& out, const Report& r) {
  const Inspection& m = r.metrics;
  if (r.statistics) {
    out << "file,format,bytes,meshes,vertices,wedges,faces,triangles,materials,images,nodes,"
           "min_x,min_y,min_z,max_x,max_y,max_z,diagonal\n"
        << fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_text(r.file), r.format,
                       r.bytes, r.meshes, m.vertices, m.wedges, m.faces, m.triangles, r.materials,
                       r.images, r.nodes, fmt::join(r.box.min, ","), fmt::join(r.box.max, ","),
                       r.box.diagonal());
    return;
  }
  out << "packet,mesh,bytes_so_far,vertices,triangles,strips,vertices_sent,error,one_sided_error\n";
  for (const InspectedLevel& l : m.levels)
    out << fmt::format("{},{},{},{},{},{},{},{},{}\n", l.packet, l.mesh, l.bytes_so_far, l.vertices,
                       l.triangles, l.strips, l.vertices_sent, l.error, l.one_sided_error);
}

ExitCode run(const Options& options, const Streams& io) {
  const Report inspected = make_report(options);
  note(io, options.input, inspected.notes);
  if (options.format.json()) print_json(io.out, inspected);
  if (inspected.error) return report(io, *inspected.error, options.input);
  if (options.format.csv())
    print_csv(io.out, inspected);
  else if (!options.format.json())
    print_text(io.out, inspected);
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
