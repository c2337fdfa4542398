#include "converters/compare.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "codecs/measure/measure.h"
#include "codecs/triangulate/triangulate.h"
#include "converters/meet_texcoords.h"
#include "converters/merge.h"
#include "converters/placement.h"
#include "core/equal_elements.h"
#include "core/group_by.h"
#include "formats/gltf/kept_kinds.h"

namespace pstrips::inline converters {
namespace {

using Ids = std::vector<Index>;

const Attribute* find_attribute(const std::vector<Attribute>& list, std::string_view semantic) {
  const auto at = std::ranges::find(list, semantic, &Attribute::semantic);
  return at == list.end() ? nullptr : &*at;
}

// Rows of equal width, one an element; equal rows of both sides get equal ids.
class RowTable {
 public:
  explicit RowTable(std::size_t width) : width_(width) {}
  double* add() {
    rows_.resize(rows_.size() + width_);
    ++count_;
    return rows_.data() + rows_.size() - width_;
  }
  Ids ids() const {
    if (width_ == 0) return Ids(count_, 0);
    return first_equals(std::as_bytes(std::span(rows_)), width_ * sizeof(double), 0);
  }

 private:
  std::size_t width_;
  std::size_t count_ = 0;
  std::vector<double> rows_;
};

// Attributes that both meshes have with the same number of components.
struct Common {
  std::vector<std::pair<const Attribute*, const Attribute*>> pairs;
  std::size_t width = 0;
};

Common common_attributes(const std::vector<Attribute>& a, const std::vector<Attribute>& b,
                         std::string_view what, std::vector<std::string>& differences) {
  Common out;
  for (const Attribute& x : a) {
    const Attribute* y = find_attribute(b, x.semantic);
    if (y && y->count == x.count) {
      out.pairs.emplace_back(&x, y);
      out.width += x.count;
    } else {
      differences.push_back(std::string(what) + " attribute " + x.semantic +
                            (y ? ": other number of components" : ": only in the first"));
    }
  }
  for (const Attribute& y : b)
    if (!find_attribute(a, y.semantic))
      differences.push_back(std::string(what) + " attribute " + y.semantic +
                            ": only in the second");
  return out;
}

void append(const Attribute& attribute, std::size_t i, double*& out) {
  for (std::size_t c = 0; c < attribute.count; ++c) *out++ = component(attribute, i, c);
}

// Variable-length rows of ids, sorted to be compared as multisets.
class IdLists {
 public:
  void add(std::span<const Index> ids) {
    first_.push_back(ids_.size());
    ids_.insert(ids_.end(), ids.begin(), ids.end());
  }
  std::vector<std::span<const Index>> sorted() const {
    std::vector<std::span<const Index>> out;
    for (std::size_t i = 0; i < first_.size(); ++i) {
      const std::size_t end = i + 1 < first_.size() ? first_[i + 1] : ids_.size();
      out.push_back(std::span(ids_).subspan(first_[i], end - first_[i]));
    }
    std::ranges::sort(out,
                      [](auto a, auto b) { return std::ranges::lexicographical_compare(a, b); });
    return out;
  }
  bool same_set_as(const IdLists& other) const {
    const auto a = sorted(), b = other.sorted();
    return std::ranges::equal(a, b, [](auto x, auto y) { return std::ranges::equal(x, y); });
  }
  bool operator==(const IdLists&) const = default;

