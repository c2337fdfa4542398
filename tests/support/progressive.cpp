#include "tests/support/progressive.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <random>

#include "codecs/weld/unweld.h"
#include "formats/pstrip/payload/digest.h"
#include "tests/support/random_welding.h"

namespace pstrips::test {
namespace {

class RandomSource {
 public:
  explicit RandomSource(std::uint32_t seed) : random_(seed) {}
  Index below(std::size_t n) { return static_cast<Index>(random_() % n); }
  bool one_in(std::size_t n) { return below(n) == 0; }
  void append(Bytes& bytes, std::size_t n) {
    for (; n > 0; --n) bytes.push_back(static_cast<std::byte>(below(256)));
  }
  template <class T>
  void shuffle(std::vector<T>& v) {
    for (std::size_t i = v.size(); i > 1; --i) std::swap(v[i - 1], v[below(i)]);
  }

 private:
  std::mt19937 random_;
};

/// Positions are small numbers, so that errors and bounds make sense to whoever reads them.
void append_position(RandomSource& random, const Attribute& format, Bytes& bytes) {
  for (int c = 0; c < format.count; ++c) {
    const float x = static_cast<float>(random.below(32)) / 4;
    const double d = x;
    const auto* at = format.type == ComponentType::f64 ? reinterpret_cast<const std::byte*>(&d)
                                                       : reinterpret_cast<const std::byte*>(&x);
    bytes.insert(bytes.end(), at, at + size_of(format.type));
  }
}

/// The mesh between two records. [spec/vsplit.md §3]
struct State {
  Bytes position;
  std::vector<Index> wedge_vertex;
  std::vector<Index> map;
  Index vertices = 0;
  /// List elements used.
  std::size_t offset_count = 0, reassigned = 0, map_offset = 0, new_corner = 0;
};

State base_state(const ProgressiveMesh& mesh) {
  State s;
  const std::size_t bytes = mesh.base_vertices * mesh.position.element_bytes();
  s.position.assign(mesh.position.data.begin(),
                    mesh.position.data.begin() + static_cast<std::ptrdiff_t>(bytes));
  s.wedge_vertex = mesh.base_wedge_vertex;
  if (mesh.single_wedges) {
    s.wedge_vertex.resize(mesh.base_wedges);
    std::iota(s.wedge_vertex.begin(), s.wedge_vertex.end(), Index{0});
  }
  s.map = mesh.base_map;
  s.vertices = mesh.base_vertices;
  return s;
}

void apply(State& s, const ProgressiveMesh& mesh, std::size_t record) {
  const Vsplit& split = mesh.vsplits[record];
  const Index v = s.vertices++;
  const std::size_t bytes = mesh.position.element_bytes();
  const ByteView own = mesh.position.element(v);
  s.position.insert(s.position.end(), own.begin(), own.end());
  if (mesh.placement == Placement::optimal)
    std::memcpy(s.position.data() + split.parent * bytes,
                mesh.parent_position.data() + record * bytes, bytes);
  for (Index k = 0; k < split.reassigned; ++k) s.wedge_vertex[mesh.reassigned[s.reassigned++]] = v;
  for (Index k = 0; k < split.wedges; ++k) {
    const auto wedge = static_cast<Index>(s.wedge_vertex.size());
    s.wedge_vertex.push_back(v);
    for (Index n = mesh.wedge_offset_counts[s.offset_count++]; n > 0; --n)
      s.map[mesh.map_offsets[s.map_offset++]] = wedge;
  }
  for (Index n = 3 * split.triangles; n > 0; --n) s.map.push_back(mesh.new_corners[s.new_corner++]);
}

struct Triangle {
  std::array<Index, 3> corners;
  std::size_t strip;
  std::size_t entry;  ///< of its first corner in the map
};

bool have_distinct_vertices(const State& s, const std::array<Index, 3>& c) {
  const Index a = s.wedge_vertex[c[0]], b = s.wedge_vertex[c[1]], d = s.wedge_vertex[c[2]];
  return a != b && b != d && a != d;
}

std::vector<Triangle> triangles_of_strips(const State& s) {
  const std::vector<Index> map = resolve(s.map).value();
  std::vector<Triangle> out;
  std::size_t begin = 0, strip = 0;
  for (std::size_t end = 0; end <= map.size(); ++end) {
    if (end < map.size() && map[end] != kRestart) continue;
    for (std::size_t i = begin; i + 2 < end; ++i) {
      std::array<Index, 3> c = {map[i], map[i + 1], map[i + 2]};
      if (!have_distinct_vertices(s, c)) continue;
      if ((i - begin) % 2 == 1) std::swap(c[0], c[1]);
      out.push_back({c, strip, i});
    }
    begin = end + 1;
    ++strip;
  }
  return out;
}

/// Of a map of triangles each is a strip of its own.
std::vector<Triangle> triangles_of(const State& s, const ProgressiveMesh& mesh) {
  if (mesh.encoding != MapEncoding::triangles) return triangles_of_strips(s);
  std::vector<Triangle> out;
  for (std::size_t i = 0; i < s.map.size(); i += 3)
    if (const std::array c{s.map[i], s.map[i + 1], s.map[i + 2]}; have_distinct_vertices(s, c))
      out.push_back({c, i / 3, i});
  return out;
}

Index strips_with_triangles(const std::vector<Triangle>& triangles) {
  Index strips = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    strips += i == 0 || triangles[i].strip != triangles[i - 1].strip;
  return strips;
}

Index group_at(const ProgressiveMesh& mesh, std::size_t entry) {
  if (mesh.encoding == MapEncoding::triangles)
    return mesh.triangle_group.empty() ? 0 : mesh.triangle_group[entry / 3];
  Index group = 0;
  for (std::size_t end = mesh.group_entries[0]; entry >= end; end += mesh.group_entries[++group]) {
  }
  return group;
}

/// Sets the counts of a level from a decoded state.
void count_level(const State& s, const ProgressiveMesh& mesh, Packet& level) {
  const std::vector<Triangle> triangles = triangles_of(s, mesh);
  level.vertices = s.vertices;
  level.triangles = static_cast<Index>(triangles.size());
  level.strips = strips_with_triangles(triangles);
}

void make_groups(RandomSource& random, const ProgressiveOptions& options, ProgressiveMesh& mesh) {
  const Index materials = options.scene ? 2 : 0;
  for (Index i = 0, n = 1 + random.below(2); i < n; ++i)
    mesh.groups.push_back({"part " + std::to_string(i),
                           materials > 0 && random.one_in(2) ? random.below(materials) : kNone,
                           FaceKind::polygons});
  if (options.faces) {
    mesh.groups.push_back({"edges", kNone, FaceKind::lines});
    mesh.groups.push_back({"", kNone, FaceKind::points});
  }
  mesh.group_entries.resize(mesh.groups.size());
}

void make_base(RandomSource& random, const ProgressiveOptions& options, ProgressiveMesh& mesh) {
  mesh.base_vertices = options.base_vertices;
  for (Index v = 0; v < mesh.base_vertices; ++v) {
    append_position(random, mesh.position, mesh.position.data);
    for (Index n = mesh.single_wedges ? 1 : 1 + random.below(2); n > 0; --n, ++mesh.base_wedges)
      if (!mesh.single_wedges) mesh.base_wedge_vertex.push_back(v);
  }
  if (mesh.base_wedges == 0) return;
  for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
    if (mesh.groups[g].kind != FaceKind::polygons) continue;
    if (mesh.encoding == MapEncoding::triangles) continue;
    const std::size_t before = mesh.base_map.size();
    for (Index n = 1 + random.below(3); n > 0; --n) {
      if (!mesh.base_map.empty()) mesh.base_map.push_back(kRestart);
      std::vector<Index> strip(3 + random.below(6));
      for (Index& entry : strip) entry = random.below(mesh.base_wedges);
      if (mesh.encoding == MapEncoding::offset)
        for (Index& entry : strip) {
          const Index wedge = entry;
          constexpr int kDistances[] = {-2, -1, 1, 2};
          if (random.one_in(3)) entry = symbol_of(kDistances[random.below(4)]);
          if (!resolve(strip)) entry = wedge;
        }
      mesh.base_map.insert(mesh.base_map.end(), strip.begin(), strip.end());
    }
    // The restart before the group's first strip belongs to the group before.
    const std::size_t entries = mesh.base_map.size() - before;
    mesh.group_entries[g] += static_cast<Index>(entries - (g > 0 ? 1 : 0));
    if (g > 0) ++mesh.group_entries[g - 1];
  }
}

/// Appends up to `most` triangles of distinct vertices; returns how many.
Index append_triangles(RandomSource& random, const std::vector<Index>& wedge_vertex, Index most,
                       std::vector<Index>& corners, ProgressiveMesh& mesh) {
  Index added = 0;
  for (Index n = wedge_vertex.empty() ? 0 : most; n > 0; --n) {
    const std::array<Index, 3> c = {random.below(wedge_vertex.size()),
                                    random.below(wedge_vertex.size()),
                                    random.below(wedge_vertex.size())};
    const Index a = wedge_vertex[c[0]], b = wedge_vertex[c[1]], d = wedge_vertex[c[2]];
    if (a == b || b == d || a == d) continue;
    corners.insert(corners.end(), c.begin(), c.end());
    Index group = 0;
    do group = random.below(mesh.groups.size());
    while (mesh.groups[group].kind != FaceKind::polygons);
    if (mesh.groups.size() > 1) mesh.triangle_group.push_back(group);
    mesh.group_entries[group] += 3;
    ++added;
  }
  return added;
}

void make_vsplit(RandomSource& random, const State& s, ProgressiveMesh& mesh) {
  const bool own = s.vertices == 0 || random.one_in(8);
  Vsplit split{own ? s.vertices : random.below(s.vertices), 0, 0, 0};
  append_position(random, mesh.position, mesh.position.data);
  if (mesh.placement == Placement::optimal) {
    if (own) {
      const ByteView same = mesh.position.element(s.vertices);
      mesh.parent_position.insert(mesh.parent_position.end(), same.begin(), same.end());
    } else {
      append_position(random, mesh.position, mesh.parent_position);
    }
  }
  const auto belongs = [&](Index wedge) {
    return wedge != kRestart && s.wedge_vertex[wedge] == split.parent;
  };
  Index staying = 0;
  for (Index w = 0; w < s.wedge_vertex.size(); ++w) staying += belongs(w);
  if (!mesh.single_wedges)
    for (Index w = 0; w < s.wedge_vertex.size(); ++w)
      if (belongs(w) && staying > 1 && random.one_in(3)) {
        mesh.reassigned.push_back(w);
        ++split.reassigned;
        --staying;
      }
  split.wedges = mesh.single_wedges || split.reassigned == 0 ? 1 : 0;
  if (!mesh.single_wedges) split.wedges += random.below(2);
  std::vector<std::vector<Index>> map_offsets(split.wedges);
  const std::vector<Index> resolved = resolve(s.map).value();
  for (Index i = 0; i < resolved.size() && split.wedges > 0; ++i)
    if (belongs(resolved[i]) && !random.one_in(3))
      map_offsets[random.below(split.wedges)].push_back(i);
  for (const std::vector<Index>& of_wedge : map_offsets) {
    mesh.wedge_offset_counts.push_back(static_cast<Index>(of_wedge.size()));
    mesh.map_offsets.insert(mesh.map_offsets.end(), of_wedge.begin(), of_wedge.end());
    split.map_offsets += static_cast<Index>(of_wedge.size());
    for (Attribute& a : mesh.wedge_attributes) random.append(a.data, a.element_bytes());
  }
  if (mesh.encoding == MapEncoding::triangles && !own) {
    std::vector<Index> wedge_vertex = s.wedge_vertex;
    for (std::size_t r = mesh.reassigned.size() - split.reassigned; r < mesh.reassigned.size(); ++r)
      wedge_vertex[mesh.reassigned[r]] = s.vertices;
    wedge_vertex.insert(wedge_vertex.end(), split.wedges, s.vertices);
    split.triangles =
        append_triangles(random, wedge_vertex, random.below(4), mesh.new_corners, mesh);
  }
  mesh.vsplits.push_back(split);
}

void make_faces(RandomSource& random, const std::vector<Triangle>& triangles,
                ProgressiveMesh& mesh) {
  FaceTable& faces = mesh.faces;
  if (mesh.wedges > 0) {
    faces.first = faces.replaced_first = {0};
    const auto add = [&](Index corners, Index group) {
      for (; corners > 0; --corners) faces.corners.push_back(random.below(mesh.wedges));
      faces.first.push_back(static_cast<Index>(faces.corners.size()));
      faces.group.push_back(group);
      faces.replaced_first.push_back(static_cast<Index>(faces.replaced.size()));
    };
    // A quadrangle for the first two neighbours of one group.
    for (Index t = 1; t < triangles.size(); ++t) {
      const Index group = group_at(mesh, triangles[t].entry);
      if (group_at(mesh, triangles[t - 1].entry) != group) continue;
      faces.replaced = {t, t - 1};
      add(4, group);
      break;
    }
    const auto groups = static_cast<Index>(mesh.groups.size());
    add(3, 0);
    add(2 + random.below(3), groups - 2);
    add(1, groups - 1);
  }
  mesh.face_attribute_formats.push_back({"_FACE_ID", ComponentType::u16, 1, false, {}});
  faces.attributes = mesh.face_attribute_formats;
  random.append(faces.attributes[0].data,
                2 * (triangles.size() - faces.replaced.size() + faces.count()));
}

void make_order(RandomSource& random, ProgressiveMesh& mesh) {
  const auto permutation = [&](std::size_t n) {
    std::vector<Index> out(n);
    std::iota(out.begin(), out.end(), Index{0});
    random.shuffle(out);
    return out;
  };
  mesh.order.vertex = permutation(mesh.decoded_vertices());
  if (mesh.orders_wedges()) mesh.order.wedge = permutation(mesh.decoded_wedges());
  const std::size_t triangles = mesh.triangles - mesh.faces.replaced.size();
  mesh.order.face = permutation(triangles + mesh.faces.count());
  for (std::size_t f = 0; f < mesh.order.face.size(); ++f)
    mesh.order.rotation.push_back(static_cast<std::uint8_t>(random.below(
        f < triangles ? 3
                      : mesh.faces.first[f - triangles + 1] - mesh.faces.first[f - triangles])));
}

ProgressiveMesh make_mesh(RandomSource& random, const ProgressiveOptions& options, Index index) {
  ProgressiveMesh mesh;
  mesh.name = "mesh " + std::to_string(index);
  mesh.encoding = options.encoding;
  mesh.placement = options.placement;
  mesh.single_wedges = options.single_wedges;
  mesh.position = {
      "POSITION", random.one_in(4) ? ComponentType::f64 : ComponentType::f32, 3, false, {}};
  if (!options.single_wedges || random.one_in(2))
    mesh.wedge_attributes.push_back({"TEXCOORD_0", ComponentType::f32, 2, false, {}});
  if (random.one_in(3))
    mesh.wedge_attributes.push_back({"COLOR_0", ComponentType::u8, 3, true, {}});
  make_groups(random, options, mesh);
  make_base(random, options, mesh);
  for (Attribute& a : mesh.wedge_attributes)
    random.append(a.data, a.element_bytes() * mesh.base_wedges);
  State s = base_state(mesh);
  if (mesh.encoding == MapEncoding::triangles) {
    append_triangles(random, s.wedge_vertex, 4, mesh.base_map, mesh);
    s.map = mesh.base_map;
  }
  for (std::size_t i = 0; i < options.vsplits; ++i) {
    make_vsplit(random, s, mesh);
    apply(s, mesh, i);
  }
  const std::vector<Triangle> triangles = triangles_of(s, mesh);
  mesh.vertices = s.vertices;
  mesh.wedges = static_cast<Index>(s.wedge_vertex.size());
  mesh.triangles = static_cast<Index>(triangles.size());
  mesh.strips = strips_with_triangles(triangles);
  if (options.faces) make_faces(random, triangles, mesh);
  const bool is_welded = options.welding && mesh.wedges > 0;
  if (is_welded)
    mesh.welding = random_welding(decode_slowly(mesh, mesh.vsplits.size()), random.below(1u << 31));
  if (options.order) make_order(random, mesh);
  if (options.digest) {
    const Mesh shown = decode_slowly(mesh, mesh.vsplits.size());
    const Digest d = digest(is_welded ? unweld(shown, mesh.welding).value() : shown);
    mesh.digest.assign(d.begin(), d.end());
  }
  return mesh;
}

void make_packets(RandomSource& random, const ProgressiveOptions& options,
                  ProgressiveStrips& strips) {
  for (Index m = 0; m < strips.meshes.size(); ++m) {
    const auto vsplits = static_cast<Index>(strips.meshes[m].vsplits.size());
    float error = vsplits == 0 ? 0.f : 16.f;
    strips.bases.push_back({.mesh = m, .error = error, .one_sided_error = error / 2});
    for (Index first = 0; first < vsplits; first += options.packet_vsplits) {
      const Index n = std::min(options.packet_vsplits, vsplits - first);
      error = first + n == vsplits ? 0.f : error * static_cast<float>(1 + random.below(8)) / 8;
      strips.packets.push_back({.mesh = m,
                                .first_vsplit = first,
                                .vsplits = n,
                                .error = error,
                                .one_sided_error = error / 2});
    }
  }
  std::ranges::stable_sort(strips.packets, std::ranges::greater{}, &Packet::error);
}

void make_scene(RandomSource& random, ProgressiveStrips& strips) {
  strips.generator = "tests";
  Scene& scene = strips.scene;
  scene.materials = {{.name = "red", .base_color = {1, 0.25, 0, 1}, .maps = {{.image = 1}}},
                     {.name = "glow", .emissive = {0.5, 0.5, 2}, .double_sided = true}};
  scene.materials[1].alpha_mode = AlphaMode::mask;
  scene.materials[1].set_map({.role = MapRole::normal,
                              .image = 0,
                              .texcoord = 1,
                              .strength = 0.5,
                              .offset = {0.25, -1},
                              .scale = {2, 3},
                              .rotation = -1.5});
  scene.texture_origin = TextureOrigin::lower_left;
  scene.images = {{"wood", "textures/wood.png", "", {}}, {"", "", "image/png", {}}};
  random.append(scene.images[1].data, 5);
  scene.nodes.resize(2);
  scene.nodes[0].name = "root";
  scene.nodes[1].parent = 0;
  scene.nodes[1].matrix[12] = -2.5;
  for (Index m = 0; m < strips.meshes.size(); ++m) scene.nodes[m % 2].meshes.push_back(m);
  scene.foreign = {{"ply/comments", {}}, {"gltf/extras", {}}};
  random.append(scene.foreign[1].data, 11);
}

}  // namespace

