#include "formats/gltf/primitives.h"

#include <algorithm>
#include <bit>
#include <map>
#include <numeric>
#include <set>

#include "core/equal_elements.h"
#include "formats/gltf/draco_primitive.h"

namespace pstrips::inline formats::gltf {
namespace {

tl::unexpected<Error> refuse(ErrorCode code, std::string message, std::string path) {
  return fail(code, std::move(message), kNoOffset, std::move(path));
}

/// Turns positions with one element a wedge into vertices, numbered as they first appear.
void weld(Mesh& mesh, unsigned threads) {
  const std::size_t size = mesh.position.element_bytes();
  std::vector<Index> vertex = first_equals(mesh.position.data, size, threads);
  Bytes& data = mesh.position.data;
  Index vertices = 0;
  for (Index w = 0; w < vertex.size(); ++w) {
    if (vertex[w] == w) {
      std::memmove(data.data() + vertices * size, data.data() + w * size, size);
      vertex[w] = vertices++;
    } else {
      vertex[w] = vertex[vertex[w]];
    }
  }
  data.resize(vertices * size);
  mesh.wedge_vertex = std::move(vertex);
}

FaceKind kind_of(Mode mode) {
  switch (mode) {
    case Mode::points:
      return FaceKind::points;
    case Mode::lines:
    case Mode::line_loop:
    case Mode::line_strip:
      return FaceKind::lines;
    default:
      return FaceKind::polygons;
  }
}

/// Appends the faces of one primitive over `count` indices; `wedge(i)` is the i-th.
class FaceWriter {
 public:
  FaceWriter(Mesh& mesh, Index group) : mesh_(mesh), group_(group) {}

  template <class Wedge>
  void write(Mode mode, std::size_t count, Wedge&& wedge) {
    switch (mode) {
      case Mode::points:
        for (std::size_t i = 0; i < count; ++i) face({wedge(i)});
        break;
      case Mode::lines:
        for (std::size_t i = 0; i + 1 < count; i += 2) face({wedge(i), wedge(i + 1)});
        break;
      case Mode::line_strip:
      case Mode::line_loop:
        if (count < 2) break;
        for (std::size_t i = 0; i < count; ++i) mesh_.corners.push_back(wedge(i));
        if (mode == Mode::line_loop) mesh_.corners.push_back(wedge(0));
        end_face();
        break;
      case Mode::triangles:
        triangles(count / 3, wedge);
        break;
      case Mode::strip:
        for (std::size_t i = 0; i + 2 < count; ++i) {
          const Index a = wedge(i), b = wedge(i + 1), c = wedge(i + 2);
          if (a == b || b == c || a == c) continue;
          if (i % 2 == 0)
            face({a, b, c});
          else
            face({b, a, c});
        }
        break;
      case Mode::fan:
        for (std::size_t i = 1; i + 1 < count; ++i) face({wedge(0), wedge(i), wedge(i + 1)});
        break;
    }
  }

 private:
  void face(std::initializer_list<Index> corners) {
    mesh_.corners.insert(mesh_.corners.end(), corners);
    end_face();
  }
  template <class Wedge>
  void triangles(std::size_t faces, Wedge&& wedge) {
    const std::size_t before = mesh_.corners.size();
    mesh_.corners.resize(before + 3 * faces);
    for (std::size_t i = 0; i < 3 * faces; ++i) mesh_.corners[before + i] = wedge(i);
    mesh_.face_group.resize(mesh_.face_group.size() + faces, group_);
  }
  void end_face() {
    mesh_.face_group.push_back(group_);
    if (mesh_.groups[group_].kind != FaceKind::polygons)
      mesh_.face_first.push_back(static_cast<Index>(mesh_.corners.size()));
  }
  Mesh& mesh_;
  Index group_;
};

/// At most how many corners a primitive of `count` indices makes.
std::uint64_t most_corners(Mode mode, std::uint64_t count) {
  const bool chained = mode == Mode::strip || mode == Mode::fan;
  return chained ? 3 * (count > 2 ? count - 2 : 0) : count + (mode == Mode::line_loop ? 1 : 0);
}

bool leaves_indices_over(Mode mode, std::uint64_t count) {
  if (mode == Mode::triangles) return count % 3 != 0;
  return mode == Mode::lines && count % 2 != 0;
}

/// A model's mesh in the making.
struct Draft {
  Index mesh = 0;                                   ///< in the model
  std::map<std::vector<Index>, Index> first_wedge;  ///< of each tuple of accessors
};

class MeshReader {
 public:
  MeshReader(Data& data, const Document& document, const Limits& limits, Budget& budget,
             std::vector<Mesh>& out, std::vector<std::string>& dropped)
      : data_(data),
        document_(document),
        budget_(budget),
        out_(out),
        dropped_(dropped),
        limits_(limits),
        wedges_left_(limits.wedges),
        corners_left_(limits.corners) {}

