#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace pstrips::test {

/// tests/data of the source tree.
std::filesystem::path data_dir();

/// The folder of real models: $PSTRIPS_MODELS, else ../shared/models beside the source tree when it
/// is there. Tests over it skip with a reason when it is not.
std::optional<std::filesystem::path> models_dir();

}  // namespace pstrips::test
