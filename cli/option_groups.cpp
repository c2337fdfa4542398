#include "cli/option_groups.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <limits>
#include <ostream>
#include <type_traits>

#include "cli/help.h"
#include "cli/number_options.h"
#include "codecs/stripify/stripify.h"
#include "converters/bounding_box.h"
#include "converters/position_grid.h"
#include "converters/scene_level.h"
#include "core/numbers.h"

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
  takes_one_of(app.add_option("--format", format, "How to print the report")->capture_default_str(),
               names);
}

void LimitOptions::add_to(CLI::App& app) {
  const auto add = [&](const char* name, auto& value, const char* what) {
    auto* option = app.add_option(name, value, what)->group(kLimitsGroup);
    option->default_str(count_word(value));
    takes_count(option, 0, std::numeric_limits<std::decay_t<decltype(value)>>::max());
  };
  add("--max-vertices", limits.vertices, "Refuse files with more vertices");
  add("--max-wedges", limits.wedges, "Refuse files with more wedges");
  add("--max-corners", limits.corners, "Refuse files with more face corners or map entries");
  add("--max-meshes", limits.meshes, "Refuse files with more meshes, materials, images or nodes");
  add("--max-string", limits.string_bytes, "Refuse longer names and comments (bytes)");
  add("--max-memory", limits.memory_bytes,
      "Refuse models that need more memory to read or to encode (bytes)");
  add("--max-depth", limits.xml_depth, "Refuse deeper nesting in XML and JSON");
  add("--threads", limits.threads,
      "Threads to work with; 0 is one a core. The output does not depend on it");
}

void LevelOptions::add_to(CLI::App& app) {
  auto* by_packets =
      app.add_option("--level,--packet", packets, "Refine by this many packets; 0 is the base");
  auto* by_triangles =
      app.add_option("--triangles", triangles,
                     "Refine as far as there are at most so many triangles, or so many "
                     "percent of the full model's");
  auto* by_error =
      app.add_option("--error", error,
                     "Refine until the error bound is at most this, in model units or in "
                     "percent of the model's diagonal");
  takes_count(by_packets);
  takes_count_or_share(by_triangles);
  takes_number_or_share(by_error);
  by_packets->excludes(by_triangles)->excludes(by_error);
  by_triangles->excludes(by_error);
  for (auto* option : {by_packets, by_triangles, by_error}) option->group(kLevelGroup);
}

void PlacingOption::add_to(CLI::App& app) {
  app.add_flag("--no-transforms", keeps_local,
               "Keep meshes where they stand in the input instead of where its nodes put them, in "
               "formats without nodes");
}

Result<void> PlacingOption::check(FileFormat target) const {
  if (!keeps_local || !holds(target, Feature::nodes)) return {};
  return fail(ErrorCode::bad_argument,
              fmt::format("--no-transforms does nothing for a {} file", name_of(target)));
}

namespace {

std::uint64_t triangles_of(const ProgressiveStrips& strips) {
  SceneLevel level(strips);
  for (const Packet& packet : strips.packets) level.add(packet);
  return level.triangles();
}

}  // namespace

