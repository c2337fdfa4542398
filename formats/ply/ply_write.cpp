#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "formats/ply/ply.h"
#include "formats/ply/ply_body.h"
#include "formats/ply/ply_header.h"
#include "formats/ply/ply_kept.h"
#include "formats/ply/ply_layout.h"
#include "formats/ply/ply_numbers.h"
#include "formats/ply/ply_rows.h"

namespace pstrips::inline formats {
namespace ply {
namespace {

using Role = Layout::Role;

/// What a row of the vertex element is, and where TEXCOORD_0 goes.
enum class Shape : std::uint8_t {
  vertices,            ///< a row a vertex
  vertices_texcoords,  ///< the same, TEXCOORD_0 in the faces' lists
  wedges,              ///< a row a wedge, with wedge_vertex
};

Bytes gathered(const Attribute& attribute, std::span<const Index> rows) {
  const std::size_t bytes = attribute.element_bytes();
  Bytes out(rows.size() * bytes);
  for (std::size_t i = 0; i < rows.size(); ++i)
    std::memcpy(&out[i * bytes], &attribute.data[rows[i] * bytes], bytes);
  return out;
}

bool is_texcoord(const Attribute& attribute) {
  return attribute.semantic == "TEXCOORD_0" && attribute.count == 2 && !is_integer(attribute.type);
}

/// The first wedge of each vertex.
std::vector<Index> first_wedges(const Mesh& mesh) {
  std::vector<Index> out(mesh.vertex_count(), kNone);
  for (Index w = mesh.wedge_count(); w-- > 0;) out[mesh.vertex_of(w)] = w;
  return out;
}

bool wedges_agree(const Mesh& mesh, const Attribute& attribute, std::span<const Index> first) {
  const std::size_t bytes = attribute.element_bytes();
  const std::byte* const data = attribute.data.data();
  for (Index w = 0; w < mesh.wedge_count(); ++w)
    if (std::memcmp(data + w * bytes, data + first[mesh.vertex_of(w)] * bytes, bytes) != 0)
      return false;
  return true;
}

/// Whether a reader finds all texture coordinates at the corners: a wedge without a corner must be
/// the only one of its vertex, and zero.
bool corners_tell_texcoords(const Mesh& mesh, const Attribute& texcoord) {
  std::vector<bool> has_corner(mesh.wedge_count());
  for (const Index w : mesh.corners) has_corner[w] = true;
  std::vector<Index> wedges(mesh.vertex_count());
  for (Index w = 0; w < mesh.wedge_count(); ++w) ++wedges[mesh.vertex_of(w)];
  for (Index w = 0; w < mesh.wedge_count(); ++w)
    if (!has_corner[w] &&
        (wedges[mesh.vertex_of(w)] != 1 ||
         std::ranges::any_of(texcoord.element(w), [](std::byte b) { return b != std::byte{0}; })))
      return false;
  return true;
}

bool fits(ComponentType type, std::uint64_t value) {
  return visit_type(type, [&](auto zero) {
    using T = decltype(zero);
    if constexpr (std::is_integral_v<T>)
      return value <= static_cast<std::uint64_t>(std::numeric_limits<T>::max());
    else
      return true;
  });
}

void set_type(Property& property, ComponentType type) {
  if (property.type == type) return;
  property.type = type;
  property.word = word_of(type);
}

/// Whether doubles go through `type` unharmed: those from which a reader made POSITION do.
bool survives(const Attribute& doubles, std::size_t component, ComponentType type) {
  return visit_type(type, [&](auto zero) {
    using T = decltype(zero);
    for (std::size_t i = 0; i < doubles.elements(); ++i) {
      const auto value = load<double>(doubles.element(i).data() + component * sizeof(double));
      if constexpr (std::is_integral_v<T>) {
        if (!(value >= std::numeric_limits<T>::min() && value <= std::numeric_limits<T>::max()))
          return false;
      }
      const auto back = static_cast<double>(static_cast<T>(value));
      if (std::memcmp(&back, &value, sizeof value) != 0) return false;
    }
    return true;
  });
}

/// Attributes that are to be written, found by name.
struct NamedAttributes {
  static constexpr std::size_t kNotFound = ~std::size_t{0};
  std::vector<const Attribute*> list;
  std::map<std::string_view, std::size_t> by_name;

