#pragma once

#include <array>
#include <cstdint>
#include <iterator>
#include <string_view>

namespace pstrips::inline formats {

/// What the bytes of a file are spent on.
enum class Part : std::uint8_t {
  container,       ///< signature, chunk headers, padding, CRC, heads of payloads, PSHD, PEND
  mesh_header,     ///< MESH
  packet_index,    ///< PIDX
  base_positions,  ///< positions of the base vertices
  base_wedges,     ///< wedge lists and attributes of the base wedges
  base_map,        ///< the index map
  parents,         ///< which vertex each vsplit splits
  counts,          ///< wedges, reassigned wedges and map offsets of each record
  connectivity,    ///< how a split parts the faces of its vertex
  positions,       ///< of the new vertices
  parent_positions,
  tangential,     ///< steps from a vertex to the new one, along the surface
  normal,         ///< steps along its normal
  attributes,     ///< of the new wedges
  wedges,         ///< which corners show them, and the groups of triangles
  reassigned,     ///< wedges taken over
  map_offsets,    ///< index-map offsets
  new_triangles,  ///< what vsplits append to a map of triangles
  fine,           ///< FINE: bits below the cells that packets bring
  faces,          ///< fACE
  welding,        ///< wELD
  order,          ///< oRDP
  digest,         ///< dGST
  scene,          ///< sCNE, mTRL
  images,         ///< iMGE
  foreign,        ///< fRGN
  unknown,        ///< chunks that this build does not know
};

/// What a report sums parts up to, in the order in which it lists them.
enum class PartGroup : std::uint8_t {
  names,
  connectivity,
  positions,
  tangential,
  normal,
  wedges,
  attributes,
  strips,
  base,
  fine,
  faces,
  order,
  scene,
  container,
};
inline constexpr std::size_t kPartGroups = 14;

struct PartDescription {
  Part part;
  std::string_view name;
  PartGroup group;
};
/// One a part, in the order of the enumeration.
inline constexpr PartDescription kParts[] = {
    {Part::container, "container", PartGroup::container},
    {Part::mesh_header, "mesh_header", PartGroup::container},
    {Part::packet_index, "packet_index", PartGroup::container},
    {Part::base_positions, "base_positions", PartGroup::base},
    {Part::base_wedges, "base_wedges", PartGroup::base},
    {Part::base_map, "base_map", PartGroup::base},
    {Part::parents, "parents", PartGroup::names},
    {Part::counts, "counts", PartGroup::strips},
    {Part::connectivity, "connectivity", PartGroup::connectivity},
    {Part::positions, "positions", PartGroup::positions},
    {Part::parent_positions, "parent_positions", PartGroup::positions},
    {Part::tangential, "tangential", PartGroup::tangential},
    {Part::normal, "normal", PartGroup::normal},
    {Part::attributes, "attributes", PartGroup::attributes},
    {Part::wedges, "wedges", PartGroup::wedges},
    {Part::reassigned, "reassigned", PartGroup::wedges},
    {Part::map_offsets, "map_offsets", PartGroup::strips},
    {Part::new_triangles, "new_triangles", PartGroup::connectivity},
    {Part::fine, "fine", PartGroup::fine},
    {Part::faces, "faces", PartGroup::faces},
    {Part::welding, "welding", PartGroup::faces},
    {Part::order, "order", PartGroup::order},
    {Part::digest, "digest", PartGroup::container},
    {Part::scene, "scene", PartGroup::scene},
    {Part::images, "images", PartGroup::scene},
    {Part::foreign, "foreign", PartGroup::scene},
    {Part::unknown, "unknown", PartGroup::scene},
};

/// Bits of each part.
using PartBits = std::array<double, std::size(kParts)>;

constexpr std::string_view name_of(Part part) {
  return kParts[static_cast<std::size_t>(part)].name;
}
constexpr PartGroup group_of(Part part) { return kParts[static_cast<std::size_t>(part)].group; }

struct PartGroupName {
  std::string_view key, label;  ///< of reports for programs and for people
};
constexpr PartGroupName name_of(PartGroup group) {
  constexpr PartGroupName kNames[kPartGroups] = {
      {"names", "names"},
      {"connectivity", "connectivity"},
      {"positions", "positions"},
      {"tangential", "positions, tangential"},
      {"normal", "positions, normal"},
      {"wedges", "wedges"},
      {"attributes", "attributes"},
      {"strips", "strips"},
      {"base", "base"},
      {"fine", "bits below the cells"},
      {"faces", "faces"},
      {"order", "original order"},
      {"scene", "scene and images"},
      {"container", "container"},
  };
  return kNames[static_cast<std::size_t>(group)];
}

}  // namespace pstrips::inline formats
