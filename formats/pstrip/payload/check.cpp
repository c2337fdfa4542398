#include "formats/pstrip/payload/check.h"

#include <algorithm>

#include "formats/pstrip/payload/compact/cells.h"
#include "formats/pstrip/payload/predicates.h"

namespace pstrips::inline formats {
namespace {

/// Reports faults of one mesh.
class MeshFaults {
 public:
  MeshFaults(Index mesh, FaultSink& faults) : mesh_(mesh), faults_(faults) {}

  bool report(Fault fault, Field field = Field::mesh, std::uint64_t element = 0) {
    faults_.report(fault, {.field = field, .mesh = mesh_, .element = element}, {});
    return false;
  }
  bool in_record(Fault fault, std::size_t record) {
    faults_.report(
        fault, {.field = Field::record, .mesh = mesh_, .record = static_cast<Index>(record)}, {});
    return false;
  }
  /// For the predicates: reports the element and stops.
  auto at(Fault fault, Field field) {
    return [this, fault, field](std::size_t i) { return report(fault, field, i); };
  }

 private:
  Index mesh_;
  FaultSink& faults_;
};

bool check_format(const Attribute& a, Field field, std::size_t i, MeshFaults& faults) {
  if (a.count == 0) return faults.report(Fault::no_components, field, i);
  if (static_cast<std::size_t>(a.type) > static_cast<std::size_t>(ComponentType::f64))
    return faults.report(Fault::type_undefined, field, i);
  return true;
}

bool check_formats(const ProgressiveMesh& mesh, MeshFaults& faults) {
  if (!check_format(mesh.position, Field::position_format, 0, faults)) return false;
  for (std::size_t i = 0; i < mesh.wedge_attributes.size(); ++i)
    if (!check_format(mesh.wedge_attributes[i], Field::wedge_format, i, faults)) return false;
  for (std::size_t i = 0; i < mesh.face_attribute_formats.size(); ++i)
    if (!check_format(mesh.face_attribute_formats[i], Field::face_format, i, faults)) return false;
  if (std::max(mesh.wedge_attributes.size(), mesh.face_attribute_formats.size()) > kMaxAttributes)
    return faults.report(Fault::attribute_count);
  return true;
}

bool check_counts(const ProgressiveMesh& mesh, Index map_entries, MeshFaults& faults) {
  if (std::max({mesh.vertices, mesh.wedges, mesh.triangles, mesh.strips, map_entries}) > kMaxCount)
    return faults.report(Fault::count_too_large);
  if (mesh.triangles > map_entries || mesh.strips > map_entries)
    return faults.report(Fault::entry_count);
  if (mesh.encoding == MapEncoding::triangles && full_map_entries(mesh) != map_entries)
    return faults.report(Fault::triangle_entries);
  if (mesh.base_vertices > mesh.vertices || mesh.base_wedges > mesh.wedges)
    return faults.report(Fault::base_too_large);
  if (mesh.single_wedges &&
      (mesh.wedges != mesh.vertices || mesh.base_wedges != mesh.base_vertices))
    return faults.report(Fault::single_wedge_counts);
  return true;
}

/// What the profile of the file asks of a mesh.
bool check_profile(const ProgressiveMesh& mesh, Profile profile, MeshFaults& faults) {
  if (profile == Profile::plain) return true;
  if (mesh.encoding != MapEncoding::triangles) return faults.report(Fault::profile_encoding);
  return (mesh.position.count == 3 && PositionCells::is_valid(mesh.grid, mesh.position.type)) ||
         faults.report(Fault::position_grid, Field::position_format);
}

bool check_permutation(std::span<const Index> list, Index count, Fault fault, Field field,
                       MeshFaults& faults) {
  if (list.size() != count) return faults.report(fault, Field::order);
  return is_permutation(list, count, faults.at(fault, field));
}

/// How many triangles the map has when `new_corners` of those that vsplits bring are there.
std::size_t triangles_there(const ProgressiveMesh& mesh, std::size_t new_corners) {
  return (mesh.base_map.size() + new_corners) / 3;
}

/// Groups of the triangles [begin, end).
bool check_triangle_groups(const ProgressiveMesh& mesh, std::size_t begin, std::size_t end,
                           MeshFaults& faults) {
  if (!has_triangle_groups(mesh)) return true;
  if (mesh.triangle_group.size() < end) return faults.report(Fault::list_length);
  return all_below(std::span(mesh.triangle_group).subspan(begin, end - begin), mesh.groups.size(),
                   [&](std::size_t t) {
                     return faults.report(Fault::triangle_group, Field::triangle_group, begin + t);
                   });
}

/// The map of the base, entry by entry.
bool check_base_map(const ProgressiveMesh& mesh, MeshFaults& faults) {
  for (std::size_t i = 0; i < mesh.base_map.size(); ++i) {
    const Index entry = mesh.base_map[i];
    if (entry < mesh.base_wedges) continue;
    if (is_wedge(entry)) return faults.report(Fault::map_entry, Field::base_map, i);
    if (entry != kRestart && mesh.encoding != MapEncoding::offset)
      return faults.report(Fault::map_symbol, Field::base_map, i);
    if (entry == kRestart && mesh.encoding == MapEncoding::triangles)
      return faults.report(Fault::map_triangles, Field::base_map, i);
  }
  if (mesh.encoding != MapEncoding::triangles) return true;
  if (mesh.base_map.size() % 3 != 0) return faults.report(Fault::map_triangles, Field::base);
  if (mesh.base_map.size() > full_map_entries(mesh)) return faults.report(Fault::triangle_growth);
  return check_triangle_groups(mesh, 0, triangles_there(mesh, 0), faults);
}

/// Map offsets and new triangles of the record that starts at `at`, its wedges being there.
Fault fault_of_map_changes(const ProgressiveMesh& mesh, const Vsplit& v, const PacketStart& at) {
  const bool grows = mesh.encoding == MapEncoding::triangles;
  const std::size_t entries = mesh.base_map.size() + at.new_corner;
  for (std::size_t p = at.map_offset; p < at.map_offset + v.map_offsets; ++p) {
    if (mesh.map_offsets[p] >= entries) return Fault::offset_past_end;
    if (!grows && mesh.base_map[mesh.map_offsets[p]] == kRestart) return Fault::offset_is_restart;
  }
  const auto corners =
      std::span(mesh.new_corners).subspan(at.new_corner, std::size_t{3} * v.triangles);
  return all_below(corners, std::uint64_t{at.wedges} + v.wedges, [](std::size_t) { return false; })
             ? Fault::none
             : Fault::corner_not_there;
}

/// One packet against the records of its mesh; `start` becomes its end.
bool follow_packet(const ProgressiveStrips& strips, std::size_t number, PacketStart& start,
                   FaultSink& faults) {
  const Packet& packet = strips.packets[number];
  const ProgressiveMesh& mesh = strips.meshes[packet.mesh];
  const auto broken = [&](Fault fault) {
    faults.report(fault, {.field = Field::packet, .packet = static_cast<Index>(number)}, {});
    return false;
  };
  if (packet.first_vsplit != start.vsplit) return broken(Fault::packet_not_next);
  if (packet.vsplits > mesh.vsplits.size() - start.vsplit) return broken(Fault::list_length);
  if (packet.vertices != start.vertices + packet.vsplits) return broken(Fault::row_vertices);
  const PacketStart end = packet_after(mesh, start, packet.vsplits);
  if (!check_packet(strips, packet.mesh, start, end, faults)) return false;
  start = end;
  return true;
}

/// The lists of a mesh end where its packets, or the base without any, have brought it.
bool check_ends(const ProgressiveMesh& mesh, const PacketStart& end, bool complete,
                MeshFaults& faults) {
  if (end.vsplit != mesh.vsplits.size() || end.offset_count != mesh.wedge_offset_counts.size() ||
      end.reassigned != mesh.reassigned.size() || end.map_offset != mesh.map_offsets.size() ||
      end.new_corner != mesh.new_corners.size())
    return faults.report(Fault::list_length);
  if (mesh.triangle_group.size() !=
      (has_triangle_groups(mesh) ? triangles_there(mesh, end.new_corner) : 0))
    return faults.report(Fault::list_length);
  if (complete && (end.vertices != mesh.vertices || end.wedges != mesh.wedges))
    return faults.report(Fault::vsplits_missing);
  if (complete && mesh.base_map.size() + end.new_corner != full_map_entries(mesh))
    return faults.report(Fault::triangle_growth);
  const auto is_wrong = [](const Attribute& a, Index n) {
    return a.data.size() != a.element_bytes() * n;
  };
  if (is_wrong(mesh.position, end.vertices) ||
      std::ranges::any_of(mesh.wedge_attributes,
                          [&](const Attribute& a) { return is_wrong(a, end.wedges); }))
    return faults.report(Fault::list_length);
  const std::size_t moved = mesh.placement == Placement::optimal ? end.vsplit : 0;
  if (mesh.parent_position.size() != moved * mesh.position.element_bytes())
    return faults.report(Fault::list_length);
  return true;
}

/// Packets in file order against the vsplits of each mesh.
bool check_packets(const ProgressiveStrips& strips, FaultSink& faults) {
  const auto meshes = static_cast<Index>(strips.meshes.size());
  const auto broken = [&](Fault fault, const Where& where) {
    faults.report(fault, where, {});
    return false;
  };
  if (strips.bases.size() != strips.meshes.size())
    return broken(Fault::base_chunks, {.field = Field::base});
  std::vector<PacketStart> reached;
  for (Index m = 0; m < meshes; ++m) {
    const BaseLevel& base = strips.bases[m];
    if (base.mesh != m || base.first_vsplit != 0 || base.vsplits != 0 ||
        base.vertices != strips.meshes[m].base_vertices)
      return broken(Fault::base_counts, {.field = Field::base, .mesh = m});
    reached.push_back(first_packet(strips.meshes[m]));
  }
  for (std::size_t k = 0; k < strips.packets.size(); ++k) {
    if (strips.packets[k].mesh >= meshes)
      return broken(Fault::packet_mesh, {.field = Field::packet, .packet = static_cast<Index>(k)});
    if (!follow_packet(strips, k, reached[strips.packets[k].mesh], faults)) return false;
  }
  for (Index m = 0; m < meshes; ++m) {
    MeshFaults of_mesh(m, faults);
    if (!check_ends(strips.meshes[m], reached[m], strips.complete, of_mesh)) return false;
  }
  return true;
}

bool check_mesh(const ProgressiveStrips& strips, Index m, FaultSink& faults) {
  const ProgressiveMesh& mesh = strips.meshes[m];
  if (full_map_entries(mesh) > kMaxCount)
    return MeshFaults(m, faults).report(Fault::count_too_large);
  const auto entries = static_cast<Index>(full_map_entries(mesh));
  return check_mesh_header(strips, m, entries, faults) && check_base(strips, m, faults);
}

bool check_welding(const ProgressiveMesh& mesh, Index m, FaultSink& faults) {
  return has_possible_welding(mesh) ||
         MeshFaults(m, faults).report(Fault::welding_counts, Field::welding);
}

bool check_extras(const ProgressiveStrips& strips, Index m, FaultSink& faults) {
  const ProgressiveMesh& mesh = strips.meshes[m];
  const bool expected = strips.complete && !mesh.face_attribute_formats.empty();
  if ((expected || !mesh.faces.empty()) && !check_faces(strips, m, faults)) return false;
  if (!check_welding(mesh, m, faults) || !check_order(strips, m, faults)) return false;
  constexpr std::size_t kDigestBytes = 32;
  if (!mesh.digest.empty() && mesh.digest.size() != kDigestBytes)
    return MeshFaults(m, faults).report(Fault::digest_length);
  return true;
}

bool check_all(const ProgressiveStrips& strips, FaultSink& faults) {
  const auto meshes = static_cast<Index>(strips.meshes.size());
  if (!check_scene(strips, faults)) return false;
  for (Index m = 0; m < meshes; ++m)
    if (!check_mesh(strips, m, faults)) return false;
  if (!check_packets(strips, faults)) return false;
  for (Index m = 0; m < meshes; ++m)
    if (!check_extras(strips, m, faults)) return false;
  return true;
}

}  // namespace

PacketStart first_packet(const ProgressiveMesh& mesh) {
  return {.vertices = mesh.base_vertices, .wedges = mesh.base_wedges};
}

PacketStart packet_after(const ProgressiveMesh& mesh, const PacketStart& start, Index vsplits) {
  PacketStart end = start;
  end.vsplit += vsplits;
  end.vertices += vsplits;
  for (std::size_t i = start.vsplit; i < end.vsplit; ++i) {
    const Vsplit& v = mesh.vsplits[i];
    end.offset_count += v.wedges;
    end.wedges += v.wedges;
    end.reassigned += v.reassigned;
    end.map_offset += v.map_offsets;
    end.new_corner += std::size_t{3} * v.triangles;
  }
  return end;
}

Index face_count(const ProgressiveMesh& mesh) {
  return static_cast<Index>(mesh.triangles - mesh.faces.replaced.size() + mesh.faces.count());
}

bool check_mesh_header(const ProgressiveStrips& strips, Index index, Index map_entries,
                       FaultSink& sink) {
  const ProgressiveMesh& mesh = strips.meshes[index];
  MeshFaults faults(index, sink);
  if (!check_formats(mesh, faults) || !check_profile(mesh, strips.profile, faults)) return false;
  if (mesh.groups.empty() || mesh.groups.size() != mesh.group_entries.size())
    return faults.report(Fault::group_missing);
  for (std::size_t i = 0; i < mesh.groups.size(); ++i) {
    const Index material = mesh.groups[i].material;
    if (material != kNone && material >= strips.scene.materials.size())
      return faults.report(Fault::group_material, Field::group, i);
  }
  if (sum_of_group_entries(mesh) != map_entries) return faults.report(Fault::group_entries);
  return check_counts(mesh, map_entries, faults);
}

bool check_base(const ProgressiveStrips& strips, Index index, FaultSink& sink) {
  const ProgressiveMesh& mesh = strips.meshes[index];
  MeshFaults faults(index, sink);
  if (mesh.base_wedge_vertex.size() != (mesh.single_wedges ? 0 : mesh.base_wedges))
    return faults.report(Fault::list_length);
  if (!all_below(mesh.base_wedge_vertex, mesh.base_vertices,
                 faults.at(Fault::wedge_vertex, Field::base_wedge_vertex)))
    return false;
  if (!check_base_map(mesh, faults)) return false;
  // Records write wedges only, so chains that end in the base end at every level.
  if (mesh.encoding == MapEncoding::offset)
    if (const auto resolved = resolve(mesh.base_map); !resolved)
      return faults.report(Fault::symbol_chain, Field::base_map, resolved.error().offset);
  return true;
}

bool check_packet(const ProgressiveStrips& strips, Index index, const PacketStart& start,
                  const PacketStart& end, FaultSink& sink) {
  const ProgressiveMesh& mesh = strips.meshes[index];
  MeshFaults faults(index, sink);
  if (end.vertices > mesh.vertices) return faults.report(Fault::vsplit_count);
  if (end.wedges > mesh.wedges ||
      end.wedges - start.wedges != end.offset_count - start.offset_count)
    return faults.report(Fault::wedge_count);
  if (end.offset_count > mesh.wedge_offset_counts.size() ||
      end.reassigned > mesh.reassigned.size() || end.map_offset > mesh.map_offsets.size() ||
      end.new_corner > mesh.new_corners.size())
    return faults.report(Fault::list_length);
  if (end.new_corner != start.new_corner &&
      mesh.base_map.size() + end.new_corner > full_map_entries(mesh))
    return faults.report(Fault::triangle_growth);
  PacketStart at = start;
  for (std::size_t i = start.vsplit; i < end.vsplit; ++i) {
    const Vsplit& v = mesh.vsplits[i];
    const auto broken = [&](Fault fault) { return faults.in_record(fault, i); };
    if (v.parent > at.vertices) return broken(Fault::parent_not_there);
    if (v.parent == at.vertices && v.reassigned != 0)
      return broken(Fault::isolated_vertex_reassigns);
    if (mesh.single_wedges && (v.wedges != 1 || v.reassigned != 0))
      return broken(Fault::packet_single_wedges);
    for (std::size_t c = at.reassigned; c < at.reassigned + v.reassigned; ++c)
      if (mesh.reassigned[c] >= at.wedges) return broken(Fault::reassigned_not_there);
    std::uint64_t map_offsets = 0;
    for (std::size_t w = at.offset_count; w < at.offset_count + v.wedges; ++w)
      map_offsets += mesh.wedge_offset_counts[w];
    if (map_offsets != v.map_offsets) return broken(Fault::packet_offsets);
    if (const Fault fault = fault_of_map_changes(mesh, v, at); fault != Fault::none)
      return broken(fault);
    at = {i + 1,
          at.offset_count + v.wedges,
          at.reassigned + v.reassigned,
          at.map_offset + v.map_offsets,
          at.new_corner + std::size_t{3} * v.triangles,
          at.vertices + 1,
          at.wedges + v.wedges};
  }
  return check_triangle_groups(mesh, triangles_there(mesh, start.new_corner),
                               triangles_there(mesh, end.new_corner), faults);
}

bool check_faces(const ProgressiveStrips& strips, Index index, FaultSink& sink) {
  const ProgressiveMesh& mesh = strips.meshes[index];
  const FaceTable& faces = mesh.faces;
  const auto broken = [&](Fault fault) {
    return MeshFaults(index, sink).report(fault, Field::faces);
  };
  const auto stop = [](std::size_t) { return false; };
  const std::size_t n = faces.count(), bounds = n == 0 ? 0 : n + 1;
  if (faces.first.size() != bounds || !are_bounds(faces.first, faces.corners.size(), stop))
    return broken(Fault::face_bounds);
  if (faces.replaced_first.size() != bounds ||
      !are_bounds(faces.replaced_first, faces.replaced.size(), stop))
    return broken(Fault::replaced_bounds);
  if (faces.group.size() != n) return broken(Fault::list_length);
  if (faces.replaced.size() > mesh.triangles) return broken(Fault::replaced_twice);
  if (std::uint64_t{mesh.triangles} - faces.replaced.size() + n > kMaxCount)
    return broken(Fault::count_too_large);
  if (!all_below(faces.corners, mesh.wedges, stop)) return broken(Fault::face_corner);
  if (!all_below(faces.group, mesh.groups.size(), stop)) return broken(Fault::face_group);
  if (!all_below(faces.replaced, mesh.triangles, stop)) return broken(Fault::replaced_triangle);
  if (!all_differ(faces.replaced, mesh.triangles, stop)) return broken(Fault::replaced_twice);
  if (faces.attributes.size() != mesh.face_attribute_formats.size())
    return broken(Fault::faces_missing);
  for (std::size_t i = 0; i < faces.attributes.size(); ++i) {
    const Attribute& a = faces.attributes[i];
    if (!a.same_format(mesh.face_attribute_formats[i])) return broken(Fault::list_length);
    if (a.data.size() != a.element_bytes() * face_count(mesh)) return broken(Fault::face_elements);
  }
  return true;
}

bool check_order(const ProgressiveStrips& strips, Index index, FaultSink& sink) {
  const ProgressiveMesh& mesh = strips.meshes[index];
  const OriginalOrder& order = mesh.order;
  MeshFaults faults(index, sink);
  const Index faces = face_count(mesh);
  if (order == OriginalOrder{}) return true;
  if (!check_permutation(order.vertex, mesh.decoded_vertices(), Fault::order_vertex,
                         Field::order_vertex, faults) ||
      !check_permutation(order.wedge, mesh.orders_wedges() ? mesh.decoded_wedges() : 0,
                         Fault::order_wedge, Field::order_wedge, faults) ||
      !check_permutation(order.face, faces, Fault::order_face, Field::order_face, faults))
    return false;
  if (order.rotation.size() != faces) return faults.report(Fault::rotation, Field::order);
  const std::size_t triangles = faces - mesh.faces.count();
  for (std::size_t f = 0; f < faces; ++f)
    if (!is_rotation(order.rotation[f], corners_of_face(mesh.faces, triangles, f)))
      return faults.report(Fault::rotation, Field::rotation, f);
  return true;
}

bool check_scene(const ProgressiveStrips& strips, FaultSink& faults) {
  const Scene& scene = strips.scene;
  const auto broken = [&](Fault fault, Field field, std::size_t i) {
    faults.report(fault, {.field = field, .element = i}, {});
    return false;
  };
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    if (node.parent != kNone && node.parent >= i) return broken(Fault::node_parent, Field::node, i);
    if (!all_below(node.meshes, strips.meshes.size(), [](std::size_t) { return false; }))
      return broken(Fault::node_mesh, Field::node, i);
  }
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const std::vector<TextureMap>& maps = scene.materials[i].maps;
    for (const TextureMap& map : maps)
      if (map.image >= scene.images.size())
        return broken(Fault::material_image, Field::material, i);
    if (std::ranges::adjacent_find(maps, std::ranges::greater_equal{}, &TextureMap::role) !=
        maps.end())
      return broken(Fault::material_map_twice, Field::material, i);
  }
  return true;
}

Result<void> check(const ProgressiveStrips& strips) {
  FirstFault faults;
  if (check_all(strips, faults)) return {};
  return tl::unexpected<Error>(error_of(*faults.first()));
}

}  // namespace pstrips::inline formats
