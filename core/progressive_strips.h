#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh.h"
#include "core/profile.h"
#include "core/scene.h"
#include "core/strips.h"

namespace pstrips::inline core {

enum class MapEncoding : std::uint8_t {
  naive = 0,   ///< every entry is a wedge or a restart [Kim04 §3.2]
  offset = 1,  ///< entries may be symbols [Kim04 §3.3]
  /// Three wedges a triangle and no restarts; the map grows, vsplits append the triangles that they
  /// bring. Strips are made anew for each level that is drawn.
  triangles = 2,
};

enum class Placement : std::uint8_t {
  subset = 0,   ///< half-edge collapses: the parent stays where it is
  optimal = 1,  ///< each vsplit moves its parent too [Skabek11 §3.3]
};

/// How much a decoder of the compact profile works for fewer bits. [spec/compact.md §6]
enum class Effort : std::uint8_t {
  fast = 0,
  small = 1,  ///< several times as slow
};

/// One refinement step. The new vertex takes the next free index, as do its new wedges.
/// [Kim04 §3.2 eq. 2; spec/vsplit.md]
struct Vsplit {
  /// The vertex that is split, or the new vertex's own index: it appears on its own.
  Index parent;
  Index wedges;       ///< how many new wedges the new vertex brings
  Index reassigned;   ///< how many wedges it takes over from the parent
  Index map_offsets;  ///< how many index-map entries are rewritten, over all new wedges
  /// How many triangles are appended to the map, after the entries are rewritten; 0 unless the map
  /// is one of triangles.
  Index triangles = 0;
  friend bool operator==(const Vsplit&, const Vsplit&) = default;
};

/// What the strips cannot say of the faces of the full-resolution mesh. Triangle t is the t-th
/// triangle of the final index map (for_each_triangle). [spec/model.md §6]
struct FaceTable {
  /// Faces with corners of their own: polygons, lines, points and degenerate triangles, each with
  /// the triangles of the map that it replaces (none for what strips cannot show).
  std::vector<Index> first;           ///< first corner of each and one past the end; empty: none
  std::vector<Index> corners;         ///< wedges
  std::vector<Index> group;           ///< one each
  std::vector<Index> replaced_first;  ///< first replaced triangle of each and one past the end
  std::vector<Index> replaced;        ///< triangles, each at most once
  /// One element a face: triangles that nothing replaces in map order, then the faces above.
  std::vector<Attribute> attributes;

  Index count() const { return first.empty() ? 0 : static_cast<Index>(first.size() - 1); }
  bool empty() const { return first.empty() && attributes.empty(); }
  friend bool operator==(const FaceTable&, const FaceTable&) = default;
};

/// Where each decoded vertex, wedge and face stood in the original; permutations.
struct OriginalOrder {
  std::vector<Index> vertex, wedge, face;
  std::vector<std::uint8_t> rotation;  ///< per decoded face: which of its corners was the first
  friend bool operator==(const OriginalOrder&, const OriginalOrder&) = default;
};

/// What base and records take for one vertex or one wedge though the decoded mesh has several: they
/// stand at one place, and these wedges say the same. [spec/model.md §11]
struct Welding {
  Index vertices = 0, wedges = 0;  ///< of the decoded mesh; 0: nothing is welded
  // A number for each wedge that stands for several, ascending.
  std::vector<Index> skip;  ///< how many that stand for themselves come before it
  std::vector<Index> more;  ///< how many it stands for, less two
  /// Of each corner of such a wedge: 0 for the next of those that it stands for (the last when all
  /// have been named), else one more than the number of one that has been named.
  std::vector<Index> corner;
  /// Of each decoded wedge that shares its welded vertex with others: 0 for a vertex of its own,
  /// else one more than the number of one that came there before.
  std::vector<Index> vertex;
  std::vector<Index> moved;  ///< decoded vertices that stand elsewhere than welded, ascending
  Attribute moved_position;  ///< where

