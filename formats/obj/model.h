#pragma once

#include "core/scene.h"
#include "formats/obj/statements.h"

namespace pstrips::inline formats::obj {

/// Makes the model of what a file says, as obj.h describes it. errors: over_limit, corrupt
Result<Model> make_model(Statements statements, const Limits& limits,
                         const ObjReadOptions& options);

}  // namespace pstrips::inline formats::obj
