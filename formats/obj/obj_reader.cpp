#include "formats/obj/model.h"
#include "formats/obj/obj.h"
#include "formats/obj/runs.h"
#include "formats/obj/statements.h"

namespace pstrips::inline formats {

Result<Model> obj::read_obj_in_runs(ByteView file, const ReadFile& read_file, const Limits& limits,
                                    std::size_t run_bytes) {
  Result<Statements> statements = read_statements(file, read_file, limits, run_bytes);
  if (!statements) return tl::unexpected(std::move(statements).error());
  return make_model(std::move(*statements), limits);
}

Result<Model> read_obj(ByteView file, const ReadFile& read_file, const Limits& limits) {
  return obj::read_obj_in_runs(file, read_file, limits, obj::kRunBytes);
}

}  // namespace pstrips::inline formats
