#include "formats/obj/model.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <optional>

#include "core/color_range.h"
#include "formats/obj/mtl.h"
#include "formats/obj/obj.h"
#include "formats/obj/wedges.h"

namespace pstrips::inline formats::obj {
namespace {

class ModelMaker {
 public:
  ModelMaker(Statements in, const Limits& limits, const ObjReadOptions& options)
      : in_(std::move(in)), limits_(limits), options_(options) {}

  Result<Model> make() && {
    if (!build()) return tl::unexpected(*error_);
    return std::move(model_);
  }

 private:
  bool refuse(std::string message) {
    error_ = Error{ErrorCode::over_limit, std::move(message), 0, "line 1"};
    return false;
  }

  bool build() {
    count_unused_tuples();
    note_missing("vt", in_.geometry.texcoords.missing);
    note_missing("vn", in_.geometry.normals.missing);
    model_.scene.texture_origin = TextureOrigin::lower_left;
    // Wedges are numbered in 32 bits.
    if (const std::uint64_t most = in_.geometry.corner_vertex.size() + in_.geometry.vertices.count;
        most > kMaxCount)
      return refuse(over_limit_message(most, "corners and vertices", kMaxCount));
    WedgeTable wedges =
        build_wedges({.vertex_count = static_cast<Index>(in_.geometry.vertices.count),
                      .corner_vertex = in_.geometry.corner_vertex,
                      .corner_texcoord = in_.geometry.corner_texcoord,
                      .corner_normal = in_.geometry.corner_normal,
                      .texcoord = in_.geometry.texcoord,
                      .texcoord_flags = in_.geometry.texcoord_flags,
                      .normal = in_.geometry.normal});
    if (wedges.vertex.size() > max_tuples(limits_))
      return refuse(over_limit_message(wedges.vertex.size(), "wedges", max_tuples(limits_)));
    wedges_ = std::move(wedges);
    if (in_.geometry.corner_vertex.empty()) take_cloud_attributes();

    Mesh& mesh = model_.meshes.emplace_back();
    mesh.position = attribute(
        "POSITION", in_.geometry.values.position_fits, 3, in_.geometry.vertices.count,
        [&](std::size_t v, std::size_t c) { return in_.geometry.values.position[3 * v + c]; });
    add_wedge_attributes(mesh);
    mesh.wedge_vertex = std::move(wedges_.vertex);
    mesh.corners = std::move(wedges_.corners);
    mesh.face_first = std::move(in_.geometry.face_first);
    mesh.face_group = std::move(in_.face_group);
    if (in_.has_smoothing && mesh.face_count() > 0) {
      const ByteView data = std::as_bytes(std::span(in_.face_smoothing));
      mesh.face_attributes.push_back({std::string(kObjSmoothing), ComponentType::u32, 1, false,
                                      Bytes(data.begin(), data.end())});
    }
    if (!add_materials()) return false;
    name_groups(mesh);
    add_foreign();
    canonicalize(mesh);
    return true;
  }

  /// Point clouds come with as many normals or texture coordinates as vertices and nothing that
  /// would tie them together.
  void take_cloud_attributes() {
    if (in_.geometry.normals.count == in_.geometry.vertices.count)
      std::iota(wedges_.normal.begin(), wedges_.normal.end(), 0u);
    if (in_.geometry.texcoords.count == in_.geometry.vertices.count)
      std::iota(wedges_.texcoord.begin(), wedges_.texcoord.end(), 0u);
  }

  void count_unused_tuples() {
    note_unused("vt", in_.geometry.texcoords.count, in_.geometry.corner_texcoord);
    note_unused("vn", in_.geometry.normals.count, in_.geometry.corner_normal);
  }

  void note(std::string text) const {
    if (options_.notes) options_.notes->push_back(std::move(text));
  }
  void note_missing(std::string_view kind, std::uint64_t corners) const {
    if (corners > 0)
      note("the " + std::string(kind) + " of " + std::to_string(corners) +
           " corners, which is 0 or names no line");
  }

  void note_unused(std::string_view kind, std::uint64_t count, const std::vector<Index>& used) {
    if (count == 0 || (in_.geometry.corner_vertex.empty() && count == in_.geometry.vertices.count))
      return;
    std::vector<bool> is_used(count);
    for (const Index i : used)
      if (i != kNone) is_used[i] = true;
    const auto unused = std::ranges::count(is_used, false);
    if (unused > 0)
      in_.notes += std::to_string(unused) + " unused " + std::string(kind) + " lines\n";
  }

