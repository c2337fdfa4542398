#include "tests/support/random_welding.h"

#include <numeric>
#include <random>

#include "codecs/weld/record_welding.h"
#include "core/gather.h"

namespace pstrips::test {
namespace {

// One of several, or a new one now and then.
class Choice {
 public:
  Choice(std::uint32_t seed, std::size_t kinds) : random_(seed), of_kind_(kinds) {}

  Index choose(Index kind) {
    std::vector<Index>& there = of_kind_[kind];
    if (!there.empty() && random_() % 2 == 0) return there[random_() % there.size()];
    there.push_back(static_cast<Index>(kind_of.size()));
    kind_of.push_back(kind);
    return there.back();
  }
  bool has(Index kind) const { return !of_kind_[kind].empty(); }

  std::vector<Index> kind_of;

 private:
  std::mt19937 random_;
  std::vector<std::vector<Index>> of_kind_;
};

}  // namespace

Welding random_welding(const Mesh& shown, std::uint32_t seed) {
  Choice wedges(seed, shown.wedge_count()), vertices(seed + 1, shown.vertex_count());
  Mesh source = shown;
  for (Index& corner : source.corners) corner = wedges.choose(corner);
  for (Index w = 0; w < shown.wedge_count(); ++w)
    if (!wedges.has(w)) wedges.choose(w);
  source.wedge_vertex.clear();
  for (const Index wedge : wedges.kind_of)
    source.wedge_vertex.push_back(vertices.choose(shown.vertex_of(wedge)));
  source.position = gather(shown.position, vertices.kind_of);
  for (std::size_t v = 0; v < source.position.elements(); v += 5)
    source.position.data[v * source.position.element_bytes()] ^= std::byte{1};
  Welds welds;
  welds.wedge = wedges.kind_of;
  welds.wedge_from.assign(shown.wedge_count(), kNone);
  for (Index w = 0; w < welds.wedge.size(); ++w)
    if (welds.wedge_from[welds.wedge[w]] == kNone) welds.wedge_from[welds.wedge[w]] = w;
  std::vector<Index> same(shown.wedge_count());
  std::iota(same.begin(), same.end(), Index{0});
  OriginalOrder order;
  order.face.resize(shown.face_count());
  std::iota(order.face.begin(), order.face.end(), Index{0});
  order.rotation.assign(shown.face_count(), 0);
  return record_welding(source, welds, shown, same, order).welding;
}

}  // namespace pstrips::test