  Result<PrimitiveMap> read() {
    if (const Result<void> room = expect_room(); !room) return tl::unexpected(room.error());
    for (Index m = 0; m < document_.meshes.size(); ++m)
      if (const Result<void> read = read_mesh(m); !read) return tl::unexpected(read.error());
    return std::move(map_);
  }

 private:
  /// Refuses by the counts in the JSON alone, before a buffer is read. What several
  /// primitives share counts once, so that nothing is refused that would fit.
  Result<void> expect_room() const {
    constexpr std::uint64_t kHuge = std::uint64_t{1} << 36;  // a sum of such does not wrap
    const auto count_of = [&](Index accessor) {
      return std::min(document_.accessors[accessor].count, kHuge);
    };
    std::set<Index> seen, seen_positions;
    std::uint64_t wedges = 0, corners = 0, bytes = 0;
    for (const GltfMesh& mesh : document_.meshes)
      for (const Primitive& in : mesh.primitives) {
        if (!in.has_position()) continue;
        for (const auto& [name, i] : in.attributes) {
          if (name == "POSITION" && seen_positions.insert(i).second) wedges += count_of(i);
          if (seen.insert(i).second) bytes += count_of(i) * document_.accessors[i].element_bytes();
        }
        const bool indexed = in.indices != kNone;
        const std::uint64_t more =
            most_corners(in.mode, count_of(indexed ? in.indices : in.attributes.front().second));
        corners += more;
        bytes += more * 2 * sizeof(Index);
      }
    const auto over = [](std::uint64_t figure, std::string_view what, std::uint64_t limit) {
      return refuse(ErrorCode::over_limit, over_limit_message(figure, what, limit), "/meshes");
    };
    if (wedges > limits_.wedges) return over(wedges, "wedges", limits_.wedges);
    if (corners > limits_.corners) return over(corners, "face corners", limits_.corners);
    if (bytes > limits_.memory_bytes) return over(bytes, "bytes of memory", limits_.memory_bytes);
    return {};
  }

  Result<void> read_mesh(Index m) {
    const GltfMesh& in = document_.meshes[m];
    const std::size_t first_mesh = out_.size();
    drafts_.clear();
    map_.meshes.emplace_back();
    for (std::size_t p = 0; p < in.primitives.size(); ++p) {
      const std::string path = "/meshes/" + std::to_string(m) + "/primitives/" + std::to_string(p);
      if (auto read = read_primitive(in, in.primitives[p], path); !read) return read;
    }
    for (std::size_t i = first_mesh; i < out_.size(); ++i) {
      weld(out_[i], limits_.threads);
      if (out_[i].vertex_count() > limits_.vertices - vertices_)
        return refuse(
            ErrorCode::over_limit,
            over_limit_message(vertices_ + out_[i].vertex_count(), "vertices", limits_.vertices),
            "/meshes/" + std::to_string(m));
      vertices_ += out_[i].vertex_count();
      canonicalize(out_[i]);
    }
    return {};
  }

  Result<void> check(const Primitive& in, const std::string& path) const {
    const auto position =
        std::ranges::find(in.attributes, "POSITION", [](const auto& a) { return a.first; });
    const Accessor& positions = document_.accessors[position->second];
    if (positions.components != 3 || positions.type == ComponentType::u32)
      return refuse(ErrorCode::corrupt, "positions are not of a type for them", path);
    for (const auto& [name, accessor] : in.attributes) {
      if (document_.accessors[accessor].count != positions.count)
        return refuse(ErrorCode::corrupt, "attributes of different lengths",
                      path + "/attributes/" + name);
    }
    return {};
  }