Result<LevelChoice> LevelOptions::choice(const ProgressiveStrips& strips) const {
  LevelChoice out;
  if (!packets.empty()) {
    const std::uint64_t level = *parse_count(packets);
    if (level > strips.packets.size())
      return fail(ErrorCode::bad_argument, fmt::format("--level {}: the file has levels 0 to {}",
                                                       level, strips.packets.size()));
    out.packets = static_cast<std::int64_t>(level);
  }
  if (!triangles.empty()) {
    const Amount amount = *parse_amount(triangles);
    const double most =
        amount.is_share ? amount.number * static_cast<double>(triangles_of(strips)) : amount.number;
    out.triangles = static_cast<std::int64_t>(std::min(most, 1e18));
  }
  if (!error.empty()) {
    const Amount amount = *parse_amount(error);
    out.error = amount.number;
    if (!amount.is_share) return out;
    const auto model = decode(strips);
    if (!model) return tl::unexpected(model.error());
    out.error *= bounding_box(*model).diagonal();
  }
  return out;
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
  const auto add = [&](const char* group, CLI::Option* option) {
    members.push_back(option->capture_default_str()->group(group));
    return option;
  };
  takes_one_of(
      add(kStripsGroup, app.add_option("--goal", goal, "Fewest indices sent, or fewest strips")),
      {"indices", "strips"});
  add(kStripsGroup,
      app.add_option("--strip-effort", effort, "fast, high, max, or moves tried per triangle"))
      ->type_name("WORD|N");
  takes_number(add(kStripsGroup,
                   app.add_option("--time-limit", time_limit,
                                  "Cut the search after so many seconds, if only by a part of it; "
                                  "0 is never")));
  takes_count(add(kRareStripsGroup,
                  app.add_option("--strip-price", price,
                                 "Indices that a strip counts for; higher gives fewer strips")),
              0, kMaxStripPrice);
  takes_one_of(add(kRareStripsGroup,
                   app.add_option("--strip-weight", weight, "What multi-path-weighted prefers")),
               {"topological", "axis"});
  constexpr std::uint64_t kMax = std::numeric_limits<std::uint32_t>::max();
  takes_count(add(kRareStripsGroup, app.add_option("--tunnel-length", tunnel_length,
                                                   "Most dual edges of a tunnel; 0 is no tunnels")),
              0, kMax);
  takes_count(
      add(kRareStripsGroup, app.add_option("--tunnel-effort", tunnel_effort,
                                           "Steps of the search for tunnels, per triangle")),
      0, kMax);
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
  std::vector<std::string> names;
  for (const NamedStripifier& s : stripifiers()) names.emplace_back(s.name);
  const auto add = [&](const char* group, CLI::Option* option) {
    members.push_back(option->group(group));
    return option;
  };
  const auto add_of_strips = [&](const char* group, CLI::Option* option) {
    of_strips.push_back(add(group, option));
    return option;
  };
  add_profile(app);
  auto* share = add(kProgressiveGroup, app.add_option("--base", base,
                                                      "Triangles of the base, or percent of the "
                                                      "model's; compact files have 400 at most "
                                                      "unless told otherwise"));
  share->type_name("N|N%")->default_str("5%");
  takes_number(add(kProgressiveGroup,
                   app.add_option("--base-error", base_error,
                                  "Instead: how far base and model may be apart, both ways, in "
                                  "model units"))
                   ->excludes(share));
  takes_one_of(add(kProgressiveGroup,
                   app.add_option("--placement", placement,
                                  "Vertices of the levels: a subset of the model's, or moved where "
                                  "they fit best"))
                   ->capture_default_str(),
               {"subset", "optimal"});
  add(kProgressiveGroup,
      app.add_option("--weld", weld,
                     "Vertices that are one for levels and strips: those at one place, those at "
                     "most so far apart, or none but what the model says"))
      ->type_name("exact|none|X")
      ->capture_default_str();
  add(kProgressiveGroup, app.add_flag("--keep-order", options.keep_order,
                                      "Keep the order of vertices, wedges and faces"));
  takes_one_of(add_of_strips(kProgressiveGroup, app.add_option("--stripifier", options.stripifier,
                                                               "How triangles become strips"))
                   ->capture_default_str(),
               names);
  stripping.add_to(app);
  takes_one_of(
      add_of_strips(kRareProgressiveGroup,
                    app.add_option("--strips", strips,
                                   "Entries of the index map: wedges only, or offsets too"))
          ->capture_default_str(),
      {"naive", "offset"});
  takes_one_of(add(kRareProgressiveGroup,
                   app.add_option("--metric", metric,
                                  "What levels are nearest by: the faces that are left, or with "
                                  "qem all faces ever replaced"))
                   ->capture_default_str(),
               {"qem", "memoryless"});
  add(kRareProgressiveGroup,
      app.add_option("--attribute-weight", attribute_weights,
                     "NAME=WEIGHT, such as TEXCOORD_0=0.3: share of the model's diagonal that a "
                     "full swing of an attribute counts for; may be repeated"))
      ->allow_extra_args(false)
      ->type_name("NAME=X");
  takes_count(
      add_of_strips(kRareProgressiveGroup,
                    app.add_option("--level-cost", options.level_cost,
                                   "Indices that a step counts for which tears a strip at coarser "
                                   "levels"))
          ->capture_default_str(),
      0, kMaxLevelCost);
}

