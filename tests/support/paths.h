#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pstrips::test {

/// tests/data of the source tree.
std::filesystem::path data_dir();

/// The folder of real models: $PSTRIPS_MODELS, else ../shared/models beside the source tree when it
/// is there. Tests run over it in addition to tests/data/models.
std::optional<std::filesystem::path> models_dir();

/// How the names of models in tests/data/models begin.
inline constexpr std::string_view kShippedModels = "shipped/";

/// Where the model "shipped/x" or x of models_dir() is; nothing without the folder.
std::optional<std::filesystem::path> model_path(const std::string& name);

/// A file in tests/data/models or models_dir(), and its name as model_path() takes it.
struct ModelFile {
  std::string name;
  std::filesystem::path path;
};

/// All files of both folders with one of the extensions, such as ".ply", in order of their names.
/// Capitals in extensions count as small letters.
std::vector<ModelFile> model_files(const std::vector<std::string>& extensions);

}  // namespace pstrips::test
