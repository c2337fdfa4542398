#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace pstrips::test {

inline std::string load(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// All .obj files below a folder, in order of their paths.
inline std::vector<std::filesystem::path> obj_files(const std::filesystem::path& root) {
  std::vector<std::filesystem::path> out;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    const std::string extension = entry.path().extension().string();
    if (entry.is_regular_file() && (extension == ".obj" || extension == ".OBJ"))
      out.push_back(entry.path());
  }
  std::ranges::sort(out);
  return out;
}

}  // namespace pstrips::test