  /// The mesh for primitives of this layout; a new one when there is none yet.
  Draft& draft_for(const GltfMesh& mesh, const Primitive& in) {
    std::string layout =
        std::to_string(static_cast<int>(kind_of(in.mode))) + ' ' + std::to_string(in.targets);
    for (const auto& [name, i] : in.attributes) {
      const Accessor& a = document_.accessors[i];
      for (const int number : {static_cast<int>(name.size()), static_cast<int>(a.type),
                               int{a.components}, int{a.rows}, int{a.normalized}})
        layout += ' ' + std::to_string(number);
      layout += name;
    }
    const auto [at, is_new] = drafts_.try_emplace(std::move(layout));
    if (is_new) {
      at->second.mesh = static_cast<Index>(out_.size());
      start_mesh(mesh, in);
    }
    return at->second;
  }

  void start_mesh(const GltfMesh& gltf_mesh, const Primitive& in) {
    Mesh& mesh = out_.emplace_back();
    PrimitiveMap::Layout& layout = map_.layouts.emplace_back();
    layout.targets = in.targets;
    mesh.name = gltf_mesh.name;
    if (kind_of(in.mode) != FaceKind::polygons) mesh.face_first.push_back(0);
    for (const auto& [name, i] : in.attributes) {
      const Accessor& a = document_.accessors[i];
      Attribute attribute{name, a.type, a.components, a.normalized, {}};
      if (a.rows == 2) layout.mat2.push_back(name);
      if (name == "POSITION")
        mesh.position = std::move(attribute);
      else
        mesh.wedge_attributes.push_back(std::move(attribute));
    }
  }

  /// Appends the elements of the primitive's accessors, unless they are there.
  Result<Index> add_wedges(const Primitive& in, Draft& draft, const std::string& path) {
    std::vector<Index> key;
    for (const auto& attribute : in.attributes) key.push_back(attribute.second);
    if (const auto known = draft.first_wedge.find(key); known != draft.first_wedge.end())
      return known->second;
    Mesh& mesh = out_[draft.mesh];
    const std::uint64_t count = document_.accessors[key.front()].count;
    const std::size_t first = mesh.position.elements();
    if (count > wedges_left_ || count > kMaxCount - first)
      return refuse(ErrorCode::over_limit,
                    over_limit_message(limits_.wedges - wedges_left_ + count, "wedges",
                                       std::min<std::uint64_t>(limits_.wedges, kMaxCount)),
                    path);
    wedges_left_ -= count;
    std::size_t next = 0;
    for (const auto& [name, accessor] : in.attributes) {
      Result<Bytes> bytes = read_attribute(data_, document_, accessor);
      if (!bytes) return tl::unexpected(std::move(bytes).error());
      Bytes& all = name == "POSITION" ? mesh.position.data : mesh.wedge_attributes[next++].data;
      if (all.empty())
        all = std::move(*bytes);
      else
        all.insert(all.end(), bytes->begin(), bytes->end());
    }
    draft.first_wedge.emplace(std::move(key), static_cast<Index>(first));
    return static_cast<Index>(first);
  }

