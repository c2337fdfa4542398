#pragma once

#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace pstrips::cli {

// Groups of options in --help. The last three show under --help-all only.
inline constexpr const char* kLevelGroup = "Level of a progressive input";
inline constexpr const char* kProgressiveGroup = "Progressive output";
inline constexpr const char* kStripsGroup = "Strips";
inline constexpr const char* kRareProgressiveGroup = "Progressive output, rarely needed";
inline constexpr const char* kRareStripsGroup = "Strips, rarely needed";
inline constexpr const char* kLimitsGroup = "Limits, with k M G or Ki Mi Gi";

/// Lays help out in 80 columns: arguments, everyday options by group, the rest under --help-all
/// together with a glossary; then the rule of overwriting and the exit codes. For the program and,
/// when set before they are added, its commands.
void set_help(CLI::App& app);

/// "text text …" in lines of at most 80 characters; all but the first line are indented.
std::string wrapped(std::string_view text, std::size_t first_column, std::size_t indent);

}  // namespace pstrips::cli