ProgressiveStrips random_progressive(std::uint32_t seed, const ProgressiveOptions& options) {
  RandomSource random(seed);
  ProgressiveStrips strips;
  for (Index m = 0; m < options.meshes; ++m) strips.meshes.push_back(make_mesh(random, options, m));
  make_packets(random, options, strips);
  recount_levels(strips);
  if (options.scene) make_scene(random, strips);
  if (options.unknown)
    for (const std::size_t bytes : {0, 5}) {
      strips.unknown.push_back({{'x', 'Y', 'Z', bytes == 0 ? 'a' : 'B'}, {}});
      random.append(strips.unknown.back().payload, bytes);
    }
  return strips;
}

ProgressiveStrips random_progressive_of_any_kind(std::uint32_t seed) {
  RandomSource random(seed);
  ProgressiveOptions options;
  options.meshes = random.below(4);
  options.base_vertices = random.below(7);
  options.vsplits = random.below(9);
  options.packet_vsplits = 1 + random.below(4);
  options.encoding = static_cast<MapEncoding>(random.below(3));
  options.placement = static_cast<Placement>(random.below(2));
  for (bool* choice : {&options.single_wedges, &options.scene, &options.faces, &options.order,
                       &options.digest, &options.unknown, &options.welding})
    *choice = random.one_in(2);
  return random_progressive(random.below(1u << 31), options);
}

