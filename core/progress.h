#pragma once

#include <functional>
#include <string_view>

namespace pstrips::inline core {

/// Told how far long work is: the stage in a word or two, and how much of it is done, 0 to 1.
/// Returns false to stop the work, which then answers ErrorCode::interrupted. May be empty.
using Progress = std::function<bool(std::string_view stage, double done)>;

}  // namespace pstrips::inline core