  Result<void> read_primitive(const GltfMesh& gltf_mesh, const Primitive& in,
                              const std::string& path) {
    if (!in.has_position()) {
      map_.meshes.back().emplace_back();
      dropped_.push_back("faces of " + path + ", which has no positions");
      return {};
    }
    if (auto checked = check(in, path); !checked) return checked;
    if (++primitives_ > limits_.meshes)
      return refuse(ErrorCode::over_limit,
                    over_limit_message(primitives_, "primitives", limits_.meshes), path);
    const bool is_decoded = needs_draco(document_, in);
    if (is_decoded)
      if (auto read = read_draco(data_, document_, in, limits_, path); !read) return read;
    // A Draco payload holds triangles, whatever strips were made of.
    const Mode mode = is_decoded ? Mode::triangles : in.mode;
    Draft& draft = draft_for(gltf_mesh, in);
    const Result<Index> first = add_wedges(in, draft, path);
    if (!first) return tl::unexpected(first.error());
    Mesh& mesh = out_[draft.mesh];
    const auto group = static_cast<Index>(mesh.groups.size());
    mesh.groups.push_back({.name = {}, .material = in.material, .kind = kind_of(in.mode)});
    map_.meshes.back().push_back({draft.mesh, group});

    const std::uint64_t vertices = document_.accessors[in.attributes.front().second].count;
    const bool indexed = in.indices != kNone;
    const std::uint64_t count = indexed ? document_.accessors[in.indices].count : vertices;
    const std::uint64_t corners = most_corners(mode, count);
    if (leaves_indices_over(mode, count))
      dropped_.push_back("indices beyond whole faces of " + path);
    if (corners > corners_left_ || corners > kMaxCount - mesh.corners.size())
      return refuse(ErrorCode::over_limit,
                    over_limit_message(limits_.corners - corners_left_ + corners, "face corners",
                                       std::min<std::uint64_t>(limits_.corners, kMaxCount)),
                    path);
    corners_left_ -= corners;
    std::vector<Index> indices;
    if (indexed) {
      auto read = read_indices(data_, document_, in.indices, vertices);
      if (!read) return tl::unexpected(std::move(read).error());
      indices = std::move(*read);
    }
    if (!budget_.take(corners * 2 * sizeof(Index)))
      return refuse(ErrorCode::over_limit, budget_.refusal(corners * 2 * sizeof(Index)), path);
    FaceWriter faces(mesh, group);
    if (indexed)
      faces.write(mode, indices.size(), [&](std::size_t i) { return *first + indices[i]; });
    else
      faces.write(mode, vertices, [&](std::size_t i) { return *first + static_cast<Index>(i); });
    return {};
  }

  Data& data_;
  const Document& document_;
  Budget& budget_;
  std::vector<Mesh>& out_;
  std::vector<std::string>& dropped_;
  const Limits& limits_;
  std::uint64_t wedges_left_, corners_left_, vertices_ = 0, primitives_ = 0;
  std::map<std::string, Draft> drafts_;
  PrimitiveMap map_;
};

}  // namespace

Result<PrimitiveMap> read_meshes(Data& data, const Document& document, const Limits& limits,
                                 Budget& budget, std::vector<Mesh>& out,
                                 std::vector<std::string>& dropped) {
  return MeshReader(data, document, limits, budget, out, dropped).read();
}

Bytes PrimitiveMap::write() const {
  ByteWriter out;
  out.u32(static_cast<std::uint32_t>(meshes.size()));
  for (const auto& places : meshes) {
    out.u32(static_cast<std::uint32_t>(places.size()));
    for (const Place& place : places) {
      out.u32(place.mesh);
      out.u32(place.group);
    }
  }
  out.u32(static_cast<std::uint32_t>(layouts.size()));
  for (const Layout& layout : layouts) {
    out.u32(layout.targets);
    out.u32(static_cast<std::uint32_t>(layout.mat2.size()));
    for (const std::string& name : layout.mat2) out.string(name);
  }
  return std::move(out).take();
}

Result<PrimitiveMap> PrimitiveMap::read(ByteView bytes) {
  ByteReader in(bytes);
  PrimitiveMap out;
  out.meshes.resize(in.count(4));
  for (auto& places : out.meshes) {
    places.resize(in.count(8));
    for (Place& place : places) {
      place.mesh = in.u32();
      place.group = in.u32();
    }
  }
  out.layouts.resize(in.count(8));
  for (Layout& layout : out.layouts) {
    layout.targets = in.u32();
    layout.mat2.resize(in.count(4));
    for (std::string& name : layout.mat2) name = in.string(bytes.size());
  }
  in.expect_end();
  if (in.error()) return tl::unexpected(*in.error());
  return out;
}

bool PrimitiveMap::fits(const std::vector<Mesh>& model) const {
  if (layouts.size() != model.size()) return false;
  std::vector<std::vector<bool>> placed;
  for (const Mesh& mesh : model) placed.emplace_back(mesh.groups.size());
  for (const auto& places : meshes)
    for (const Place& place : places) {
      if (place.mesh == kNone) continue;
      if (place.mesh >= model.size() || place.group >= model[place.mesh].groups.size() ||
          placed[place.mesh][place.group])
        return false;
      placed[place.mesh][place.group] = true;
    }
  return std::ranges::all_of(placed, [](const auto& groups) {
    return std::ranges::all_of(groups, [](bool is_placed) { return is_placed; });
  });
}

}  // namespace pstrips::inline formats::gltf
