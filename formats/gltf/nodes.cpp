#include "formats/gltf/nodes.h"

#include <algorithm>
#include <array>

namespace pstrips::inline formats::gltf {
namespace {

Node read_node(const Cursor& in, std::size_t meshes) {
  Node out;
  out.name = in.text("name");
  const Index mesh = in.reference("mesh", meshes);
  if (mesh != kNone) out.meshes.push_back(mesh);
  if (in.numbers("matrix", out.matrix)) return out;
  std::array<double, 3> translation{0, 0, 0}, scale{1, 1, 1};
  std::array<double, 4> rotation{0, 0, 0, 1};
  const bool moved = in.numbers("translation", translation);
  const bool turned = in.numbers("rotation", rotation);
  if (in.numbers("scale", scale) || moved || turned)
    out.matrix = matrix_of(translation, rotation, scale);
  return out;
}

class NodeReader {
 public:
  NodeReader(const Cursor& root, std::size_t meshes, const Limits& limits)
      : root_(root),
        limits_(limits),
        children_(root.length("nodes")),
        state_(root.length("nodes")) {
    std::vector<bool> has_parent(children_.size());
    root.each("nodes", [&](const Cursor& in, std::size_t i) {
      nodes_.push_back(read_node(in, meshes));
      children_[i] = in.references("children", children_.size());
      for (const Index child : children_[i]) has_parent[child] = true;
    });
    for (Index i = 0; i < children_.size() && !root.failed(); ++i)
      if (!has_parent[i]) place_subtree(i);
    if (root.failed()) return;
    if (std::ranges::find(state_, State::unseen) != state_.end())
      root["nodes"].fail(ErrorCode::corrupt, "nodes form a cycle");
  }
  std::vector<Node> take() && { return std::move(placed_); }
  /// The number in the file of each.
  const std::vector<Index>& sources() const { return sources_; }

 private:
  enum class State : std::uint8_t { unseen, on_path, left };
  struct Visit {
    Index node, place;
    std::size_t next_child = 0;
  };

  void place(Index i, Index parent, std::vector<Visit>& path) {
    if (state_[i] == State::on_path)
      return root_["nodes"].fail(ErrorCode::corrupt, "nodes form a cycle");
    if (placed_.size() >= limits_.meshes)
      return root_["nodes"].fail(ErrorCode::over_limit, "too many nodes");
    state_[i] = State::on_path;
    path.push_back({i, static_cast<Index>(placed_.size())});
    placed_.push_back(nodes_[i]);
    sources_.push_back(i);
    placed_.back().parent = parent;
  }
  void place_subtree(Index top) {
    std::vector<Visit> path;
    place(top, kNone, path);
    while (!path.empty() && !root_.failed()) {
      Visit& visit = path.back();
      if (visit.next_child == children_[visit.node].size()) {
        state_[visit.node] = State::left;
        path.pop_back();
      } else {
        const Index child = children_[visit.node][visit.next_child++];
        place(child, visit.place, path);
      }
    }
  }

  const Cursor& root_;
  const Limits& limits_;
  std::vector<Node> nodes_, placed_;
  std::vector<Index> sources_;
  std::vector<std::vector<Index>> children_;
  std::vector<State> state_;
};

}  // namespace

Matrix4 matrix_of(const std::array<double, 3>& t, const std::array<double, 4>& q,
                  const std::array<double, 3>& s) {
  const auto [x, y, z, w] = q;
  return {s[0] * (1 - 2 * (y * y + z * z)),
          s[0] * 2 * (x * y + z * w),
          s[0] * 2 * (x * z - y * w),
          0,
          s[1] * 2 * (x * y - z * w),
          s[1] * (1 - 2 * (x * x + z * z)),
          s[1] * 2 * (y * z + x * w),
          0,
          s[2] * 2 * (x * z + y * w),
          s[2] * 2 * (y * z - x * w),
          s[2] * (1 - 2 * (x * x + y * y)),
          0,
          t[0],
          t[1],
          t[2],
          1};
}

std::vector<Node> read_nodes(const Cursor& root, std::size_t meshes, const Limits& limits,
                             std::vector<Index>* sources) {
  NodeReader reader(root, meshes, limits);
  if (sources) *sources = reader.sources();
  return std::move(reader).take();
}

}  // namespace pstrips::inline formats::gltf