void EncodeOptionsGroup::add_profile(CLI::App& app) {
  std::vector<std::string> profiles;
  for (const ProfileName& p : kProfiles) profiles.emplace_back(p.name);
  const auto add = [&](CLI::Option* option) {
    members.push_back(option->group(kProgressiveGroup));
    return option;
  };
  takes_one_of(add(app.add_option("--profile", profile,
                                  "How geometry is coded: as arrays with their strips, or compact, "
                                  "with strips that are made anew where they are drawn"))
                   ->default_str("plain"),
               profiles);
  auto* bits = add(app.add_option("--position-bits", options.position_bits,
                                  "Compact: move positions to a grid of 2^N steps that all meshes "
                                  "share, 8 to 24"));
  takes_count(bits, kMinPositionBits, kMaxPositionBits);
  auto* exact = add(app.add_flag("--lossless", lossless,
                                 "Compact: keep every number bit for bit; so it is without the "
                                 "options for bits"));
  exact->excludes(bits);
  of_compact = {bits, exact};
  const auto add_bits = [&](const char* name, unsigned& number, unsigned most, const char* what) {
    auto* option = add(app.add_option(name, number, what));
    takes_count(option, AttributeBits::kMin, most);
    exact->excludes(option);
    of_compact.push_back(option);
  };
  AttributeBits& of = options.attribute_bits;
  add_bits("--normal-bits", of.normal, AttributeBits::kMaxDirection,
           "Compact: normals and tangents as points of a square of 2^N - 1 steps, 4 to 16");
  add_bits("--uv-bits", of.texture, AttributeBits::kMax,
           "Compact: texture coordinates as 2^N steps or a few more that are a power of two, "
           "4 to 23");
  add_bits("--color-bits", of.color, AttributeBits::kMax, "Compact: colours likewise");
  add_bits("--attribute-bits", of.other, AttributeBits::kMax,
           "Compact: other attributes likewise, such as WEIGHTS_0");
  auto* by = add(app.add_option("--order", order,
                                "Compact: coarsen by error alone, or while hardly anybody sees "
                                "which vertex goes by bits as well"));
  takes_one_of(by->capture_default_str(), {"error", "bits"});
  auto* how = add(app.add_option("--effort", effort,
                                 "Compact: quick to decode, or smaller and several times slower"));
  takes_one_of(how->capture_default_str(), {"fast", "small"});
  of_compact.insert(of_compact.end(), {by, how});
}

std::string EncodeOptionsGroup::first_given() const {
  const std::string first = cli::first_given(members);
  return first.empty() ? cli::first_given(stripping.members) : first;
}

std::string first_given(const std::vector<const CLI::Option*>& options) {
  const auto given =
      std::ranges::find_if(options, [](const CLI::Option* option) { return option->count() > 0; });
  return given == options.end() ? "" : "--" + (*given)->get_lnames().front();
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

Result<std::optional<double>> parse_weld(const std::string& text) {
  if (text == "exact") return 0.0;
  if (text == "none") return std::nullopt;
  double distance = -1;
  if (!parse_number(std::string_view(text), distance) || !(distance >= 0) || std::isinf(distance))
    return fail(ErrorCode::bad_argument,
                "--weld takes exact, none or a distance in model units: " + text);
  return distance;
}

Result<void> does_nothing(const std::string& option, const char* why) {
  return fail(ErrorCode::bad_argument, option + " does nothing for " + why);
}

}  // namespace

Result<void> EncodeOptionsGroup::check_profile(Profile wanted) const {
  if (wanted == Profile::plain) {
    const std::string first = cli::first_given(of_compact);
    if (first.empty()) return {};
    return does_nothing(first, "the plain profile");
  }
  std::string first = cli::first_given(of_strips);
  if (first.empty()) first = cli::first_given(stripping.members);
  if (first.empty()) return {};
  return does_nothing(first, "the compact profile, whose strips are made where they are drawn");
}

Result<EncodeOptions> EncodeOptionsGroup::get() const {
  EncodeOptions out = options;
  if (profile) out.profile = profile_named(*profile).value_or(Profile::plain);
  if (const auto fits = check_profile(out.profile); !fits) return tl::unexpected(fits.error());
  out.encoding = strips == "naive" ? MapEncoding::naive : MapEncoding::offset;
  const auto strip_options = stripping.get();
  if (!strip_options) return tl::unexpected(strip_options.error());
  out.strip_options = *strip_options;
  out.placement = placement == "optimal" ? Placement::optimal : Placement::subset;
  out.order = order == "bits" ? CollapseOrder::bits : CollapseOrder::error;
  const auto distance = parse_weld(weld);
  if (!distance) return tl::unexpected(distance.error());
  out.weld = *distance;
  out.effort = effort == "small" ? Effort::small : Effort::fast;
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
  if (!base) return out;
  const auto count = parse_count(*base);
  const auto amount = parse_amount(*base);
  if (count)
    out.base_triangles = *count;
  else if (amount && amount->is_share && amount->number <= 1)
    out.base_share = amount->number;
  else
    return fail(ErrorCode::bad_argument,
                "--base takes a number of triangles or a percentage: " + *base);
  return out;
}

}  // namespace pstrips::cli
