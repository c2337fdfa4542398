#include "formats/obj/model.h"
#include "formats/obj/obj.h"
#include "formats/obj/runs.h"
#include "formats/obj/statements.h"

namespace pstrips::inline formats {

Result<Model> obj::read_obj_in_runs(ByteView file, const ReadFile& read_file, const Limits& limits,
                                    std::size_t run_bytes, const ObjReadOptions& options) {
  Result<Statements> statements = read_statements(file, read_file, limits, options, run_bytes);
  if (!statements) return tl::unexpected(std::move(statements).error());
  return make_model(std::move(*statements), limits, options);
}

Result<Model> read_obj(ByteView file, const ReadFile& read_file, const Limits& limits,
                       const ObjReadOptions& options) {
  return obj::read_obj_in_runs(file, read_file, limits, obj::kRunBytes, options);
}

}  // namespace pstrips::inline formats
