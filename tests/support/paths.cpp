#include "tests/support/paths.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace pstrips::test {

namespace fs = std::filesystem;

namespace {

void append_files(const fs::path& folder, std::string_view prefix,
                  const std::vector<std::string>& extensions, std::vector<ModelFile>& out) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    std::string extension = entry.path().extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (entry.is_regular_file() && std::ranges::count(extensions, extension) != 0)
      out.push_back({std::string(prefix) + fs::relative(entry.path(), folder).generic_string(),
                     entry.path()});
  }
}

}  // namespace

fs::path data_dir() { return fs::path(PSTRIPS_SOURCE_DIR) / "tests/data"; }

std::optional<fs::path> models_dir() {
  const char* named = std::getenv("PSTRIPS_MODELS");
  const fs::path dir =
      named ? fs::path(named) : fs::path(PSTRIPS_SOURCE_DIR) / ".." / "shared" / "models";
  std::error_code ignored;
  if (!fs::is_directory(dir, ignored)) return std::nullopt;
  return dir;
}

std::optional<fs::path> model_path(const std::string& name) {
  if (name.starts_with(kShippedModels))
    return data_dir() / "models" / name.substr(kShippedModels.size());
  const auto dir = models_dir();
  if (!dir) return std::nullopt;
  return *dir / name;
}

std::vector<ModelFile> model_files(const std::vector<std::string>& extensions) {
  std::vector<ModelFile> out;
  append_files(data_dir() / "models", kShippedModels, extensions, out);
  if (const auto dir = models_dir()) append_files(*dir, "", extensions, out);
  std::ranges::sort(out, {}, &ModelFile::name);
  return out;
}

}  // namespace pstrips::test
