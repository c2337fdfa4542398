#include "formats/gltf/needs.h"

#include <algorithm>
#include <string>
#include <vector>

namespace pstrips::inline formats::gltf {
namespace {

/// What the primitives of a mesh offer; of several the first counts.
struct Offer {
  bool has_joints = false;
  std::size_t targets = 0;
};

json* member(json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

template <class Visit>
void each(json& root, const char* key, Visit&& visit) {
  json* list = member(root, key);
  if (!list || !list->is_array()) return;
  for (json& element : *list) visit(element);
}

std::vector<Offer> offers_of(json& root) {
  std::vector<Offer> out;
  each(root, "meshes", [&](json& mesh) {
    Offer& offer = out.emplace_back();
    each(mesh, "primitives", [&](json& primitive) {
      const json* attributes = member(primitive, "attributes");
      const json* targets = member(primitive, "targets");
      offer.has_joints |= attributes && attributes->contains("JOINTS_0");
      if (targets && offer.targets == 0) offer.targets = targets->size();
    });
  });
  return out;
}

/// Erases the weights of a mesh or a node where they are not one a target.
bool drop_weights(json& holder, const Offer& offer) {
  const json* weights = member(holder, "weights");
  if (!weights || weights->size() == offer.targets) return false;
  holder.erase("weights");
  return true;
}

const Offer* offer_of(json& node, const std::vector<Offer>& offers) {
  const json* mesh = member(node, "mesh");
  if (!mesh || !mesh->is_number_unsigned() || mesh->get<std::size_t>() >= offers.size())
    return nullptr;
  return &offers[mesh->get<std::size_t>()];
}

bool moves_missing_weights(json& channel, json& root, const std::vector<Offer>& offers) {
  json* target = member(channel, "target");
  json* nodes = member(root, "nodes");
  if (!target || !nodes || !nodes->is_array()) return false;
  const json *path = member(*target, "path"), *node = member(*target, "node");
  if (!path || *path != "weights" || !node || !node->is_number_unsigned()) return false;
  if (node->get<std::size_t>() >= nodes->size()) return false;
  const Offer* offer = offer_of((*nodes)[node->get<std::size_t>()], offers);
  return !offer || offer->targets == 0;
}

std::uint64_t drop_channels(json& root, const std::vector<Offer>& offers) {
  std::uint64_t dropped = 0;
  json* animations = member(root, "animations");
  if (!animations || !animations->is_array()) return 0;
  json left = json::array();
  for (json& animation : *animations) {
    json* channels = member(animation, "channels");
    const std::uint64_t before = dropped;
    if (channels && channels->is_array()) {
      json kept = json::array();
      for (json& channel : *channels)
        if (moves_missing_weights(channel, root, offers))
          ++dropped;
        else
          kept.push_back(std::move(channel));
      *channels = std::move(kept);
    }
    if (before == dropped || !channels->empty()) left.push_back(std::move(animation));
  }
  if (dropped == 0 || !left.empty())
    *animations = std::move(left);
  else
    root.erase("animations");
  return dropped;
}

}  // namespace

void drop_unmet_needs(json& root, Notes& notes) {
  const std::vector<Offer> offers = offers_of(root);
  std::uint64_t skins = 0, weights = 0;
  std::size_t m = 0;
  each(root, "meshes", [&](json& mesh) {
    if (drop_weights(mesh, offers[m++])) ++weights;
  });
  each(root, "nodes", [&](json& node) {
    const Offer* offer = offer_of(node, offers);
    if (offer && drop_weights(node, *offer)) ++weights;
    if (offer && !offer->has_joints && member(node, "skin")) {
      node.erase("skin");
      ++skins;
    }
  });
  const std::uint64_t channels = drop_channels(root, offers);
  const auto drop = [&](std::uint64_t n, const char* what) {
    if (n > 0) notes.dropped.push_back(what + (" (" + std::to_string(n) + ")"));
  };
  drop(skins, "skins of nodes whose meshes have no joints");
  drop(weights, "weights of morph targets that are not there");
  drop(channels, "animation channels of morph targets that are not there");
}

}  // namespace pstrips::inline formats::gltf
