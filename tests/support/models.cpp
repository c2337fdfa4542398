#include "tests/support/models.h"

#include <fstream>
#include <map>
#include <stdexcept>

#include "core/file.h"
#include "formats/obj/obj.h"
#include "formats/ply/ply.h"
#include "tests/support/paths.h"

namespace pstrips::test {
namespace {

std::optional<Mesh> first_mesh(const std::filesystem::path& path) {
  const auto file = read_file(path);
  if (!file) return std::nullopt;
  const ReadFile no_companions = [](const std::string&) -> Result<Bytes> {
    return fail(ErrorCode::io, "not looked up");
  };
  auto model =
      path.extension() == ".obj" ? read_obj(file->view(), no_companions) : read_ply(file->view());
  if (!model || model->meshes.empty()) return std::nullopt;
  return std::move(model->meshes.front());
}

std::map<std::string, std::string> read_refused() {
  std::map<std::string, std::string> out;
  std::ifstream table(data_dir() / "models_refused.tsv");
  for (std::string line; std::getline(table, line);)
    if (const std::size_t tab = line.find('\t'); tab != line.npos)
      out.emplace(line.substr(0, tab), line.substr(tab + 1));
  if (out.empty()) throw std::runtime_error("tests/data/models_refused.tsv is empty");
  return out;
}

bool is_shipped(const std::string& path) { return path.starts_with(kShippedModels); }

}  // namespace

bool is_here(const std::string& path) { return is_shipped(path) || models_dir(); }

std::vector<std::string> those_here(std::vector<std::string> paths) {
  std::erase_if(paths, [](const std::string& path) {
    const auto place = model_path(path);
    return !is_shipped(path) && (!place || !std::filesystem::exists(*place));
  });
  return paths;
}

std::optional<Mesh> model_mesh(const std::string& path) {
  const auto place = model_path(path);
  auto mesh = place ? first_mesh(*place) : std::nullopt;
  if (!mesh && is_shipped(path)) throw std::runtime_error("cannot read " + path);
  return mesh;
}

std::string expected_outcome(const std::string& path) {
  static const std::map<std::string, std::string> kRefused = read_refused();
  const auto row = kRefused.find(path);
  return row == kRefused.end() ? "read" : row->second;
}

std::string outcome_of(const std::optional<Error>& error) {
  static constexpr const char* kCodes[] = {"bad_argument", "io",          "truncated",  "corrupt",
                                           "over_limit",   "unsupported", "interrupted"};
  return error ? kCodes[static_cast<std::size_t>(error->code)] : "read";
}

}  // namespace pstrips::test