  void add(const Attribute& attribute) {
    by_name.emplace(attribute.semantic, list.size());
    list.push_back(&attribute);
  }
  /// The one of the same format.
  std::size_t find(const Attribute& wanted) const {
    const auto found = by_name.find(wanted.semantic);
    const bool same = found != by_name.end() && list[found->second]->same_format(wanted);
    return same ? found->second : kNotFound;
  }
};

class ModelWriter {
 public:
  ModelWriter(const Model& model, const PlyWriteOptions& options)
      : model_(model),
        encoding_(static_cast<Encoding>(options.format)),
        threads_(options.threads) {}

  Result<Bytes> run() {
    if (model_.meshes.size() > 1) return fail(ErrorCode::bad_argument, "ply holds one mesh");
    auto kept = get_kept(model_.scene.foreign);
    if (!kept) return tl::unexpected<Error>(kept.error());
    from_ply_ = kept->has_value();
    if (from_ply_) kept_ = **std::move(kept);
    if (!model_.meshes.empty()) {
      mesh_ = &model_.meshes.front();
      if (auto refused = refusal()) return tl::unexpected<Error>(*std::move(refused));
    }
    header().encoding = encoding_;
    choose_elements();
    if (mesh_ != nullptr && !(describe_vertices() && describe_faces()))
      return fail(ErrorCode::bad_argument, "attribute names clash");
    return write();
  }

 private:
  Header& header() { return kept_.header; }
  Element& vertex() { return *header().find("vertex"); }
  Element& face() { return *header().find("face"); }

  std::optional<Error> refusal() const {
    if (const std::string wrong = find_inconsistency(*mesh_); !wrong.empty())
      return Error{ErrorCode::bad_argument, wrong};
    if (mesh_->position.count != 3)
      return Error{ErrorCode::unsupported, "ply positions have three components"};
    for (Index f = 0; f < mesh_->face_count(); ++f)
      if (mesh_->groups[mesh_->group_of(f)].kind != FaceKind::polygons)
        return Error{ErrorCode::unsupported, "ply faces are neither lines nor points"};
    return std::nullopt;
  }

  /// Drops what the model no longer supports and adds the elements that it needs.
  void choose_elements() {
    bound_ = mesh_ != nullptr && !kept_.columns.empty() && digest_of(*mesh_) == kept_.digest;
    auto& elements = header().elements;
    std::vector<bool> gone;
    for (const Element& element : elements) {
      const bool ours = element.name == "vertex" || (mesh_ != nullptr && element.name == "face");
      gone.push_back(ours ? mesh_ == nullptr : !is_whole(element));
    }
    erase_elements(gone);
    if (mesh_ == nullptr) return;
    if (header().find("vertex") == nullptr) {
      Element element;
      element.name = "vertex";
      // Lines that no keyword introduces must stay before the first element.
      element.remarks =
          std::exchange(elements.empty() ? header().last_remarks : elements.front().remarks, {});
      elements.insert(elements.begin(), std::move(element));
    }
    const bool has_faces = mesh_->face_count() != 0;
    if (header().find("face") == nullptr && has_faces) {
      Element element;
      element.name = "face";
      const auto after = std::ranges::find(elements, "vertex", &Element::name) + 1;
      elements.insert(after, std::move(element));
    }
    if (!from_ply_) name_textures();
    has_face_element_ = header().find("face") != nullptr;
  }

  /// Whether all values of an element that is not ours are there and still mean something.
  bool is_whole(const Element& element) const {
    // A reader would add them to the faces.
    if (element.name == "tristrips" && mesh_ != nullptr) return false;
    if (element.name == "edge" && !element.properties.empty() && mesh_ != nullptr &&
        element.count != 0 && !bound_)
      return false;
    return std::ranges::all_of(element.properties, [&](const Property& property) {
      return property.kept != Property::kNotKept &&
             kept_.columns[property.kept].rows == element.count;
    });
  }

  // What is erased leaves its remarks to the next header line.

  void erase_elements(const std::vector<bool>& gone) {
    std::vector<Element> left;
    std::vector<std::string> remarks;
    for (std::size_t e = 0; e < gone.size(); ++e) {
      Element& element = header().elements[e];
      append(remarks, element.remarks);
      if (gone[e]) {
        for (Property& property : element.properties) append(remarks, property.remarks);
        continue;
      }
      element.remarks = std::exchange(remarks, {});
      left.push_back(std::move(element));
    }
    append(remarks, header().last_remarks);
    header().last_remarks = std::move(remarks);
    header().elements = std::move(left);
  }