  /// Which of ObjPresent wedge w has, by the lines it was made of.
  std::uint8_t present(std::size_t w) const {
    std::uint8_t flags =
        in_.geometry.values.flags.empty() ? 0 : in_.geometry.values.flags[wedges_.vertex[w]];
    if (wedges_.texcoord[w] != kNone) flags |= in_.geometry.texcoord_flags[wedges_.texcoord[w]];
    if (wedges_.normal[w] != kNone) flags |= kHasNormal;
    return flags;
  }

  template <class Value>
  static Attribute attribute(std::string_view semantic, bool f32, std::uint8_t count,
                             std::size_t elements, Value&& value) {
    Attribute out{
        std::string(semantic), f32 ? ComponentType::f32 : ComponentType::f64, count, false, {}};
    out.data.resize(elements * out.element_bytes());
    std::byte* at = out.data.data();
    for (std::size_t i = 0; i < elements; ++i)
      for (std::size_t c = 0; c < count; ++c) {
        const double number = value(i, c);
        if (f32) {
          const auto single = static_cast<float>(number);
          std::memcpy(at, &single, sizeof single);
        } else {
          std::memcpy(at, &number, sizeof number);
        }
        at += size_of(out.type);
      }
    return out;
  }

  void add_wedge_attributes(Mesh& mesh) {
    const std::size_t n = wedges_.vertex.size();
    const bool plain = in_.geometry.values.flags.empty() && in_.geometry.corner_texcoord.empty() &&
                       in_.geometry.corner_normal.empty() && !in_.geometry.corner_vertex.empty();
    if (plain) return;
    std::vector<std::uint8_t> flags(n);
    std::uint8_t any = 0;
    bool uv_fit = true, w_fit = true, normal_fit = true;
    for (std::size_t w = 0; w < n; ++w) {
      any |= flags[w] = present(w);
      if (const Index vt = wedges_.texcoord[w]; vt != kNone) {
        uv_fit &= (in_.geometry.texcoord_fits[vt] & kUvFit) != 0;
        w_fit &= (in_.geometry.texcoord_fits[vt] & kTexWFits) != 0;
      }
      if (const Index vn = wedges_.normal[w]; vn != kNone)
        normal_fit &= in_.geometry.normal_fits[vn] != 0;
    }
    std::vector<Attribute>& out = mesh.wedge_attributes;
    const auto value_of = [](const std::vector<double>& values, std::size_t width, Index i,
                             std::size_t c) { return i == kNone ? 0.0 : values[width * i + c]; };
    if (any & kHasNormal)
      out.push_back(attribute("NORMAL", normal_fit, 3, n, [&](std::size_t w, std::size_t c) {
        return value_of(in_.geometry.normal, 3, wedges_.normal[w], c);
      }));
    if (any & kHasTexcoord)
      out.push_back(attribute("TEXCOORD_0", uv_fit, 2, n, [&](std::size_t w, std::size_t c) {
        return value_of(in_.geometry.texcoord, 3, wedges_.texcoord[w], c);
      }));
    if (any & kHasColor) whiten();
    if (any & kHasColor)
      out.push_back(
          attribute("COLOR_0", in_.geometry.values.color_fits, any & kHasAlpha ? 4 : 3, n,
                    [&](std::size_t w, std::size_t c) {
                      return in_.geometry.values.color[std::size_t{4} * wedges_.vertex[w] + c];
                    }));
    in_.geometry.values.weight.resize(any & kHasWeight ? in_.geometry.vertices.count : 0);
    if (any & kHasWeight)
      out.push_back(attribute(kObjWeight, in_.geometry.values.weight_fits, 1, n,
                              [&](std::size_t w, std::size_t) {
                                return in_.geometry.values.weight[wedges_.vertex[w]];
                              }));
    if (any & kHasTexW)
      out.push_back(attribute(kObjTexW, w_fit, 1, n, [&](std::size_t w, std::size_t) {
        return value_of(in_.geometry.texcoord, 3, wedges_.texcoord[w], 2);
      }));
    add_presence(mesh, std::move(flags), any);
  }

  /// A vertex that says no colour is white, one that says no alpha opaque.
  void whiten() {
    std::vector<double>& color = in_.geometry.values.color;
    color.resize(4 * in_.geometry.vertices.count);
    const std::vector<std::uint8_t>& flags = in_.geometry.values.flags;
    double most = 0, most_alpha = 0;
    bool whole = true;
    for (std::size_t v = 0; v < flags.size(); ++v) {
      if (!(flags[v] & kHasColor)) continue;
      for (std::size_t c = 4 * v; c < 4 * v + 3; ++c) {
        most = std::max(most, color[c]);
        whole &= color[c] == std::floor(color[c]);
      }
      most_alpha = std::max(most_alpha, color[4 * v + 3]);
    }
    const double white = color_range(most, whole), opaque = color_range(most_alpha, true);
    for (std::size_t v = 0; v < flags.size(); ++v) {
      if (!(flags[v] & kHasColor))
        std::fill_n(color.begin() + 4 * static_cast<std::ptrdiff_t>(v), 3, white);
      if (!(flags[v] & kHasAlpha)) color[4 * v + 3] = opaque;
    }
  }

