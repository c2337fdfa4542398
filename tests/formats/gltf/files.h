#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>

#include "formats/gltf/gltf.h"

namespace pstrip::test {

inline Bytes load(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  const ByteView bytes = as_bytes(text);
  return Bytes(bytes.begin(), bytes.end());
}

/// Reads what stands in the folder of `model`.
inline ReadFile beside(const std::filesystem::path& model) {
  return [folder = model.parent_path()](const std::string& path) -> Result<Bytes> {
    if (!std::filesystem::is_regular_file(folder / path))
      return fail(ErrorCode::io, "no such file", kNoOffset, path);
    return load(folder / path);
  };
}

/// Reads what a writer made beside its main file.
inline ReadFile among(const std::vector<std::pair<std::string, Bytes>>& files) {
  return [&files](const std::string& path) -> Result<Bytes> {
    for (const auto& [name, content] : files)
      if (name == path) return content;
    return fail(ErrorCode::io, "no such file", kNoOffset, path);
  };
}

}  // namespace pstrip::test
