#include "converters/compare.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/number_options.h"
#include "cli/option_groups.h"
#include "cli/progress_bar.h"
#include "cli/report.h"
#include "cli/table.h"
#include "converters/files.h"

namespace pstrips::cli {
namespace {

struct Options {
  std::string a, b;
  std::size_t samples = 200'000;
  FormatOption format;
  LevelOptions level;
  LimitOptions limits;
};

std::string_view name_of(Equivalence equivalence) {
  switch (equivalence) {
    case Equivalence::exact:
      return "exact";
    case Equivalence::reordered:
      return "reordered";
    case Equivalence::different:
      return "different";
  }
  return {};
}

void print_text(std::ostream& out, const Comparison& c) {
  switch (c.equivalence) {
    case Equivalence::exact:
      out << "exact: same vertices, wedges and faces in the same order\n";
      break;
    case Equivalence::reordered:
      out << "reordered: same vertices, wedges and faces in another order\n";
      break;
    case Equivalence::different:
      out << "different\n";
      break;
  }
  if (c.equivalence != Equivalence::different) return;
  for (const std::string& d : c.differences) out << "  " << escaped(d) << "\n";
  for (const AttributeDifference& a : c.attributes)
    out << "  " << escaped(a.semantic) << " differs by up to " << four_digits(a.largest) << "\n";
  out << "  Hausdorff distance " << four_digits(c.hausdorff) << ", RMS " << four_digits(c.rms)
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
    json["result"] = name_of(c.equivalence);
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

struct Opened {
  Model model;
  bool has_levels = false;
};

Result<Opened> open_model(const std::string& path, const Options& options) {
  // A text record is compared in the order in which it stands.
  auto file = load(path, {.limits = options.limits.limits,
                          .allow_prefix = false,
                          .text_options = {.keep_order = true}});
  if (!file) return tl::unexpected(file.error());
  Opened out{.model = {}, .has_levels = file->is_progressive()};
  LevelChoice choice;
  if (out.has_levels) {
    const auto chosen = options.level.choice(std::get<ProgressiveStrips>(file->content));
    if (!chosen) return tl::unexpected(chosen.error());
    choice = *chosen;
  }
  auto model = std::move(*file).model(choice);
  if (!model) return tl::unexpected(model.error());
  out.model = std::move(model).value();
  return out;
}

ExitCode run(const Options& options, const Streams& io) {
  ProgressBar bar(io);
  std::vector<Opened> opened;
  for (const std::string& path : {options.a, options.b}) {
    bar.show("read", 0.2 * static_cast<double>(opened.size()));
    auto one = open_model(path, options);
    if (!one) {
      bar.clear();
      const Refusal refusal{path, one.error()};
      if (options.format.json()) print_json(io.out, {}, &refusal, options);
      return report(io, refusal.error, path);
    }
    opened.push_back(std::move(one).value());
  }
  if (options.level.given() && !opened[0].has_levels && !opened[1].has_levels) {
    bar.clear();
    return report(io, {ErrorCode::bad_argument, "a level does nothing: neither file has levels"});
  }
  bar.show("compare", 0.4);
  const Comparison c = compare(opened[0].model, opened[1].model, options.samples);
  bar.clear();
  if (options.format.json())
    print_json(io.out, c, nullptr, options);
  else
    print_text(io.out, c);
  return c.equivalence == Equivalence::different ? kDifference : kOk;
}

}  // namespace

Command add_compare(CLI::App& root) {
  auto options = std::make_shared<Options>();
  CLI::App* app =
      root.add_subcommand("compare", "Say whether two models are the same, or how far apart");
  app->add_option("a", options->a, "A model or progressive file")->required();
  app->add_option("b", options->b, "Another, in any format")->required();
  takes_count(app->add_option("--samples", options->samples, "Points on each surface for distances")
                  ->capture_default_str(),
              1, 100'000'000);
  options->format.add_to(*app, {"text", "json"});
  options->level.add_to(*app);
  options->limits.add_to(*app);
  return {app, [options](Streams io) { return run(*options, io); }};
}

}  // namespace pstrips::cli
