#include "formats/pstrip/payload/check.h"

#include <algorithm>
#include <numeric>

namespace pstrips::inline formats {
namespace {

/// Keeps every sum of array sizes within 64 bits. [spec/model.md M-006]
constexpr std::size_t kMaxAttributes = 1024;

tl::unexpected<Error> corrupt(std::string message, std::string path) {
  return fail(ErrorCode::corrupt, std::move(message), kNoOffset, std::move(path));
}

std::string mesh_path(Index mesh) { return "/meshes/" + std::to_string(mesh); }

std::string item_path(Index mesh, const char* list, std::size_t i) {
  return mesh_path(mesh) + "/" + list + "/" + std::to_string(i);
}

Result<void> check_format(const Attribute& a, const std::string& path) {
  if (a.count == 0) return corrupt("attribute without components", path);
  if (static_cast<std::size_t>(a.type) > static_cast<std::size_t>(ComponentType::f64))
    return corrupt("attribute of unknown type", path);
  return {};
}

/// Bounds of n runs over `size` items: from 0, never falling, to `size`; no list at all for n = 0.
bool are_bounds(const std::vector<Index>& first, std::size_t n, std::size_t size) {
  if (n == 0) return first.empty() && size == 0;
  return first.size() == n + 1 && first.front() == 0 && first.back() == size &&
         std::ranges::is_sorted(first);
}

/// The first element that is not below `end`, or the size.
std::size_t first_not_below(std::span<const Index> list, Index end) {
  return static_cast<std::size_t>(std::ranges::find_if(list, [&](Index i) { return i >= end; }) -
                                  list.begin());
}

Result<void> check_permutation(std::span<const Index> list, Index count, Index mesh,
                               const char* name) {
  if (list.size() != count)
    return corrupt("order has not one entry for each element", mesh_path(mesh) + "/order");
  std::vector<bool> named(count);
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i] >= count)
      return corrupt("order names an element past the end", item_path(mesh, name, i));
    if (named[list[i]]) return corrupt("order names an element twice", item_path(mesh, name, i));
    named[list[i]] = true;
  }
  return {};
}

/// Packets in file order against the vsplits of each mesh.
Result<void> check_packets(const ProgressiveStrips& strips) {
  const auto meshes = static_cast<Index>(strips.meshes.size());
  if (strips.bases.size() != strips.meshes.size())
    return corrupt("not one base for each mesh", "/bases");
  std::vector<PacketStart> reached;
  for (Index m = 0; m < meshes; ++m) {
    const BaseLevel& base = strips.bases[m];
    if (base.mesh != m || base.first_vsplit != 0 || base.vsplits != 0 ||
        base.vertices != strips.meshes[m].base_vertices)
      return corrupt("base level contradicts its mesh", "/bases/" + std::to_string(m));
    reached.push_back(first_packet(strips.meshes[m]));
  }
  for (std::size_t k = 0; k < strips.packets.size(); ++k) {
    const Packet& packet = strips.packets[k];
    const std::string path = "/packets/" + std::to_string(k);
    if (packet.mesh >= meshes) return corrupt("packet names a mesh past the end", path);
    const ProgressiveMesh& mesh = strips.meshes[packet.mesh];
    PacketStart& start = reached[packet.mesh];
    if (packet.first_vsplit != start.vsplit)
      return corrupt("packet does not continue where the one before ends", path);
    if (packet.vsplits > mesh.vsplits.size() - start.vsplit)
      return corrupt("packet has more vsplits than its mesh", path);
    if (packet.vertices != start.vertices + packet.vsplits)
      return corrupt("packet contradicts its vertex count", path);
    const PacketStart end = packet_after(mesh, start, packet.vsplits);
    if (Result<void> ok = check_packet(strips, packet.mesh, start, end); !ok) return ok;
    start = end;
  }
  for (Index m = 0; m < meshes; ++m) {
    const ProgressiveMesh& mesh = strips.meshes[m];
    const PacketStart& end = reached[m];
    if (end.vsplit != mesh.vsplits.size() || end.offset_count != mesh.wedge_offset_counts.size() ||
        end.reassigned != mesh.reassigned.size() || end.map_offset != mesh.map_offsets.size())
      return corrupt("lists do not end with the last packet", mesh_path(m));
    if (strips.complete && (end.vertices != mesh.vertices || end.wedges != mesh.wedges))
      return corrupt("packets do not bring all vertices and wedges", mesh_path(m));
    const auto wrong = [](const Attribute& a, Index n) {
      return a.data.size() != a.element_bytes() * n;
    };
    if (wrong(mesh.position, end.vertices) ||
        std::ranges::any_of(mesh.wedge_attributes,
                            [&](const Attribute& a) { return wrong(a, end.wedges); }))
      return corrupt("attribute has not one element for each vertex or wedge", mesh_path(m));
    const std::size_t moved = mesh.placement == Placement::optimal ? end.vsplit : 0;
    if (mesh.parent_position.size() != moved * mesh.position.element_bytes())
      return corrupt("not one parent position for each vsplit", mesh_path(m));
  }
  return {};
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
  }
  return end;
}

