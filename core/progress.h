#pragma once

#include <functional>
#include <string_view>

namespace pstrips::inline core {

/// Long work calls it now and then with its stage, in a word or two, and the share that is done, 0
/// to 1. It returns false to stop the work, which then fails with ErrorCode::interrupted. May be
/// empty.
using Progress = std::function<bool(std::string_view stage, double done)>;

}  // namespace pstrips::inline core