  void erase_properties(Element& element, const std::vector<bool>& gone) {
    std::vector<Property> left;
    std::vector<std::string> remarks;
    for (std::size_t p = 0; p < gone.size(); ++p) {
      Property& property = element.properties[p];
      append(remarks, property.remarks);
      if (gone[p]) continue;
      property.remarks = std::exchange(remarks, {});
      left.push_back(std::move(property));
    }
    element.properties = std::move(left);
    const bool last = &element == &header().elements.back();
    auto& later = last ? header().last_remarks : (&element + 1)->remarks;
    append(remarks, later);
    later = std::move(remarks);
  }

  static void append(std::vector<std::string>& to, std::vector<std::string>& more) {
    to.insert(to.end(), std::move_iterator(more.begin()), std::move_iterator(more.end()));
    more.clear();
  }

  void name_textures() {
    image_number_.assign(model_.scene.images.size(), kNone);
    Index written = 0;
    for (std::size_t i = 0; i < image_number_.size(); ++i) {
      const std::string& uri = model_.scene.images[i].uri;
      const bool one_line = std::ranges::none_of(uri, is_line_end);
      if (uri.empty() || !one_line || is_blank(uri.front()) || is_blank(uri.back())) continue;
      vertex().remarks.push_back("comment TextureFile " + uri);
      image_number_[i] = written++;
    }
    const auto& own = mesh_->face_attributes;
    if (written < 2 || std::ranges::count(own, "texnumber", &Attribute::semantic) != 0) return;
    Attribute& number = texnumber_.emplace();
    number = {.semantic = "texnumber",
              .type = ComponentType::i32,
              .count = 1,
              .normalized = false,
              .data = {}};
    ByteWriter out;
    for (Index f = 0; f < mesh_->face_count(); ++f)
      out.u32(texture_of(mesh_->groups[mesh_->group_of(f)]));
    number.data = std::move(out).take();
  }

  /// kNone, which reads -1, for a group without one.
  Index texture_of(const Group& group) const {
    const auto& materials = model_.scene.materials;
    if (group.material >= materials.size()) return kNone;
    const Index image = materials[group.material].base_color_image;
    return image < image_number_.size() ? image_number_[image] : kNone;
  }

  /// The faces' own list of texture coordinates in the kept header, if any.
  std::optional<std::size_t> texcoord_list() {
    if (!has_face_element_) return std::nullopt;
    const Layout layout = face_layout(face());
    const auto place = std::ranges::find(layout.places, Role::texcoord, &Layout::Place::role);
    if (place == layout.places.end()) return std::nullopt;
    return static_cast<std::size_t>(place - layout.places.begin());
  }

  Shape choose_shape() {
    if (from_ply_ && vertex_layout(vertex(), false).has(Role::wedge_vertex)) return Shape::wedges;
    const std::vector<Index> first = first_wedges(*mesh_);
    const Attribute* texcoord = nullptr;
    bool others_agree = true, all_agree = true;
    for (const Attribute& attribute : mesh_->wedge_attributes) {
      if (is_texcoord(attribute)) texcoord = &attribute;
      if (mesh_->wedge_vertex.empty() || wedges_agree(*mesh_, attribute, first)) continue;
      all_agree = false;
      others_agree &= is_texcoord(attribute);
    }
    const auto list = texcoord_list();
    const bool had_list = list && face().properties[*list].kept == Property::kNotKept;
    if (all_agree && !had_list) return Shape::vertices;
    if (others_agree && texcoord != nullptr && has_face_element_ &&
        corners_tell_texcoords(*mesh_, *texcoord))
      return Shape::vertices_texcoords;
    return all_agree ? Shape::vertices : Shape::wedges;
  }

