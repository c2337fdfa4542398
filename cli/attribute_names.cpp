#include "cli/attribute_names.h"

#include <fmt/format.h>

#include <set>

namespace pstrips::cli {
namespace {

std::set<std::string> names_in(const Model& model) {
  std::set<std::string> out;
  for (const Mesh& mesh : model.meshes) {
    out.insert(mesh.position.semantic);
    for (const Attribute& a : mesh.wedge_attributes) out.insert(a.semantic);
    for (const Attribute& a : mesh.face_attributes) out.insert(a.semantic);
  }
  return out;
}

bool is_among(const std::set<std::string>& there, const std::string& name) {
  if (there.contains(name)) return true;
  const auto first = there.lower_bound(name + "_");
  return first != there.end() && first->substr(0, first->rfind('_')) == name;
}

}  // namespace

Result<void> check_attribute_names(const Model& model, const std::string& option,
                                   const std::vector<std::string>& names) {
  const std::set<std::string> there = names_in(model);
  for (const std::string& name : names)
    if (!is_among(there, name))
      return fail(ErrorCode::bad_argument,
                  fmt::format("{}: no mesh has an attribute {}; there are {}", option, name,
                              fmt::join(there, ", ")));
  return {};
}

}  // namespace pstrips::cli
