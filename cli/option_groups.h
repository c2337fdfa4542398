#pragma once

#include <cstdint>
#include <string>

#include "codecs/stripify/stripify.h"
#include "converters/decode.h"
#include "converters/files.h"
#include "core/limits.h"

namespace CLI {
class App;
}

namespace pstrip::cli {

/// --format text|json[|csv]
struct FormatOption {
  std::string format = "text";
  void add_to(CLI::App& app, bool with_csv);
  bool json() const { return format == "json"; }
  bool csv() const { return format == "csv"; }
};

/// --max-vertices, --max-wedges, --max-corners, --max-meshes, --max-string, --max-memory,
/// --max-depth
struct LimitOptions {
  Limits limits;
  void add_to(CLI::App& app);
};

/// --level (--packet), --triangles, --error: how far to refine a progressive file.
struct LevelOptions {
  LevelChoice choice;
  void add_to(CLI::App& app);
  bool given() const { return choice.packets >= 0 || choice.triangles >= 0 || choice.error >= 0; }
};

/// --goal, --strip-effort, --strip-price: how hard the stripifier tries, and for what.
struct StripOptionsGroup {
  std::string goal = "indices";
  std::string effort = "fast";
  std::uint32_t price = 3;
  void add_to(CLI::App& app);
  /// errors  bad_argument
  Result<StripOptions> get() const;
};

/// The options above and --strips, --stripifier, --base, --base-error, --keep-order, --profile
struct EncodeOptionsGroup {
  EncodeOptions options;
  std::string strips = "offset";
  std::string base = "5%";
  double base_error = -1;
  std::string profile = "plain";
  StripOptionsGroup stripping;
  void add_to(CLI::App& app);
  /// Combines what was parsed. errors: bad_argument
  Result<EncodeOptions> get() const;
};

/// --to FORMAT, for "-" and for unusual extensions.
struct TargetOption {
  std::string to;
  void add_to(CLI::App& app);
  /// errors  bad_argument when neither the option nor the path names a format
  Result<FileFormat> format_for(const std::string& path) const;
};

}  // namespace pstrip::cli
