#include "tests/support/paths.h"

#include <cstdlib>

namespace pstrips::test {

std::filesystem::path data_dir() {
  return std::filesystem::path(PSTRIPS_SOURCE_DIR) / "tests/data";
}

std::optional<std::filesystem::path> models_dir() {
  const char* named = std::getenv("PSTRIPS_MODELS");
  const std::filesystem::path dir =
      named ? std::filesystem::path(named)
            : std::filesystem::path(PSTRIPS_SOURCE_DIR) / ".." / "shared" / "models";
  std::error_code ignored;
  if (!std::filesystem::is_directory(dir, ignored)) return std::nullopt;
  return dir;
}

}  // namespace pstrips::test