  bool describe_vertices() {
    shape_ = choose_shape();
    const auto list = texcoord_list();
    const bool taken =
        std::ranges::count(mesh_->wedge_attributes, "TEXCOORD_0", &Attribute::semantic) != 0;
    if (list && shape_ != Shape::vertices_texcoords &&
        (taken || !keeps(face().properties[*list], mesh_->face_count())))
      erase_list(*list);
    if (shape_ == Shape::vertices_texcoords) set_texcoord_list();
    // A vertex's texture coordinates count from 1 when the faces have some, kept ones too.
    faces_have_texcoords_ = texcoord_list().has_value();

    rows_ = shape_ == Shape::wedges ? mesh_->wedge_count() : mesh_->vertex_count();
    drop_lost_lists(vertex(), rows_, vertex_layout(vertex(), faces_have_texcoords_));
    vertex().count = rows_;
    set_position();
    set_wedge_property();
    for (const Attribute& attribute : mesh_->wedge_attributes)
      if (shape_ != Shape::vertices_texcoords || !is_texcoord(attribute))
        wedge_attributes_.add(attribute);
    if (!set_attributes("vertex", wedge_attributes_)) return false;
    gather_rows();
    return true;
  }

  bool describe_faces() {
    if (!has_face_element_) return true;
    face().count = mesh_->face_count();
    drop_lost_lists(face(), face().count, face_layout(face()));
    set_corner_list();
    for (const Attribute& attribute : mesh_->face_attributes) face_attributes_.add(attribute);
    if (texnumber_) face_attributes_.add(*texnumber_);
    if (!set_attributes("face", face_attributes_)) return false;
    if (shape_ != Shape::wedges && !mesh_->wedge_vertex.empty())
      for (const Index wedge : mesh_->corners) row_corners_.push_back(mesh_->wedge_vertex[wedge]);
    if (shape_ == Shape::vertices_texcoords) {
      const auto texcoord = std::ranges::find_if(mesh_->wedge_attributes, is_texcoord);
      corner_texcoords_ = gathered(*texcoord, mesh_->corners);
    }
    return true;
  }

  void erase_list(std::size_t p) {
    std::vector<bool> gone(face().properties.size());
    gone[p] = true;
    erase_properties(face(), gone);
  }

  bool keeps(const Property& property, std::uint64_t rows) const {
    return bound_ && property.kept != Property::kNotKept &&
           kept_.columns[property.kept].rows == rows;
  }

  void drop_lost_lists(Element& element, std::uint64_t rows, const Layout& layout) {
    std::vector<bool> gone;
    for (std::size_t p = 0; p < element.properties.size(); ++p)
      gone.push_back(layout.places[p].role == Role::kept && !keeps(element.properties[p], rows));
    erase_properties(element, gone);
  }

  std::uint64_t largest_face() const {
    std::uint64_t most = mesh_->corners.empty() ? 0 : 3;
    for (Index f = 0; !mesh_->face_first.empty() && f < mesh_->face_count(); ++f)
      most = std::max<std::uint64_t>(most, mesh_->face(f).size());
    return most;
  }

  static void widen_count(Property& list, std::uint64_t most) {
    if (fits(list.count_type, most)) return;
    list.count_type = ComponentType::u32;
    list.count_word = word_of(list.count_type);
  }

  void set_corner_list() {
    const Layout layout = face_layout(face());
    const auto place = std::ranges::find(layout.places, Role::corners, &Layout::Place::role);
    auto& properties = face().properties;
    auto at = properties.begin() + (place - layout.places.begin());
    if (at == properties.end()) {
      if (mesh_->face_count() == 0) return;
      at = properties.insert(properties.begin(), list_property("vertex_indices", ComponentType::u8,
                                                               ComponentType::i32));
    }
    widen_count(*at, largest_face());
    const std::uint64_t last = mesh_->corners.empty() ? 0 : rows_ - 1;
    if (!is_integer(at->type) || !fits(at->type, last))
      set_type(*at, fits(ComponentType::i32, last) ? ComponentType::i32 : ComponentType::u32);
  }

  void set_texcoord_list() {
    const ComponentType type = std::ranges::find_if(mesh_->wedge_attributes, is_texcoord)->type;
    auto list = texcoord_list();
    if (!list) {
      const Layout layout = face_layout(face());
      const auto corners = std::ranges::find(layout.places, Role::corners, &Layout::Place::role);
      list = std::min<std::size_t>(static_cast<std::size_t>(corners - layout.places.begin()) + 1,
                                   face().properties.size());
      face().properties.insert(face().properties.begin() + static_cast<std::ptrdiff_t>(*list),
                               list_property("texcoord", ComponentType::u8, type));
    }
    Property& property = face().properties[*list];
    property.kept = Property::kNotKept;
    widen_count(property, 2 * largest_face());
    set_type(property, type);
  }

