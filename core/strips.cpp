#include "core/strips.h"

namespace pstrips::inline core {

Result<std::vector<Index>> resolve(std::span<const Index> map) {
  std::vector<Index> out(map.begin(), map.end());
  std::vector<std::size_t> chain;  // entries that wait for the same wedge
  for (std::size_t start = 0; start < out.size(); ++start) {
    std::size_t at = start;
    chain.clear();
    while (is_symbol(out[at])) {
      chain.push_back(at);
      const int d = distance_of(out[at]);
      const bool inside = d < 0 ? at >= static_cast<std::size_t>(-d)
                                : out.size() - at > static_cast<std::size_t>(d);
      // The entry stepped over must not be the end of the strip either.
      if (!inside || ((d == 2 || d == -2) && out[d < 0 ? at - 1 : at + 1] == kRestart))
        return fail(ErrorCode::corrupt, "symbol points outside its strip", at);
      if (chain.size() > out.size())
        return fail(ErrorCode::corrupt, "symbols point at each other", start);
      at = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(at) + d);
    }
    if (chain.empty()) continue;
    if (out[at] == kRestart)
      return fail(ErrorCode::corrupt, "symbol points outside its strip", chain.back());
    for (const std::size_t waiting : chain) out[waiting] = out[at];
  }
  return out;
}

}  // namespace pstrips::inline core