  bool empty() const { return wedges == 0; }
  friend bool operator==(const Welding&, const Welding&) = default;
};

/// A grid on which positions lie, or nearly. [spec/compact.md §3]
struct PositionGrid {
  float step = 0;  ///< in model units; 0: there is no grid
  /// Grid coordinates are counted from here, in steps.
  std::array<std::int64_t, 3> origin{};
  /// Positions are the very points of the grid. Otherwise the grid tells which of its cells, of
  /// which zero is in the middle of one, a coordinate is in, and `step` is a power of two.
  bool exact = true;
  friend bool operator==(const PositionGrid&, const PositionGrid&) = default;
};

/// A mesh as base and vertex splits. [spec/model.md]
///
/// `position` and `wedge_attributes` hold the elements of all vertices and wedges in the order in
/// which they appear, base first, so that a prefix of the file fills a prefix of each array.
struct ProgressiveMesh {
  std::string name;
  MapEncoding encoding = MapEncoding::naive;
  Placement placement = Placement::subset;
  /// No wedge lists at all: wedge i is vertex i, each vsplit brings one wedge and reassigns none.
  bool single_wedges = true;
  std::vector<Group> groups;
  /// Index-map entries (restarts included) of each group, in order; of a map of triangles, how many
  /// there are of each at full resolution, in any order.
  std::vector<Index> group_entries;

  Effort effort = Effort::fast;  ///< has a meaning in the compact profile only
  PositionGrid grid;             ///< of the compact profile
  Attribute position;
  std::vector<Attribute> wedge_attributes;
  std::vector<Attribute> face_attribute_formats;  ///< formats only; data is in `faces`

  // Base.
  Index base_vertices = 0;
  Index base_wedges = 0;
  std::vector<Index> base_wedge_vertex;  ///< base_wedges entries; empty when single_wedges
  std::vector<Index> base_map;           ///< of full length from the start, unless of triangles

  // Vertex splits, and their lists one after the other.
  std::vector<Vsplit> vsplits;
  Bytes parent_position;  ///< with optimal placement: the parent's position after each split
  /// Per new wedge, with single wedges too: how many entries it is written to.
  std::vector<Index> wedge_offset_counts;
  std::vector<Index> map_offsets;  ///< map offsets, ascending within a wedge
  std::vector<Index> reassigned;   ///< wedges taken over
  std::vector<Index> new_corners;  ///< wedges, three for each triangle that is appended to the map
  /// Of a map of triangles, a group for each, the base's first; empty: all are in group 0.
  std::vector<Index> triangle_group;

  // At full resolution.
  Index vertices = 0, wedges = 0, triangles = 0, strips = 0;
  FaceTable faces;
  Welding welding;
  OriginalOrder order;            ///< empty lists: the order was not kept
  std::vector<std::byte> digest;  ///< SHA-256 of the decoded mesh, or empty

  /// Of the decoded mesh.
  Index decoded_vertices() const { return welding.empty() ? vertices : welding.vertices; }
  Index decoded_wedges() const { return welding.empty() ? wedges : welding.wedges; }
  /// Whether vertices of the decoded mesh have wedges in an order of their own.
  bool orders_wedges() const { return !single_wedges || !welding.empty(); }

  friend bool operator==(const ProgressiveMesh&, const ProgressiveMesh&) = default;
};

/// The unit of delivery: consecutive vsplits of one mesh, and what is reached after them.
struct Packet {
  Index mesh = 0;
  Index first_vsplit = 0;
  Index vsplits = 0;
  /// Of that mesh after the packet; strips with triangles.
  Index vertices = 0, triangles = 0, strips = 0;
  // Bounds of the distance to the full-resolution mesh after the packet, model units, not rising
  // within a mesh, 0 after its last packet. [spec/model.md §5]
  float error = 0;            ///< two-sided, the Hausdorff distance: what levels are chosen by
  float one_sided_error = 0;  ///< from the full-resolution mesh to the level; at most `error`
  friend bool operator==(const Packet&, const Packet&) = default;
};

/// What stands in the file before the packets of a mesh; its level is level 0.
using BaseLevel = Packet;  // with vsplits == 0

/// A chunk that this build does not know but keeps.
struct UnknownChunk {
  std::array<char, 4> type{};
  Bytes payload;
  friend bool operator==(const UnknownChunk&, const UnknownChunk&) = default;
};

/// A whole file in memory. [spec/model.md §1]
struct ProgressiveStrips {
  std::string generator;  ///< who wrote the file
  Profile profile = Profile::plain;
  Scene scene;
  std::vector<ProgressiveMesh> meshes;
  std::vector<BaseLevel> bases;  ///< one a mesh, in mesh order
  std::vector<Packet> packets;   ///< in file order; of each mesh in vsplit order
  std::vector<UnknownChunk> unknown;
  /// False when the file ended early: then the meshes hold what the whole packets brought.
  bool complete = true;
  friend bool operator==(const ProgressiveStrips&, const ProgressiveStrips&) = default;
};

}  // namespace pstrips::inline core