Index face_count(const ProgressiveMesh& mesh) {
  return static_cast<Index>(mesh.triangles - mesh.faces.replaced.size() + mesh.faces.count());
}

Result<void> check_mesh_header(const ProgressiveStrips& strips, Index index, Index map_entries) {
  const ProgressiveMesh& mesh = strips.meshes[index];
  if (Result<void> ok = check_format(mesh.position, mesh_path(index) + "/position"); !ok) return ok;
  for (std::size_t i = 0; i < mesh.wedge_attributes.size(); ++i) {
    const std::string path = item_path(index, "wedge_attributes", i);
    if (Result<void> ok = check_format(mesh.wedge_attributes[i], path); !ok) return ok;
  }
  for (std::size_t i = 0; i < mesh.face_attribute_formats.size(); ++i) {
    const std::string path = item_path(index, "face_attributes", i);
    if (Result<void> ok = check_format(mesh.face_attribute_formats[i], path); !ok) return ok;
  }
  if (std::max(mesh.wedge_attributes.size(), mesh.face_attribute_formats.size()) > kMaxAttributes)
    return corrupt("more than 1024 attributes of a kind", mesh_path(index));
  if (mesh.groups.empty() || mesh.groups.size() != mesh.group_entries.size())
    return corrupt("mesh without a group", mesh_path(index));
  std::uint64_t entries = 0;
  for (std::size_t i = 0; i < mesh.groups.size(); ++i) {
    const Group& group = mesh.groups[i];
    if (group.material != kNone && group.material >= strips.scene.materials.size())
      return corrupt("group names a material past the end", item_path(index, "groups", i));
    entries += mesh.group_entries[i];
  }
  if (entries != map_entries)
    return corrupt("groups do not add up to the index map", mesh_path(index));
  if (std::max({mesh.vertices, mesh.wedges, mesh.triangles, mesh.strips, map_entries}) > kMaxCount)
    return corrupt("count exceeds what an index can name", mesh_path(index));
  if (mesh.triangles > map_entries || mesh.strips > map_entries)
    return corrupt("more triangles or strips than index-map entries", mesh_path(index));
  if (mesh.base_vertices > mesh.vertices || mesh.base_wedges > mesh.wedges)
    return corrupt("base is larger than the mesh", mesh_path(index));
  if (mesh.single_wedges &&
      (mesh.wedges != mesh.vertices || mesh.base_wedges != mesh.base_vertices))
    return corrupt("single wedges, yet more or fewer wedges than vertices", mesh_path(index));
  return {};
}

