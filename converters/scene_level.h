#pragma once

#include <cstdint>
#include <queue>
#include <utility>
#include <vector>

#include "core/progressive_strips.h"

namespace pstrips::inline converters {

/// By how much each mesh is enlarged where it stands largest: over its instances, the largest
/// singular value of what the matrices of the node and its ancestors make together (translation and
/// last row aside). 1 for a mesh without an instance and where matrices are not finite.
///
/// cost  O(nodes + instances). Precondition: parents come before their children, nodes name meshes
///       below `meshes`.
std::vector<double> instance_scales(const Scene& scene, std::size_t meshes);

/// What all meshes of a file show together while its packets arrive.
///
/// The error of a scene is what a viewer sees of it: the largest of any mesh, each times the
/// mesh's instance_scales(). [spec/model.md §5]
class SceneLevel {
 public:
  /// The bases.
  explicit SceneLevel(const ProgressiveStrips& strips);
  /// The next packet of its mesh. Cost O(log meshes).
  void add(const Packet& packet);

  std::uint64_t vertices() const { return vertices_; }
  std::uint64_t triangles() const { return triangles_; }
  /// Of maps of strips; of maps of triangles none.
  std::uint64_t strips() const { return strips_; }
  double error() const { return errors_.largest(); }
  double one_sided_error() const { return one_sided_errors_.largest(); }

  /// Of one mesh: a packet's error times the scale; 0 where that is no number.
  static double scaled_error(const Packet& packet, double scale,
                             float Packet::*kind = &Packet::error);

 private:
  /// Scaled errors of one kind, those that packets have replaced included; the top is none of
  /// these.
  struct Errors {
    float Packet::*kind;
    std::priority_queue<std::pair<double, Index>> all{};
    double largest() const { return all.empty() ? 0 : all.top().first; }
  };
  void push(Errors& errors, Index mesh) const;

  Index strips_of(const Packet& packet) const {
    return has_strips_[packet.mesh] ? packet.strips : 0;
  }

  std::vector<bool> has_strips_;  ///< of each mesh: whether its map is one of strips
  std::vector<double> scale_;
  std::vector<Packet> now_;  ///< last packet, or base, of each mesh
  Errors errors_{&Packet::error}, one_sided_errors_{&Packet::one_sided_error};
  std::uint64_t vertices_ = 0, triangles_ = 0, strips_ = 0;
};

}  // namespace pstrips::inline converters
