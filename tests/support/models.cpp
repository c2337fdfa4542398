#include "tests/support/models.h"

#include "core/file.h"
#include "formats/obj/obj.h"
#include "formats/ply/ply.h"
#include "tests/support/paths.h"

namespace pstrips::test {

std::optional<Mesh> real_mesh(const std::string& path_in_models) {
  const auto dir = models_dir();
  if (!dir) return std::nullopt;
  const auto file = read_file(*dir / path_in_models);
  if (!file) return std::nullopt;
  const ReadFile no_companions = [](const std::string&) -> Result<Bytes> {
    return fail(ErrorCode::io, "not looked up");
  };
  auto model = path_in_models.ends_with(".obj") ? read_obj(file->view(), no_companions)
                                                : read_ply(file->view());
  if (!model || model->meshes.empty()) return std::nullopt;
  return std::move(model->meshes.front());
}

}  // namespace pstrips::test