  /// The mask is there when a wedge lacks something that others have. What a file can only say
  /// of corners is not missed in a wedge without one.
  void add_presence(Mesh& mesh, std::vector<std::uint8_t> flags, std::uint8_t any) {
    if (any & kHasTexcoord) any |= kHasTexV;
    constexpr std::uint8_t kOfVertex = kHasColor | kHasAlpha | kHasWeight;
    const auto misses = [&](std::size_t w) {
      const std::uint8_t mask =
          wedges_.has_corner(w) || in_.geometry.corner_vertex.empty() ? 0xff : kOfVertex;
      return (flags[w] & mask) != (any & mask);
    };
    bool mixed = false;
    for (std::size_t w = 0; w < flags.size() && !mixed; ++w) mixed = misses(w);
    if (!mixed) return;
    const ByteView data = std::as_bytes(std::span(flags));
    mesh.wedge_attributes.push_back(
        {std::string(kObjPresent), ComponentType::u8, 1, false, Bytes(data.begin(), data.end())});
  }

  bool add_materials() {
    Scene& scene = model_.scene;
    if (const auto read = read_mtl(in_.libraries, scene, limits_); !read) {
      error_ = read.error();
      return false;
    }
    std::map<std::string_view, Index> by_name;
    const auto defined = static_cast<Index>(scene.materials.size());
    for (Index m = 0; m < defined; ++m) by_name.emplace(scene.materials[m].name, m);
    for (const GroupKey& key : in_.groups) {
      const std::string& name = in_.names[std::get<2>(key)];
      if (name.empty()) continue;
      const auto next = static_cast<Index>(defined + unknown_materials_.size());
      if (by_name.emplace(name, next).second) unknown_materials_.push_back(name);
    }
    for (const GroupKey& key : in_.groups) {
      const auto found = by_name.find(in_.names[std::get<2>(key)]);
      const bool has_name = !in_.names[std::get<2>(key)].empty();
      group_material_.push_back(has_name ? found->second : kNone);
    }
    if (defined + unknown_materials_.size() > limits_.meshes)
      return refuse("more materials than the limit allows");
    if (defined > 0)
      for (const std::string& name : unknown_materials_)
        note("material " + name + ", which no library defines");
    for (std::string& name : unknown_materials_)
      scene.materials.push_back(named_material(std::move(name)));
    return true;
  }

  void name_groups(Mesh& mesh) {
    const auto object_of = [](const GroupKey& key) { return std::get<0>(key); };
    const Index object = in_.groups.empty() ? 0 : object_of(in_.groups.front());
    const bool one_object = std::ranges::all_of(
        in_.groups, [&](const GroupKey& key) { return object_of(key) == object; });
    if (one_object)
      mesh.name = in_.names[in_.groups.empty() ? in_.object : in_.objects[object].name];
    for (std::size_t i = 0; i < in_.groups.size(); ++i) {
      const auto& [key_object, key_group, material, kind] = in_.groups[i];
      const NamedObject prefix = one_object ? NamedObject{} : in_.objects[key_object];
      mesh.groups.push_back(
          {obj_group_name(in_.names[prefix.name], in_.names[key_group], prefix.instance),
           group_material_[i], kind});
    }
  }

  void add_foreign() {
    const auto add = [&](std::string key, std::string_view text) {
      const ByteView data = as_bytes(text);
      if (!text.empty())
        model_.scene.foreign.push_back({std::move(key), Bytes(data.begin(), data.end())});
    };
    add("obj/header", in_.header);
    add("obj/mtllib", in_.missing_libraries);
    add("obj/mtl", in_.libraries);
    add("obj/notes", in_.notes);
  }

  Statements in_;
  const Limits& limits_;
  const ObjReadOptions& options_;
  std::optional<Error> error_;
  WedgeTable wedges_;
  std::vector<std::string> unknown_materials_;
  std::vector<Index> group_material_;
  Model model_;
};

}  // namespace

Result<Model> make_model(Statements statements, const Limits& limits,
                         const ObjReadOptions& options) {
  return ModelMaker(std::move(statements), limits, options).make();
}

}  // namespace pstrips::inline formats::obj
