#include "converters/compare.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/option_groups.h"
#include "cli/output.h"

namespace pstrips::cli {
namespace {

struct Options {
  std::string a, b;
  std::size_t samples = 200'000;
  FormatOption format;
  LevelOptions level;
  LimitOptions limits;
};

std::string_view name_of(Likeness likeness) {
  switch (likeness) {
    case Likeness::exact:
      return "exact";
    case Likeness::reordered:
      return "reordered";
    case Likeness::different:
      return "different";
  }
  return {};
}

void print_text(std::ostream& out, const Comparison& c) {
  switch (c.likeness) {
    case Likeness::exact:
      out << "exact: same vertices, wedges and faces in the same order\n";
      break;
    case Likeness::reordered:
      out << "reordered: same vertices, wedges and faces in another order\n";
      break;
    case Likeness::different:
      out << "different\n";
      break;
  }
  if (c.likeness != Likeness::different) return;
  for (const std::string& d : c.differences) out << "  " << escaped(d) << "\n";
  for (const AttributeDifference& a : c.attributes)
    out << "  " << escaped(a.semantic) << " differs by up to " << figure(a.largest) << "\n";
  out << "  Hausdorff distance " << figure(c.hausdorff) << ", RMS " << figure(c.rms)
      << " (of the bounding-box diagonal)\n";
}

// Why there is no comparison, and of which file.
struct Refusal {
  std::string file;
  Error error;
};

void print_json(std::ostream& out, const Comparison& c, const Refusal* refusal,
                const Options& options) {
  using Json = nlohmann::ordered_json;
  Json json;
  json["schema"] = "pstrips-compare-1";
  json["a"] = escaped(options.a);
  json["b"] = escaped(options.b);
  json["error"] = nullptr;
  json["result"] = nullptr;
  json["hausdorff"] = nullptr;
  json["rms"] = nullptr;
  if (refusal) {
    json["error"] = json_of<Json>(refusal->error);
    json["error"]["file"] = escaped(refusal->file);
  } else {
    json["result"] = name_of(c.likeness);
    json["hausdorff"] = c.hausdorff;
    json["rms"] = c.rms;
  }
  json["scenes_equal"] = c.scenes_equal;
  json["differences"] = Json::array();
  for (const std::string& d : c.differences) json["differences"].push_back(escaped(d));
  json["attributes"] = Json::array();
  for (const AttributeDifference& a : c.attributes)
    json["attributes"].push_back({{"semantic", escaped(a.semantic)}, {"largest", a.largest}});
  out << json.dump(2) << "\n";
}

Result<Model> open_model(const std::string& path, const Options& options) {
  // A text record is compared in the order in which it stands.
  auto file = load(path, {.limits = options.limits.limits,
                          .allow_prefix = false,
                          .text_options = {.keep_order = true}});
  if (!file) return tl::unexpected(file.error());
  return std::move(*file).model(options.level.choice);
}

ExitCode run(const Options& options, const Streams& io) {
  Model models[2];
  for (int i = 0; i < 2; ++i) {
    const std::string& path = i == 0 ? options.a : options.b;
    auto model = open_model(path, options);
    if (!model) {
      const Refusal refusal{path, model.error()};
      if (options.format.json()) print_json(io.out, {}, &refusal, options);
      return complain(io, refusal.error, path);
    }
    models[i] = std::move(model).value();
  }
  const Comparison c = compare(models[0], models[1], options.samples);
  if (options.format.json())
    print_json(io.out, c, nullptr, options);
  else
    print_text(io.out, c);
  return c.likeness == Likeness::different ? kDifference : kOk;
}

}  // namespace

Command add_compare(CLI::App& root) {
  auto options = std::make_shared<Options>();
  CLI::App* app =
      root.add_subcommand("compare", "Say whether two models are the same, or how far apart");
  app->add_option("a", options->a, "A model or progressive file")->required();
  app->add_option("b", options->b, "Another, in any format")->required();
  app->add_option("--samples", options->samples, "Points on each surface for distances")
      ->check(CLI::Range(std::size_t{1}, std::size_t{100'000'000}))
      ->capture_default_str();
  options->format.add_to(*app, {"text", "json"});
  options->level.add_to(*app);
  options->limits.add_to(*app);
  return {app, [options](Streams io) { return run(*options, io); }};
}

}  // namespace pstrips::cli