Result<void> check_base(const ProgressiveStrips& strips, Index index) {
  const ProgressiveMesh& mesh = strips.meshes[index];
  if (mesh.base_wedge_vertex.size() != (mesh.single_wedges ? 0 : mesh.base_wedges))
    return corrupt("not one vertex for each base wedge", mesh_path(index));
  if (const std::size_t i = first_not_below(mesh.base_wedge_vertex, mesh.base_vertices);
      i < mesh.base_wedge_vertex.size())
    return corrupt("wedge names a vertex past the end", item_path(index, "base_wedge_vertex", i));
  for (std::size_t i = 0; i < mesh.base_map.size(); ++i) {
    const Index entry = mesh.base_map[i];
    if (entry < mesh.base_wedges || entry == kRestart) continue;
    if (is_wedge(entry))
      return corrupt("index map names a wedge past the end", item_path(index, "base_map", i));
    if (mesh.encoding == MapEncoding::naive)
      return corrupt("symbol in a naive index map", item_path(index, "base_map", i));
  }
  // Records write wedges only, so chains that end in the base end at every level.
  if (mesh.encoding == MapEncoding::offset)
    if (const auto resolved = resolve(mesh.base_map); !resolved)
      return corrupt(resolved.error().message,
                     item_path(index, "base_map", resolved.error().offset));
  return {};
}

Result<void> check_packet(const ProgressiveStrips& strips, Index index, const PacketStart& start,
                          const PacketStart& end) {
  const ProgressiveMesh& mesh = strips.meshes[index];
  if (end.vertices > mesh.vertices || end.wedges > mesh.wedges ||
      end.wedges - start.wedges != end.offset_count - start.offset_count)
    return corrupt("more vertices or wedges than the mesh has", mesh_path(index));
  if (end.offset_count > mesh.wedge_offset_counts.size() ||
      end.reassigned > mesh.reassigned.size() || end.map_offset > mesh.map_offsets.size())
    return corrupt("list ends before the records do", mesh_path(index));
  PacketStart at = start;
  for (std::size_t i = start.vsplit; i < end.vsplit; ++i) {
    const Vsplit& v = mesh.vsplits[i];
    const auto bad = [&](const char* message) {
      return corrupt(message, item_path(index, "vsplits", i));
    };
    if (v.parent > at.vertices) return bad("vsplit names a parent past its own vertex");
    if (v.parent == at.vertices && v.reassigned != 0)
      return bad("vertex of its own takes over wedges");
    if (mesh.single_wedges && (v.wedges != 1 || v.reassigned != 0))
      return bad("single wedges, yet the vsplit has not one wedge");
    for (std::size_t c = at.reassigned; c < at.reassigned + v.reassigned; ++c)
      if (mesh.reassigned[c] >= at.wedges) return bad("reassigned wedge is past the end");
    std::uint64_t map_offsets = 0;
    for (std::size_t w = at.offset_count; w < at.offset_count + v.wedges; ++w)
      map_offsets += mesh.wedge_offset_counts[w];
    if (map_offsets != v.map_offsets) return bad("map offsets of the wedges do not add up");
    for (std::size_t p = at.map_offset; p < at.map_offset + v.map_offsets; ++p) {
      if (mesh.map_offsets[p] >= mesh.base_map.size())
        return bad("map offset is past the end of the map");
      if (mesh.base_map[mesh.map_offsets[p]] == kRestart)
        return bad("map offset is that of a restart");
    }
    at = {i + 1,
          at.offset_count + v.wedges,
          at.reassigned + v.reassigned,
          at.map_offset + v.map_offsets,
          at.vertices + 1,
          at.wedges + v.wedges};
  }
  return {};
}

Result<void> check_faces(const ProgressiveStrips& strips, Index index) {
  const ProgressiveMesh& mesh = strips.meshes[index];
  const FaceTable& faces = mesh.faces;
  const auto bad = [&](const char* message) {
    return corrupt(message, mesh_path(index) + "/faces");
  };
  const std::size_t n = faces.count();
  if (!are_bounds(faces.first, n, faces.corners.size()))
    return bad("face bounds do not partition the corners");
  if (!are_bounds(faces.replaced_first, n, faces.replaced.size()))
    return bad("face bounds do not partition the replaced triangles");
  if (faces.group.size() != n) return bad("not one group for each face");
  if (faces.replaced.size() > mesh.triangles) return bad("more triangles replaced than there are");
  if (std::uint64_t{mesh.triangles} - faces.replaced.size() + n > kMaxCount)
    return bad("count exceeds what an index can name");
  if (first_not_below(faces.corners, mesh.wedges) < faces.corners.size())
    return bad("face names a wedge past the end");
  if (first_not_below(faces.group, static_cast<Index>(mesh.groups.size())) < n)
    return bad("face names a group past the end");
  if (first_not_below(faces.replaced, mesh.triangles) < faces.replaced.size())
    return bad("face replaces a triangle past the end");
  std::vector<bool> is_replaced(faces.replaced.empty() ? 0 : mesh.triangles);
  for (const Index t : faces.replaced) {
    if (is_replaced[t]) return bad("triangle is replaced twice");
    is_replaced[t] = true;
  }
  if (faces.attributes.size() != mesh.face_attribute_formats.size())
    return bad("face attributes are not those of the mesh");
  for (std::size_t i = 0; i < faces.attributes.size(); ++i) {
    const Attribute& a = faces.attributes[i];
    if (!a.same_format(mesh.face_attribute_formats[i]))
      return bad("face attributes are not those of the mesh");
    if (a.data.size() != a.element_bytes() * face_count(mesh))
      return bad("face attribute has not one element for each face");
  }
  return {};
}