  void set_position() {
    const Attribute& own = mesh_->position;
    position_ = &own;
    if (own.normalized) {
      scaled_position_ = {.semantic = own.semantic,
                          .type = ComponentType::f64,
                          .count = 3,
                          .normalized = false,
                          .data = {}};
      ByteWriter out;
      for (std::size_t v = 0; v < own.elements(); ++v)
        for (std::size_t c = 0; c < 3; ++c) out.f64(component(own, v, c));
      scaled_position_.data = std::move(out).take();
      position_ = &scaled_position_;
    }
    const Layout layout = vertex_layout(vertex(), false);
    if (!layout.has_position) {
      const char* const axes[] = {"x", "y", "z"};
      for (std::ptrdiff_t c = 0; c < 3; ++c)
        vertex().properties.insert(vertex().properties.begin() + c,
                                   scalar_property(axes[c], position_->type));
      return;
    }
    for (std::size_t p = 0; p < layout.places.size(); ++p) {
      if (layout.places[p].role != Role::position) continue;
      Property& property = vertex().properties[p];
      const bool mixed =
          layout.position_type == ComponentType::f64 && position_->type == ComponentType::f64;
      if (!mixed || !survives(*position_, layout.places[p].component, property.type))
        set_type(property, position_->type);
    }
  }

  void set_wedge_property() {
    if (shape_ != Shape::wedges || vertex_layout(vertex(), false).has(Role::wedge_vertex)) return;
    Property property = scalar_property(std::string(kWedgeVertex), ComponentType::u32);
    property.remarks.emplace_back(kWedgeRemark);
    // In front, where no property of a stranger with that name comes before it.
    vertex().properties.insert(vertex().properties.begin(), std::move(property));
  }

  Layout layout_of(std::string_view name) {
    return name == "vertex" ? vertex_layout(vertex(), faces_have_texcoords_) : face_layout(face());
  }

  /// Makes an element's scalars describe these attributes, the kept words first. What a reader
  /// will make of the names is checked with the reader's own function; false when it would be
  /// something else whatever is tried, as for an attribute named POSITION.
  bool set_attributes(std::string_view name, const NamedAttributes& attributes) {
    enum { kept_and_usual, kept_and_indexed, indexed };
    const Header before = header();
    for (const int attempt : {kept_and_usual, kept_and_indexed, indexed}) {
      if (attempt != kept_and_usual) header() = before;
      Element& element = *header().find(name);
      const Layout layout = layout_of(name);
      std::vector<bool> named(attributes.list.size()), gone(element.properties.size());
      for (std::size_t p = 0; p < gone.size(); ++p) {
        if (layout.places[p].role != Role::attribute) continue;
        const std::size_t a = attributes.find(layout.attributes[layout.places[p].attribute]);
        gone[p] = a == NamedAttributes::kNotFound || attempt == indexed;
        if (!gone[p]) named[a] = true;
      }
      erase_properties(element, gone);
      for (std::size_t a = 0; a < named.size(); ++a) {
        if (named[a]) continue;
        for (Property& property : properties_for(*attributes.list[a], attempt == kept_and_usual))
          element.properties.push_back(std::move(property));
      }
      const Layout result = layout_of(name);
      const auto is_ours = [&](const Attribute& a) {
        return attributes.find(a) != NamedAttributes::kNotFound;
      };
      if (result.attributes.size() == attributes.list.size() &&
          std::ranges::all_of(result.attributes, is_ours))
        return true;
    }
    return false;
  }

  /// Brings positions and attributes into the order of the rows where it is not theirs.
  void gather_rows() {
    if (mesh_->wedge_vertex.empty()) return;
    if (shape_ == Shape::wedges) {
      row_position_ = gathered(*position_, mesh_->wedge_vertex);
      return;
    }
    const std::vector<Index> first = first_wedges(*mesh_);
    for (const Attribute* attribute : wedge_attributes_.list)
      row_attributes_.push_back(gathered(*attribute, first));
  }

  Source scalar_source(const Attribute& attribute, const Bytes& data, std::size_t component) const {
    return {.kind = Source::Kind::scalars,
            .stored = attribute.type,
            .data = data.empty() ? nullptr : data.data() + component * size_of(attribute.type),
            .stride = attribute.element_bytes()};
  }

