#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace pstrips::test {

inline std::string load(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace pstrips::test
