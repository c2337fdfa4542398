#include "cli/option_groups.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <chrono>
#include <ostream>

#include "codecs/stripify/stripify.h"
#include "core/profile.h"

namespace pstrips::cli {

std::vector<std::string> split_list(std::string_view list) {
  std::vector<std::string> out;
  while (!list.empty()) {
    const std::size_t comma = std::min(list.find(','), list.size());
    if (comma > 0) out.emplace_back(list.substr(0, comma));
    list.remove_prefix(std::min(comma + 1, list.size()));
  }
  return out;
}

void FormatOption::add_to(CLI::App& app, const std::vector<std::string>& names) {
  app.add_option("--format", format, "How to print the report")
      ->check(CLI::IsMember(names))
      ->capture_default_str();
}

void LimitOptions::add_to(CLI::App& app) {
  const auto add = [&](const char* name, std::uint64_t& value, const char* what) {
    app.add_option(name, value, what)->capture_default_str()->group("Limits");
  };
  add("--max-vertices", limits.vertices, "Refuse files with more vertices");
  add("--max-wedges", limits.wedges, "Refuse files with more wedges");
  add("--max-corners", limits.corners, "Refuse files with more face corners or map entries");
  add("--max-meshes", limits.meshes, "Refuse files with more meshes, materials, images or nodes");
  add("--max-string", limits.string_bytes, "Refuse longer names and comments (bytes)");
  add("--max-memory", limits.memory_bytes,
      "Refuse models that need more memory to read or to encode (bytes)");
  app.add_option("--max-depth", limits.xml_depth, "Refuse deeper nesting in XML and JSON")
      ->capture_default_str()
      ->group("Limits");
  app.add_option("--threads", limits.threads,
                 "Threads to work with; 0 is one a core. The output does not depend on it")
      ->capture_default_str();
}

void LevelOptions::add_to(CLI::App& app) {
  auto* packets = app.add_option("--level,--packet", choice.packets,
                                 "Refine by this many packets; 0 is the base");
  auto* triangles = app.add_option("--triangles", choice.triangles,
                                   "Refine as far as there are at most this many triangles");
  auto* error = app.add_option("--error", choice.error,
                               "Refine until the error bound is at most this (model units)");
  packets->check(CLI::NonNegativeNumber)->excludes(triangles)->excludes(error);
  triangles->check(CLI::NonNegativeNumber)->excludes(error);
  error->check(CLI::NonNegativeNumber);
  for (auto* option : {packets, triangles, error}) option->group("Level of a progressive file");
}

std::function<bool()> stop_after(double seconds, std::shared_ptr<std::atomic<bool>> was_cut) {
  if (seconds <= 0) return {};
  return [=, start = std::chrono::steady_clock::now()]() {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    if (passed.count() > seconds) *was_cut = true;
    return was_cut->load();
  };
}

void StripOptionsGroup::add_to(CLI::App& app) {
  constexpr const char* kGroup = "Stripification";
  app.add_option("--goal", goal, "Fewest indices sent, or fewest strips")
      ->check(CLI::IsMember({"indices", "strips"}))
      ->capture_default_str()
      ->group(kGroup);
  app.add_option("--strip-effort", effort, "fast, high, max, or moves tried per triangle")
      ->capture_default_str()
      ->group(kGroup);
  app.add_option("--strip-price", price,
                 "Indices that a strip counts for; higher gives fewer strips")
      ->check(CLI::Range(0u, kMaxStripPrice))
      ->capture_default_str()
      ->group(kGroup);
  app.add_option("--strip-weight", weight, "What multi-path-weighted prefers")
      ->check(CLI::IsMember({"topological", "axis"}))
      ->capture_default_str()
      ->group(kGroup);
  app.add_option("--tunnel-length", tunnel_length, "Most dual edges of a tunnel; 0 is no tunnels")
      ->capture_default_str()
      ->group(kGroup);
  app.add_option("--tunnel-effort", tunnel_effort, "Steps of the search for tunnels, per triangle")
      ->capture_default_str()
      ->group(kGroup);
  app.add_option("--time-limit", time_limit,
                 "Cut the search after so many seconds, if only by a part of it; 0 is never")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str()
      ->group(kGroup);
}

Result<StripOptions> StripOptionsGroup::get() const {
  StripOptions out;
  out.goal = goal == "strips" ? StripGoal::strips : StripGoal::indices;
  out.strip_price = price;
  out.weight = weight == "axis" ? StripWeight::axis : StripWeight::topological;
  out.tunnel_length = tunnel_length;
  out.tunnel_effort = tunnel_effort;
  out.stop = stop_after(time_limit, was_cut);
  if (effort == "fast" || effort == "high" || effort == "max") {
    out.effort = effort == "fast" ? kEffortFast : effort == "high" ? kEffortHigh : kEffortMax;
    return out;
  }
  const char* end = effort.data() + effort.size();
  const auto [rest, code] = std::from_chars(effort.data(), end, out.effort);
  if (code != std::errc{} || rest != end)
    return fail(ErrorCode::bad_argument,
                "--strip-effort takes fast, high, max or a number: " + effort);
  return out;
}

void StripOptionsGroup::note_time_limit(const Streams& io) const {
  if (*was_cut && !io.quiet)
    io.err << fmt::format("pstrips: the time limit of {} s cut the stripification\n", time_limit);
}

void EncodeOptionsGroup::add_to(CLI::App& app) {
  stripping.add_to(app);
  std::vector<std::string> names;
  for (const NamedStripifier& s : stripifiers()) names.emplace_back(s.name);
  std::vector<std::string> profiles;
  for (const ProfileName& p : kProfiles) profiles.emplace_back(p.name);
  constexpr const char* kGroup = "Progressive output";
  app.add_option("--profile", profile, "Profile of the file")
      ->check(CLI::IsMember(profiles))
      ->capture_default_str()
      ->group(kGroup);
  app.add_option("--strips", strips, "Index-map encoding: wedges only, or offset differences too")
      ->check(CLI::IsMember({"naive", "offset"}))
      ->capture_default_str()
      ->group(kGroup);
  app.add_option("--stripifier", options.stripifier, "How triangles become strips")
      ->check(CLI::IsMember(names))
      ->capture_default_str()
      ->group(kGroup);
  app.add_option("--level-cost", options.level_cost,
                 "Indices that a step counts for which tears a strip at coarser levels")
      ->check(CLI::Range(0u, kMaxLevelCost))
      ->capture_default_str()
      ->group(kGroup);
  auto* share = app.add_option("--base", base, "Triangles of the base: N, or N% of the model")
                    ->capture_default_str()
                    ->group(kGroup);
  app.add_option("--base-error", base_error,
                 "Instead: how far base and model may be apart (two-sided, model units)")
      ->check(CLI::NonNegativeNumber)
      ->excludes(share)
      ->group(kGroup);
  app.add_option("--placement", placement,
                 "Vertices of the levels: a subset of the model's, or moved where they fit best")
      ->check(CLI::IsMember({"subset", "optimal"}))
      ->capture_default_str()
      ->group(kGroup);
  app.add_option("--metric", metric,
                 "What levels are nearest by: the faces that are left, or with qem all faces "
                 "ever replaced")
      ->check(CLI::IsMember({"qem", "memoryless"}))
      ->capture_default_str()
      ->group(kGroup);
  app.add_option("--attribute-weight", attribute_weights,
                 "NAME=WEIGHT, such as TEXCOORD_0=0.3: share of the model's diagonal that a full "
                 "swing of an attribute counts for; may be repeated")
      ->allow_extra_args(false)
      ->group(kGroup);
  app.add_flag("--keep-order", options.keep_order, "Keep the order of vertices, wedges and faces")
      ->group(kGroup);
}

namespace {

Result<AttributeWeight> parse_weight(const std::string& text) {
  const std::size_t equals = text.rfind('=');
  AttributeWeight out{text.substr(0, equals), 0};
  const char* end = text.data() + text.size();
  const char* number = equals == text.npos ? end : text.data() + equals + 1;
  const auto [rest, code] = std::from_chars(number, end, out.weight);
  if (code != std::errc{} || rest != end || out.semantic.empty() || !(out.weight >= 0) ||
      out.weight > 1e6)
    return fail(ErrorCode::bad_argument,
                "--attribute-weight takes NAME=WEIGHT with a weight from 0 to 1e6: " + text);
  return out;
}

}  // namespace

Result<EncodeOptions> EncodeOptionsGroup::get() const {
  EncodeOptions out = options;
  out.encoding = strips == "naive" ? MapEncoding::naive : MapEncoding::offset;
  const auto strip_options = stripping.get();
  if (!strip_options) return tl::unexpected(strip_options.error());
  out.strip_options = *strip_options;
  out.placement = placement == "optimal" ? Placement::optimal : Placement::subset;
  out.metric = metric == "memoryless" ? Metric::memoryless : Metric::qem;
  for (const std::string& text : attribute_weights) {
    auto weight = parse_weight(text);
    if (!weight) return tl::unexpected(weight.error());
    out.attribute_weights.push_back(std::move(weight).value());
  }
  if (base_error >= 0) {
    out.base_error = base_error;
    return out;
  }
  const bool share = base.ends_with('%');
  const char* end = base.data() + base.size() - (share ? 1 : 0);
  double number = 0;
  const auto [rest, code] = std::from_chars(base.data(), end, number);
  if (code != std::errc{} || rest != end || !(number >= 0) || (share && number > 100) ||
      (!share && number != static_cast<double>(static_cast<std::uint64_t>(std::min(number, 1e18)))))
    return fail(ErrorCode::bad_argument,
                "--base takes a number of triangles or a percentage: " + base);
  if (share)
    out.base_share = number / 100;
  else
    out.base_triangles = static_cast<std::uint64_t>(number);
  return out;
}

void TargetOption::add_to(CLI::App& app) {
  app.add_option("--to", to, "Format of the output, where its name does not say it")
      ->check(CLI::IsMember({"ply", "obj", "gltf", "glb", "pstrip", "pstripx", "pm"}));
}

Result<FileFormat> TargetOption::format_for(const std::string& path) const {
  if (!to.empty()) return *format_named(to);
  if (const auto format = format_of_path(path)) return *format;
  return fail(ErrorCode::bad_argument, "cannot tell the format from the name; use --to", kNoOffset,
              path);
}

}  // namespace pstrips::cli