  Source kept_source(const Property& property) const {
    const KeptColumn& column = kept_.columns[property.kept];
    return {.kind = property.is_list() ? Source::Kind::list : Source::Kind::scalars,
            .stored = property.type,
            .data = column.data.values.data(),
            .stride = size_of(property.type),
            .sizes = column.data.sizes.data()};
  }

  Source corner_source(Source source) const {
    source.first = mesh_->face_first.empty() ? nullptr : mesh_->face_first.data();
    return source;
  }

  Source source_of(const Property& property, const Layout::Place& place, const Layout& layout,
                   bool is_vertex) {
    switch (place.role) {
      case Role::position:
        return scalar_source(*position_, row_position_.empty() ? position_->data : row_position_,
                             place.component);
      case Role::wedge_vertex:
        if (wedge_rows_.empty())
          for (Index w = 0; w < rows_; ++w) wedge_rows_.push_back(mesh_->vertex_of(w));
        return {.stored = ComponentType::u32,
                .data = reinterpret_cast<const std::byte*>(wedge_rows_.data()),
                .stride = sizeof(Index)};
      case Role::corners:
        return corner_source(
            {.kind = Source::Kind::indices,
             .indices = row_corners_.empty() ? mesh_->corners.data() : row_corners_.data()});
      case Role::texcoord:
        if (shape_ != Shape::vertices_texcoords) return kept_source(property);
        return corner_source(
            {.kind = Source::Kind::list, .data = corner_texcoords_.data(), .values_per_corner = 2});
      case Role::kept:
        return kept_source(property);
      case Role::attribute:
        break;
    }
    const auto& attributes = is_vertex ? wedge_attributes_ : face_attributes_;
    const std::size_t a = attributes.find(layout.attributes[place.attribute]);
    const bool from_rows = is_vertex && !row_attributes_.empty();
    return scalar_source(*attributes.list[a],
                         from_rows ? row_attributes_[a] : attributes.list[a]->data,
                         place.component);
  }

  std::vector<Source> sources_of(const Element& element) {
    const bool is_vertex = element.name == "vertex";
    const bool ours = mesh_ != nullptr && (is_vertex || element.name == "face");
    const Layout layout = ours ? layout_of(element.name) : Layout{};
    std::vector<Source> out;
    for (std::size_t p = 0; p < element.properties.size(); ++p)
      out.push_back(ours ? source_of(element.properties[p], layout.places[p], layout, is_vertex)
                         : kept_source(element.properties[p]));
    return out;
  }

  Bytes write() {
    std::vector<std::vector<Source>> sources;
    const std::string text = format_header(header());
    std::size_t bytes = text.size();
    for (const Element& element : header().elements) {
      sources.push_back(sources_of(element));
      bytes += expected_bytes(element, sources.back(), encoding_);
    }
    Bytes out;
    out.reserve(bytes);
    out.insert(out.end(), as_bytes(text).begin(), as_bytes(text).end());
    for (std::size_t e = 0; e < sources.size(); ++e)
      write_rows(header().elements[e], sources[e], encoding_, threads_, out);
    const Foreign* const rest = find_foreign(model_.scene.foreign, "ply/rest");
    if (rest != nullptr && encoding_ != Encoding::ascii)
      out.insert(out.end(), rest->data.begin(), rest->data.end());
    return out;
  }

  const Model& model_;
  const Encoding encoding_;
  const unsigned threads_;
  const Mesh* mesh_ = nullptr;
  Kept kept_;  // its header becomes the one that is written
  bool from_ply_ = false, bound_ = false, has_face_element_ = false, faces_have_texcoords_ = false;
  Shape shape_ = Shape::vertices;
  Index rows_ = 0;
  const Attribute* position_ = nullptr;
  Attribute scaled_position_;
  std::optional<Attribute> texnumber_;
  std::vector<Index> image_number_;  // of each image among those written
  NamedAttributes wedge_attributes_, face_attributes_;
  Bytes row_position_, corner_texcoords_;
  std::vector<Bytes> row_attributes_;
  std::vector<Index> row_corners_, wedge_rows_;
};

}  // namespace
}  // namespace ply

Result<Bytes> write_ply(const Model& model, const PlyWriteOptions& options) {
  return ply::ModelWriter(model, options).run();
}

}  // namespace pstrips::inline formats
