#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string_view>

namespace pstrips::inline core {

/// How the payloads that hold the geometry are coded; all else is common to the profiles. The
/// values are those that the binary variant stores. [spec/container.md §5.1]
enum class Profile : std::uint8_t {
  plain = 0,    ///< fixed-width arrays
  compact = 1,  ///< batches of splits, predicted and entropy-coded
};

struct ProfileName {
  Profile profile;
  std::string_view name;  ///< in the XML variant, the media type and reports
};
/// The profiles that this build knows.
inline constexpr ProfileName kProfiles[] = {{Profile::plain, "plain"},
                                            {Profile::compact, "compact"}};

constexpr std::string_view name_of(Profile profile) {
  return std::ranges::find(kProfiles, profile, &ProfileName::profile)->name;
}
constexpr std::optional<Profile> profile_named(std::string_view name) {
  const auto* const found = std::ranges::find(kProfiles, name, &ProfileName::name);
  if (found == std::end(kProfiles)) return std::nullopt;
  return found->profile;
}
constexpr std::optional<Profile> profile_numbered(std::uint8_t number) {
  const auto is = [&](const ProfileName& p) {
    return static_cast<std::uint8_t>(p.profile) == number;
  };
  const auto* const found = std::ranges::find_if(kProfiles, is);
  if (found == std::end(kProfiles)) return std::nullopt;
  return found->profile;
}

}  // namespace pstrips::inline core
