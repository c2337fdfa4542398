#include "converters/placement.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "converters/transform.h"
#include "formats/gltf/shown_nodes.h"

namespace pstrips::inline converters {
namespace {

struct Place {
  Index mesh = 0;
  Index node = kNone;
  Matrix4 world = kIdentity4;
};

struct Places {
  std::vector<Place> list;
  std::uint64_t hidden = 0;                 ///< places outside the default scene
  std::vector<std::string> of_no_number{};  ///< nodes with a matrix that is not finite
};

bool is_finite(const Matrix4& m) {
  return std::ranges::all_of(m, [](double x) { return std::isfinite(x); });
}

Result<Places> find_places(const Scene& scene, const Limits& limits) {
  Places out;
  const auto shown = find_shown_nodes(scene, limits);
  if (!shown) return tl::unexpected(shown.error());
  std::vector<Matrix4> world;
  for (Index i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    world.push_back(node.parent == kNone ? node.matrix : product(world[node.parent], node.matrix));
    for (const Matrix4& instance : (*shown)[i].instances)
      for (const Index mesh : node.meshes) {
        const Place place{mesh, i, product(world[i], instance)};
        if (!(*shown)[i].is_shown)
          ++out.hidden;
        else if (!is_finite(place.world))
          out.of_no_number.push_back(node.name);
        else
          out.list.push_back(place);
      }
  }
  return out;
}

bool stands(const Places& places, std::size_t meshes) {
  if (places.list.size() != meshes || places.hidden > 0 || !places.of_no_number.empty())
    return false;
  std::set<Index> seen;
  return std::ranges::all_of(places.list, [&](const Place& place) {
    return place.world == kIdentity4 && seen.insert(place.mesh).second;
  });
}

std::uint64_t bytes_of(const Mesh& mesh) {
  std::uint64_t bytes = mesh.position.elements() * 3 * sizeof(double);
  for (const Attribute& a : mesh.wedge_attributes) bytes += a.data.size();
  for (const Attribute& a : mesh.face_attributes) bytes += a.data.size();
  const std::size_t numbers = mesh.wedge_vertex.size() + mesh.corners.size() +
                              mesh.face_first.size() + mesh.face_group.size();
  return bytes + sizeof(Index) * numbers + sizeof(Mesh);
}

Result<void> check_room(const Model& model, const Places& places, const Limits& limits) {
  std::uint64_t bytes = 0;
  for (const Place& place : places.list) {
    bytes += bytes_of(model.meshes[place.mesh]);
    if (bytes > limits.memory_bytes)
      return fail(ErrorCode::over_limit, "the instances of the scene exceed the memory limit of " +
                                             std::to_string(limits.memory_bytes) + " bytes");
  }
  return {};
}

/// Names of the copies of a mesh that is shown more than once.
class CopyNames {
 public:
  CopyNames(const Model& model, const Places& places) : model_(model), uses_(model.meshes.size()) {
    for (const Place& place : places.list) ++uses_[place.mesh];
    for (const Mesh& mesh : model.meshes) taken_.insert(mesh.name);
  }
  std::string name(const Place& place) {
    const std::string& mesh = model_.meshes[place.mesh].name;
    const std::string& node = place.node == kNone ? mesh : model_.scene.nodes[place.node].name;
    if (uses_[place.mesh] < 2) return mesh.empty() ? node : mesh;
    const std::string base = !node.empty() ? node : !mesh.empty() ? mesh : "instance";
    std::string out = base;
    for (int& n = last_[base]; !taken_.insert(out).second;)
      out = base + '_' + std::to_string(++n + 1);
    return out;
  }

 private:
  const Model& model_;
  std::vector<std::size_t> uses_;
  std::set<std::string> taken_;
  std::map<std::string, int> last_;
};

void note_changes(const Model& model, const Places& places, std::vector<std::string>& converted,
                  std::vector<std::string>& dropped) {
  std::set<Index> seen;
  std::uint64_t moved = 0, copies = 0;
  for (const Place& place : places.list) {
    if (place.world != kIdentity4) ++moved;
    if (!seen.insert(place.mesh).second) ++copies;
  }
  const auto count = [](std::uint64_t n) { return " (" + std::to_string(n) + ")"; };
  if (moved > 0) converted.push_back("node transforms, applied to meshes" + count(moved));
  if (copies > 0) converted.push_back("node instances, made copies" + count(copies));
  const std::uint64_t unseen = model.meshes.size() - seen.size();
  if (unseen > 0) dropped.push_back("meshes that the scene does not show" + count(unseen));
  if (places.hidden > 0)
    dropped.push_back("places of meshes in other scenes than the default" + count(places.hidden));
  for (const std::string& name : places.of_no_number)
    dropped.push_back("meshes of node " + name + ", whose matrix is not finite");
}

}  // namespace

Result<bool> is_placed(const Scene& scene, std::size_t meshes) {
  if (scene.nodes.empty()) return true;
  const auto places = find_places(scene, Limits{});
  if (!places) return tl::unexpected(places.error());
  return stands(*places, meshes);
}

Result<std::optional<Model>> place_meshes(const Model& model, const Limits& limits,
                                          std::vector<std::string>& converted,
                                          std::vector<std::string>& dropped) {
  if (model.scene.nodes.empty()) return std::nullopt;
  const auto places = find_places(model.scene, limits);
  if (!places) return tl::unexpected(places.error());
  if (stands(*places, model.meshes.size())) return std::nullopt;
  if (const auto room = check_room(model, *places, limits); !room)
    return tl::unexpected(room.error());
  Model out;
  out.scene = model.scene;
  out.scene.nodes.clear();
  note_changes(model, *places, converted, dropped);
  CopyNames names(model, *places);
  for (const Place& place : places->list) {
    Mesh& mesh = out.meshes.emplace_back(model.meshes[place.mesh]);
    mesh.name = names.name(place);
    transform(mesh, place.world);
  }
  return out;
}

}  // namespace pstrips::inline converters
