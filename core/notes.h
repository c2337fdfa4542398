#pragma once

#include <string>
#include <vector>

namespace pstrips::inline core {

/// What a step cannot pass on as it was, one phrase each.
struct Notes {
  std::vector<std::string> converted;  ///< says the same in another way
  std::vector<std::string> dropped;    ///< is lost
};

}  // namespace pstrips::inline core