Mesh decode_slowly(const ProgressiveMesh& mesh, std::size_t vsplits) {
  State s = base_state(mesh);
  for (std::size_t i = 0; i < vsplits; ++i) apply(s, mesh, i);
  Mesh out;
  out.name = mesh.name;
  out.groups = mesh.groups;
  out.position = mesh.position;
  out.position.data = s.position;
  out.wedge_vertex = s.wedge_vertex;
  out.wedge_attributes = mesh.wedge_attributes;
  for (Attribute& a : out.wedge_attributes)
    a.data.resize(a.element_bytes() * s.wedge_vertex.size());

  const bool full = vsplits == mesh.vsplits.size();
  const std::vector<Triangle> triangles = triangles_of(s, mesh);
  out.face_first = {0};
  for (Index t = 0; t < triangles.size(); ++t) {
    if (full && std::ranges::find(mesh.faces.replaced, t) != mesh.faces.replaced.end()) continue;
    out.corners.insert(out.corners.end(), triangles[t].corners.begin(), triangles[t].corners.end());
    out.face_first.push_back(static_cast<Index>(out.corners.size()));
    out.face_group.push_back(group_at(mesh, triangles[t].entry));
  }
  if (full) {
    for (Index f = 0; f < mesh.faces.count(); ++f) {
      for (Index c = mesh.faces.first[f]; c < mesh.faces.first[f + 1]; ++c)
        out.corners.push_back(mesh.faces.corners[c]);
      out.face_first.push_back(static_cast<Index>(out.corners.size()));
      out.face_group.push_back(mesh.faces.group[f]);
    }
    out.face_attributes = mesh.faces.attributes;
  }
  canonicalize(out);
  return out;
}

void recount_levels(ProgressiveStrips& strips) {
  for (Index m = 0; m < strips.meshes.size(); ++m) {
    State s = base_state(strips.meshes[m]);
    count_level(s, strips.meshes[m], strips.bases[m]);
    for (Packet& packet : strips.packets) {
      if (packet.mesh != m) continue;
      for (std::size_t i = 0; i < packet.vsplits; ++i)
        apply(s, strips.meshes[m], packet.first_vsplit + i);
      count_level(s, strips.meshes[m], packet);
    }
  }
}

}  // namespace pstrips::test
