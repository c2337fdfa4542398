#include "cli/texture_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>

#include "cli/number_options.h"

namespace pstrips::cli {
namespace {

// In the order of Textures.
constexpr std::array<std::string_view, 3> kNames = {"embed", "copy", "reference"};

Textures named(const std::string& name) {
  return static_cast<Textures>(std::ranges::find(kNames, name) - kNames.begin());
}

}  // namespace

void TextureOptions::add_to(CLI::App& app) {
  takes_one_of(app.add_option("--textures", mode,
                              "Images: into the output, copied beside it, or where they are; by "
                              "itself into pstrip and glb, beside others"),
               {kNames.begin(), kNames.end()});
  app.add_flag("--allow-parent-paths", allow_parent_paths,
               "Read images and material libraries outside the model's folder");
}

Result<void> TextureOptions::check(FileFormat target) const {
  if (mode.empty() || takes(target, named(mode))) return {};
  return fail(ErrorCode::bad_argument,
              fmt::format("--textures {} does nothing for a {} file", mode, name_of(target)));
}

Textures TextureOptions::for_target(FileFormat target, bool to_stdout) const {
  const auto wanted = mode.empty() ? usual_textures(target) : std::optional(named(mode));
  if (wanted != Textures::copy || !to_stdout) return wanted.value_or(Textures::reference);
  return takes(target, Textures::embed) ? Textures::embed : Textures::reference;
}

Textures TextureOptions::prepare(Scene& scene, const std::string& input, const OutputOption& output,
                                 FileFormat target, const Limits& limits,
                                 std::vector<std::string>& notes) const {
  const Textures textures = for_target(target, output.is_stdout());
  if (takes(target, textures))
    prepare_textures(
        scene, {.model_path = input, .allow_parent_paths = allow_parent_paths, .limits = limits},
        output.path, target, textures, notes);
  return textures;
}

}  // namespace pstrips::cli
