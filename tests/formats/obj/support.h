#pragma once

#include <map>
#include <string>
#include <string_view>

#include "core/scene.h"
#include "formats/obj/obj.h"

namespace pstrips::test {

/// Companion files in memory.
inline ReadFile files(std::map<std::string, std::string> by_name) {
  return [by_name = std::move(by_name)](const std::string& name) -> Result<Bytes> {
    const auto found = by_name.find(name);
    if (found == by_name.end()) return fail(ErrorCode::io, "no such file", kNoOffset, name);
    const ByteView bytes = as_bytes(found->second);
    return Bytes(bytes.begin(), bytes.end());
  };
}

inline Result<Model> read_text(std::string_view obj, const ReadFile& companions = files({})) {
  return read_obj(as_bytes(obj), companions);
}

/// What a reader of written files sees.
inline Result<Model> read_files(const ObjFiles& written) {
  return read_obj(written.obj, files({{written.mtl_name, std::string(as_text(written.mtl))}}));
}

inline const Attribute* find_attribute(const std::vector<Attribute>& list, std::string_view name) {
  for (const Attribute& a : list)
    if (a.semantic == name) return &a;
  return nullptr;
}

inline std::vector<double> values(const Attribute& a) {
  std::vector<double> out;
  for (std::size_t i = 0; i < a.elements(); ++i)
    for (std::size_t c = 0; c < a.count; ++c) out.push_back(component(a, i, c));
  return out;
}

inline std::string foreign(const Model& model, std::string_view key) {
  for (const Foreign& f : model.scene.foreign)
    if (f.key == key) return std::string(as_text(f.data));
  return {};
}

/// Whether writing and reading gives the model again, and the written text is a fixed point.
/// Returns what is wrong, or nothing.
inline std::string check_round_trip(const Model& model) {
  for (const Mesh& mesh : model.meshes)
    if (const std::string wrong = find_inconsistency(mesh); !wrong.empty()) return wrong;
  const auto written = write_obj(model, "a b.mtl");
  if (!written) return "write: " + written.error().message;
  if (!written->dropped.empty()) return "dropped " + written->dropped.front();
  const auto again = read_files(*written);
  if (!again) return "read: " + again.error().message + " " + again.error().path;
  if (again->scene != model.scene) return "another scene";
  if (*again != model) return "another mesh";
  const auto rewritten = write_obj(*again, "a b.mtl");
  if (rewritten->obj != written->obj || rewritten->mtl != written->mtl) return "another text";
  return {};
}

}  // namespace pstrips::test
