#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/command.h"
#include "codecs/stripify/stripify.h"
#include "converters/decode.h"
#include "converters/encode.h"
#include "converters/file_formats.h"
#include "core/limits.h"
#include "core/profile.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace pstrips::cli {

/// "a,,b" as a and b: an option's list.
std::vector<std::string> split_list(std::string_view list);

/// --format, one of the names given
struct FormatOption {
  std::string format = "text";
  void add_to(CLI::App& app, const std::vector<std::string>& names);
  bool json() const { return format == "json"; }
  bool csv() const { return format == "csv"; }
  bool md() const { return format == "md"; }
};

/// --max-vertices, --max-wedges, --max-corners, --max-meshes, --max-string, --max-memory,
/// --max-depth, and --threads
struct LimitOptions {
  Limits limits;
  void add_to(CLI::App& app);
};

/// --level (--packet), --triangles, --error: how far to refine a progressive file.
struct LevelOptions {
  std::string packets, triangles, error;  ///< as written, checked; empty: not given
  void add_to(CLI::App& app);
  bool given() const { return !packets.empty() || !triangles.empty() || !error.empty(); }
  /// What they come to for a file: shares are of its triangles and of its diagonal.
  ///
  /// errors  bad_argument for a level that the file does not have; as decode()
  Result<LevelChoice> choice(const ProgressiveStrips& strips) const;
};

/// --no-transforms: meshes stay where they stand in the file.
struct PlacingOption {
  bool keeps_local = false;
  void add_to(CLI::App& app);
  bool transforms() const { return !keeps_local; }
  /// errors  bad_argument for a format that has nodes, where the option does nothing
  Result<void> check(FileFormat target) const;
};

/// True from `seconds` after the call on, and then notes it in `*was_cut`; empty for 0 seconds.
std::function<bool()> stop_after(double seconds, std::shared_ptr<std::atomic<bool>> was_cut);

/// --goal, --strip-effort, --strip-price, --strip-weight, --tunnel-length, --tunnel-effort,
/// --time-limit: how hard the stripifier tries, and for what.
struct StripOptionsGroup {
  std::string goal = "indices";
  std::string effort = "fast";
  std::uint32_t price = 3;
  std::string weight = "topological";
  std::uint32_t tunnel_length = StripOptions{}.tunnel_length;
  std::uint32_t tunnel_effort = StripOptions{}.tunnel_effort;
  double time_limit = 0;  ///< seconds; 0: none
  /// By the time limit.
  std::shared_ptr<std::atomic<bool>> was_cut = std::make_shared<std::atomic<bool>>(false);
  std::vector<const CLI::Option*> members;
  void add_to(CLI::App& app);
  /// The time limit runs from here on. errors  bad_argument
  Result<StripOptions> get() const;
  /// Says so when the time limit cut the work: the result then depends on the machine.
  void note_time_limit(const Streams& io) const;
};

/// The options above and --profile, --position-bits, --lossless, --order, --effort, --strips,
/// --stripifier, --level-cost, --base, --base-error, --placement, --metric, --attribute-weight,
/// --weld, --keep-order
struct EncodeOptionsGroup {
  EncodeOptions options;
  std::string placement = "subset";
  std::string metric = "memoryless";
  std::vector<std::string> attribute_weights;  ///< NAME=WEIGHT
  std::string strips = "offset";
  std::optional<std::string> base;
  double base_error = -1;
  std::string weld = "exact";  ///< or none, or a distance
  std::optional<std::string> profile;
  bool lossless = false;
  std::string order = "error", effort = "fast";
  StripOptionsGroup stripping;
  std::vector<const CLI::Option*> members;  ///< without those of `stripping`
  /// Of those, what only one profile has a use for.
  std::vector<const CLI::Option*> of_strips, of_compact;
  void add_to(CLI::App& app);
  /// Combines what was parsed. errors: bad_argument, also for options that the profile ignores
  Result<EncodeOptions> get() const;
  /// The first of all these options that the command line has, as "--base"; empty: none.
  std::string first_given() const;
  /// Whether the command line asks for another profile than this one.
  bool asks_for_another(Profile now) const { return profile && profile_named(*profile) != now; }

 private:
  void add_profile(CLI::App& app);
  Result<void> check_profile(Profile wanted) const;
};

/// "--base" of the first option that the command line has; empty: none.
std::string first_given(const std::vector<const CLI::Option*>& options);

}  // namespace pstrips::cli