 private:
  std::vector<std::size_t> first_;
  Ids ids_;
};

// Where a loop starts so that it compares as least; loops of up to a few corners, or prime ones.
std::size_t least_rotation(std::span<const Index> loop) {
  std::size_t i = 0, j = 1, k = 0;
  const std::size_t n = loop.size();
  while (i < n && j < n && k < n) {
    const Index a = loop[(i + k) % n], b = loop[(j + k) % n];
    if (a == b) {
      ++k;
      continue;
    }
    (a > b ? i : j) += k + 1;
    if (i == j) ++j;
    k = 0;
  }
  return std::min(i, j);
}

struct Side {
  const Mesh* mesh;
  const Scene* scene;
  Ids wedge_ids, face_ids;  // ids of values
};

const std::string& material_name(const Side& side, Index face) {
  static const std::string kNoName;
  const Index material = side.mesh->groups[side.mesh->group_of(face)].material;
  return material < side.scene->materials.size() ? side.scene->materials[material].name : kNoName;
}

// Position and common attributes of every wedge of both, as ids.
void number_wedges(Side& a, Side& b, const Common& common) {
  RowTable table(3 + common.width);
  for (const Side* side : {&a, &b}) {
    const std::vector<double> positions = positions_as_double(*side->mesh);
    for (Index w = 0; w < side->mesh->wedge_count(); ++w) {
      double* out = table.add();
      const double* p = positions.data() + std::size_t{3} * side->mesh->vertex_of(w);
      out = std::copy_n(p, 3, out);
      for (const auto& [x, y] : common.pairs) append(side == &a ? *x : *y, w, out);
    }
  }
  const Ids ids = table.ids();
  a.wedge_ids.assign(ids.begin(), ids.begin() + a.mesh->wedge_count());
  b.wedge_ids.assign(ids.begin() + a.mesh->wedge_count(), ids.end());
}

// Kind, material name and attributes of every face of both, as ids.
void number_faces(Side& a, Side& b, const Common& common) {
  std::vector<std::string> names;
  for (const Side* side : {&a, &b})
    for (const Material& m : side->scene->materials) names.push_back(m.name);
  names.push_back({});
  std::ranges::sort(names);
  RowTable table(2 + common.width);
  for (const Side* side : {&a, &b})
    for (Index f = 0; f < side->mesh->face_count(); ++f) {
      double* out = table.add();
      *out++ = static_cast<double>(side->mesh->groups[side->mesh->group_of(f)].kind);
      *out++ = static_cast<double>(std::ranges::lower_bound(names, material_name(*side, f)) -
                                   names.begin());
      for (const auto& [x, y] : common.pairs) append(side == &a ? *x : *y, f, out);
    }
  const Ids ids = table.ids();
  a.face_ids.assign(ids.begin(), ids.begin() + a.mesh->face_count());
  b.face_ids.assign(ids.begin() + a.mesh->face_count(), ids.end());
}

IdLists vertices_of(const Side& side) {
  const Mesh& mesh = *side.mesh;
  Grouped<Index> ids = group_each<Index>(mesh.vertex_count(), [&](auto&& visit) {
    for (Index w = 0; w < mesh.wedge_count(); ++w)
      visit(mesh.vertex_of(w), [&] { return side.wedge_ids[w]; });
  });
  IdLists out;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    std::ranges::sort(ids[v]);
    out.add(ids[v]);
  }
  return out;
}

IdLists faces_of(const Side& side) {
  IdLists out;
  Ids row;
  for (Index f = 0; f < side.mesh->face_count(); ++f) {
    row.assign(1, side.face_ids[f]);
    for (const Index w : side.mesh->face(f)) row.push_back(side.wedge_ids[w]);
    // An open line has a first corner.
    if (side.mesh->groups[side.mesh->group_of(f)].kind != FaceKind::lines) {
      const std::size_t turn = least_rotation(std::span(row).subspan(1));
      std::rotate(row.begin() + 1, row.begin() + 1 + static_cast<std::ptrdiff_t>(turn), row.end());
    }
    out.add(row);
  }
  return out;
}

bool same_connectivity(const Mesh& a, const Mesh& b) {
  return a.wedge_vertex == b.wedge_vertex && a.corners == b.corners && a.face_first == b.face_first;
}

void measure_attributes(const Common& common, std::vector<AttributeDifference>& out) {
  for (const auto& [x, y] : common.pairs) {
    double largest = 0;
    for (std::size_t i = 0; i < std::min(x->elements(), y->elements()); ++i)
      for (std::size_t c = 0; c < x->count; ++c) {
        const double d = std::abs(component(*x, i, c) - component(*y, i, c));
        if (d > largest) largest = d;
      }
    if (largest > 0) out.push_back({x->semantic, largest});
  }
}

void compare_meshes(Side a, Side b, Comparison& out) {
  std::vector<std::string> differences;
  const auto count = [&](const char* what, Index x, Index y) {
    if (x != y)
      differences.push_back(std::string(what) + ": " + std::to_string(x) + " against " +
                            std::to_string(y));
  };
  count("vertices", a.mesh->vertex_count(), b.mesh->vertex_count());
  count("wedges", a.mesh->wedge_count(), b.mesh->wedge_count());
  count("faces", a.mesh->face_count(), b.mesh->face_count());
  const bool same_counts = differences.empty();
  const Common wedge_common =
      common_attributes(a.mesh->wedge_attributes, b.mesh->wedge_attributes, "wedge", differences);
  const Common face_common =
      common_attributes(a.mesh->face_attributes, b.mesh->face_attributes, "face", differences);
  number_wedges(a, b, wedge_common);
  number_faces(a, b, face_common);
  const bool same_order = same_counts && same_connectivity(*a.mesh, *b.mesh);
  const bool exact = same_order && a.wedge_ids == b.wedge_ids && a.face_ids == b.face_ids;
  if (!exact && same_counts) {
    if (!vertices_of(a).same_set_as(vertices_of(b)))
      differences.push_back("values of vertices or wedges");
    if (!faces_of(a).same_set_as(faces_of(b))) differences.push_back("faces");
    if (same_order && !differences.empty()) {
      measure_attributes(wedge_common, out.attributes);
      measure_attributes(face_common, out.attributes);
    }
  }
  if (!differences.empty())
    out.equivalence = Equivalence::different;
  else if (!exact)
    out.equivalence = std::max(out.equivalence, Equivalence::reordered);
  for (std::string& d : differences) {
    if (!a.mesh->name.empty()) d = a.mesh->name + ": " + d;
    if (std::ranges::find(out.differences, d) == out.differences.end())
      out.differences.push_back(std::move(d));
  }
}

// All meshes of a model as one; attributes that not all of them have are left out.
Model one_mesh(const Model& model) {
  std::vector<std::string> notes;
  return merge_meshes(model, notes);
}

// The file's name alone: folders differ between copies of a scene.
std::string_view file_name(std::string_view uri) {
  return uri.substr(std::min(uri.size(), uri.find_last_of("/\\") + 1));
}

// Of an embedded image against a name nothing is known.
bool same_image(const Image& a, const Image& b) {
  if (a.data.empty() != b.data.empty()) return true;
  return a.data.empty() ? file_name(a.uri) == file_name(b.uri) : a.data == b.data;
}

bool same_texture(const Scene& a, const Material& x, const Scene& b, const Material& y) {
  const Index image_x = x.image(MapRole::base_color), image_y = y.image(MapRole::base_color);
  const bool has_x = image_x < a.images.size(), has_y = image_y < b.images.size();
  if (!has_x || !has_y) return has_x == has_y;
  return same_image(a.images[image_x], b.images[image_y]);
}

// Beyond what is lost when a factor is written with seven digits.
template <class Factors>
bool same_factors(const Factors& a, const Factors& b) {
  return std::ranges::equal(a, b, [](double x, double y) { return std::abs(x - y) <= 1e-6; });
}

// Of materials in the same places and of the same names; faces are compared by the names.
void compare_materials(const Scene& a, const Scene& b, std::vector<std::string>& differences) {
  if (a.materials.size() != b.materials.size()) return;
  for (std::size_t i = 0; i < a.materials.size(); ++i) {
    const Material &x = a.materials[i], &y = b.materials[i];
    if (x.name != y.name) continue;
    const std::string place = "material " + (x.name.empty() ? std::to_string(i) : x.name) + ": ";
    const auto differ = [&](bool is_same, const char* what) {
      if (!is_same) differences.push_back(place + what);
    };
    const auto one = [](double value) { return std::array{value}; };
    differ(same_factors(x.base_color, y.base_color), "base color");
    differ(same_factors(x.emissive, y.emissive), "emissive color");
    differ(same_factors(one(x.metallic), one(y.metallic)), "metallic factor");
    differ(same_factors(one(x.roughness), one(y.roughness)), "roughness");
    differ(same_texture(a, x, b, y), "texture");
  }
}

// Of trees of the same shape; others are compared by where they put the meshes alone.
void name_moved_nodes(const std::vector<Node>& a, const std::vector<Node>& b,
                      std::vector<std::string>& differences) {
  const auto same_shape = [](const Node& x, const Node& y) {
    return x.parent == y.parent && x.meshes == y.meshes;
  };
  if (!std::ranges::equal(a, b, same_shape)) return;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i].matrix != b[i].matrix)
      differences.push_back("node " + std::to_string(i) +
                            (a[i].name.empty() ? "" : " (" + a[i].name + ")") + ": moved");
}