Result<void> check_order(const ProgressiveStrips& strips, Index index) {
  const ProgressiveMesh& mesh = strips.meshes[index];
  const OriginalOrder& order = mesh.order;
  const Index faces = face_count(mesh);
  if (order == OriginalOrder{}) return {};
  if (Result<void> ok = check_permutation(order.vertex, mesh.vertices, index, "order/vertex"); !ok)
    return ok;
  if (Result<void> ok = check_permutation(order.wedge, mesh.single_wedges ? 0 : mesh.wedges, index,
                                          "order/wedge");
      !ok)
    return ok;
  if (Result<void> ok = check_permutation(order.face, faces, index, "order/face"); !ok) return ok;
  if (order.rotation.size() != faces)
    return corrupt("not one rotation for each face", mesh_path(index) + "/order");
  const std::size_t triangles = faces - mesh.faces.count();
  for (std::size_t f = 0; f < faces; ++f) {
    const Index corners =
        f < triangles ? 3 : mesh.faces.first[f - triangles + 1] - mesh.faces.first[f - triangles];
    if (order.rotation[f] >= std::max<Index>(corners, 1))
      return corrupt("rotation is past the last corner", item_path(index, "order/rotation", f));
  }
  return {};
}

Result<void> check_scene(const ProgressiveStrips& strips) {
  const Scene& scene = strips.scene;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    const std::string path = "/scene/nodes/" + std::to_string(i);
    if (node.parent != kNone && node.parent >= i)
      return corrupt("node does not come after its parent", path);
    if (first_not_below(node.meshes, static_cast<Index>(strips.meshes.size())) < node.meshes.size())
      return corrupt("node names a mesh past the end", path);
  }
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const Index image = scene.materials[i].base_color_image;
    if (image != kNone && image >= scene.images.size())
      return corrupt("material names an image past the end",
                     "/scene/materials/" + std::to_string(i));
  }
  return {};
}

Result<void> check(const ProgressiveStrips& strips) {
  if (Result<void> ok = check_scene(strips); !ok) return ok;
  for (Index m = 0; m < strips.meshes.size(); ++m) {
    const ProgressiveMesh& mesh = strips.meshes[m];
    if (mesh.base_map.size() > kMaxCount)
      return corrupt("count exceeds what an index can name", mesh_path(m));
    const auto entries = static_cast<Index>(mesh.base_map.size());
    if (Result<void> ok = check_mesh_header(strips, m, entries); !ok) return ok;
    if (Result<void> ok = check_base(strips, m); !ok) return ok;
  }
  if (Result<void> ok = check_packets(strips); !ok) return ok;
  for (Index m = 0; m < strips.meshes.size(); ++m) {
    const ProgressiveMesh& mesh = strips.meshes[m];
    const bool expected = strips.complete && !mesh.face_attribute_formats.empty();
    if (expected || !mesh.faces.empty())
      if (Result<void> ok = check_faces(strips, m); !ok) return ok;
    if (Result<void> ok = check_order(strips, m); !ok) return ok;
    if (!mesh.digest.empty() && mesh.digest.size() != 32)
      return corrupt("digest is not of 32 bytes", mesh_path(m));
  }
  return {};
}

}  // namespace pstrips::inline formats
