#include "codecs/stripify/stripify.h"

#include <algorithm>

#include "codecs/stripify/best.h"
#include "codecs/stripify/sgi.h"

namespace pstrip {
namespace {

constexpr NamedStripifier kStripifiers[] = {
    {"best", "ours, codecs/stripify/best.h", best_strips},
    {"sgi-strips", "[Akeley90; Vanecek05 §8.1 SGS]", sgi_strips},
    {"sgi-vertices", "[Akeley90; Vanecek05 §8.1 SGV]", sgi_vertices},
};

}  // namespace

std::span<const NamedStripifier> stripifiers() { return kStripifiers; }

const NamedStripifier* find_stripifier(std::string_view name) {
  const auto* found = std::ranges::find(kStripifiers, name, &NamedStripifier::name);
  return found == std::end(kStripifiers) ? nullptr : found;
}

}  // namespace pstrip