// The model as its nodes place it, where that is not how its meshes stand.
std::optional<Model> placed(const Model& model, std::vector<std::string>& differences) {
  std::vector<std::string> converted, dropped;
  auto out = place_meshes(model, Limits{}, converted, dropped);
  if (out) return std::move(*out);
  differences.push_back("nodes cannot be placed: " + out.error().message);
  return std::nullopt;
}

// What the distance measure takes: vertices and triangles without wedges.
struct Soup {
  std::vector<double> positions;
  std::vector<Index> triangles;
  Surface surface() const { return {positions, triangles}; }
};

Soup soup_of(const Mesh& mesh) {
  Soup out{positions_as_double(mesh), triangulate(mesh).corners};
  for (Index& corner : out.triangles) corner = mesh.vertex_of(corner);
  return out;
}

}  // namespace

Comparison compare(const Model& given_a, const Model& given_b, std::size_t samples) {
  if (given_a.scene.texture_origin != given_b.scene.texture_origin)
    return compare(with_meeting_texcoords(given_a), with_meeting_texcoords(given_b), samples);
  Comparison out;
  out.equivalence = Equivalence::exact;
  out.scenes_equal = given_a.scene.materials == given_b.scene.materials &&
                     given_a.scene.images == given_b.scene.images &&
                     given_a.scene.nodes == given_b.scene.nodes;
  std::optional<Model> placed_a, placed_b;
  if (given_a.scene.nodes != given_b.scene.nodes) {
    placed_a = placed(given_a, out.differences);
    placed_b = placed(given_b, out.differences);
    name_moved_nodes(given_a.scene.nodes, given_b.scene.nodes, out.differences);
  }
  compare_materials(given_a.scene, given_b.scene, out.differences);
  const std::vector<std::string> kinds = different_kinds(given_a.scene, given_b.scene);
  out.differences.insert(out.differences.end(), kinds.begin(), kinds.end());
  if (!out.differences.empty()) out.equivalence = Equivalence::different;
  const Model &a = placed_a ? *placed_a : given_a, &b = placed_b ? *placed_b : given_b;
  Model all_a, all_b;
  const bool paired = a.meshes.size() == b.meshes.size();
  if (paired) {
    for (std::size_t m = 0; m < a.meshes.size(); ++m)
      compare_meshes({&a.meshes[m], &a.scene, {}, {}}, {&b.meshes[m], &b.scene, {}, {}}, out);
  } else {
    all_a = one_mesh(a);
    all_b = one_mesh(b);
    compare_meshes({&all_a.meshes[0], &a.scene, {}, {}}, {&all_b.meshes[0], &b.scene, {}, {}}, out);
    out.equivalence = std::max(out.equivalence, Equivalence::reordered);
  }
  if (out.equivalence != Equivalence::different) return out;
  if (paired) {
    all_a = one_mesh(a);
    all_b = one_mesh(b);
  }
  const Soup x = soup_of(all_a.meshes[0]), y = soup_of(all_b.meshes[0]);
  const Distance distance = measure_distance(x.surface(), y.surface(), samples);
  const double diagonal =
      std::max(bounding_box_diagonal(x.positions), bounding_box_diagonal(y.positions));
  const double scale = diagonal > 0 ? 1 / diagonal : 1;
  out.hausdorff = distance.hausdorff * scale;
  out.rms = distance.rms * scale;
  return out;
}

}  // namespace pstrips::inline converters
