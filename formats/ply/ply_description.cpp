#include "formats/ply/ply_description.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "formats/ply/ply_edges.h"
#include "formats/ply/ply_edit.h"
#include "formats/ply/ply_numbers.h"

namespace pstrips::inline formats::ply {
namespace {

using Role = Layout::Role;

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

std::optional<Error> refusal(const Mesh& mesh) {
  if (mesh.position.count != 3)
    return Error{ErrorCode::unsupported, "ply positions have three components"};
  return std::nullopt;
}

/// Changes the kept header element by element until it describes the model.
class HeaderWriter {
 public:
  HeaderWriter(const Model& model, bool from_ply, Description& out)
      : model_(model), mesh_(out.mesh), from_ply_(from_ply), out_(out) {}

  /// False when names of attributes clash.
  bool run() {
    choose_elements();
    return mesh_ == nullptr || (describe_vertices() && describe_faces());
  }

 private:
  Header& header() { return out_.kept.header; }
  Element& vertex() { return *header().find("vertex"); }
  Element& face() { return *header().find("face"); }

  /// Drops what the model no longer supports and adds the elements that it needs.
  void choose_elements() {
    bound_ =
        mesh_ != nullptr && !out_.kept.columns.empty() && digest_of(*mesh_) == out_.kept.digest;
    auto& elements = header().elements;
    std::vector<bool> gone;
    for (const Element& element : elements) {
      const bool ours = element.name == "vertex" || (mesh_ != nullptr && element.name == "face");
      // Its rows come from the lines.
      const bool edges = out_.has_edges && element.name == "edge";
      gone.push_back(ours ? mesh_ == nullptr : edges ? !is_edge_list(element) : !is_whole(element));
      if (!ours && gone.back() && element.count != 0)
        out_.dropped.push_back("element " + element.name);
    }
    erase_elements(header(), gone);
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
    out_.has_faces = header().find("face") != nullptr;
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
             out_.kept.columns[property.kept].rows == element.count;
    });
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
    Attribute& number = out_.texnumber.emplace();
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
    const Index image = materials[group.material].image(MapRole::base_color);
    return image < image_number_.size() ? image_number_[image] : kNone;
  }

  /// The faces' own list of texture coordinates in the kept header, if any.
  std::optional<std::size_t> texcoord_list() {
    if (!out_.has_faces) return std::nullopt;
    const Layout layout = face_layout(face());
    const auto place = std::ranges::find(layout.places, Role::texcoord, &Layout::Place::role);
    if (place == layout.places.end()) return std::nullopt;
    return static_cast<std::size_t>(place - layout.places.begin());
  }

  Shape shape() {
    if (from_ply_ && vertex_layout(vertex(), false).has(Role::wedge_vertex)) return Shape::wedges;
    const auto list = texcoord_list();
    return choose_shape(*mesh_, out_.has_faces,
                        list && face().properties[*list].kept == Property::kNotKept);
  }

  bool describe_vertices() {
    out_.shape = shape();
    const auto list = texcoord_list();
    const bool taken =
        std::ranges::count(mesh_->wedge_attributes, "TEXCOORD_0", &Attribute::semantic) != 0;
    if (list && out_.shape != Shape::vertices_texcoords &&
        (taken || !keeps(face().properties[*list], mesh_->face_count())))
      erase_list(*list);
    if (out_.shape == Shape::vertices_texcoords) set_texcoord_list();
    // A vertex's texture coordinates count from 1 when the faces have some, kept ones too.
    out_.faces_have_texcoords = texcoord_list().has_value();

    out_.rows = out_.shape == Shape::wedges ? mesh_->wedge_count() : mesh_->vertex_count();
    drop_lost_lists(vertex(), out_.rows, vertex_layout(vertex(), out_.faces_have_texcoords));
    vertex().count = out_.rows;
    set_position();
    set_wedge_property();
    for (const Attribute& attribute : mesh_->wedge_attributes)
      if (out_.shape != Shape::vertices_texcoords || !is_texcoord(attribute))
        out_.wedge_attributes.add(attribute);
    return set_attributes("vertex", out_.wedge_attributes);
  }

  bool describe_faces() {
    if (!out_.has_faces) return true;
    face().count = mesh_->face_count();
    drop_lost_lists(face(), face().count, face_layout(face()));
    set_corner_list();
    for (const Attribute& attribute : mesh_->face_attributes) out_.face_attributes.add(attribute);
    if (out_.texnumber) out_.face_attributes.add(*out_.texnumber);
    return set_attributes("face", out_.face_attributes);
  }

  void erase_list(std::size_t p) {
    std::vector<bool> gone(face().properties.size());
    gone[p] = true;
    erase_properties(header(), face(), gone);
  }

  bool keeps(const Property& property, std::uint64_t rows) const {
    return bound_ && property.kept != Property::kNotKept &&
           out_.kept.columns[property.kept].rows == rows;
  }

  void drop_lost_lists(Element& element, std::uint64_t rows, const Layout& layout) {
    std::vector<bool> gone;
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      gone.push_back(layout.places[p].role == Role::kept && !keeps(element.properties[p], rows));
      if (gone.back())
        out_.dropped.push_back("list " + element.properties[p].name + " of " + element.name);
    }
    erase_properties(header(), element, gone);
  }

  std::uint64_t largest_face() const {
    std::uint64_t most = mesh_->corners.empty() ? 0 : 3;
    for (Index f = 0; !mesh_->face_first.empty() && f < mesh_->face_count(); ++f)
      most = std::max<std::uint64_t>(most, mesh_->face(f).size());
    return most;
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
    const std::uint64_t last = mesh_->corners.empty() ? 0 : out_.rows - 1;
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
    out_.position = &own;
    if (own.normalized) {
      out_.scaled_position = {.semantic = own.semantic,
                              .type = ComponentType::f64,
                              .count = 3,
                              .normalized = false,
                              .data = {}};
      ByteWriter out;
      for (std::size_t v = 0; v < own.elements(); ++v)
        for (std::size_t c = 0; c < 3; ++c) out.f64(component(own, v, c));
      out_.scaled_position.data = std::move(out).take();
      out_.position = &out_.scaled_position;
    }
    const Layout layout = vertex_layout(vertex(), false);
    if (!layout.has_position) {
      const char* const axes[] = {"x", "y", "z"};
      for (std::ptrdiff_t c = 0; c < 3; ++c)
        vertex().properties.insert(vertex().properties.begin() + c,
                                   scalar_property(axes[c], out_.position->type));
      return;
    }
    for (std::size_t p = 0; p < layout.places.size(); ++p) {
      if (layout.places[p].role != Role::position) continue;
      Property& property = vertex().properties[p];
      const bool mixed =
          layout.position_type == ComponentType::f64 && out_.position->type == ComponentType::f64;
      if (!mixed || !survives(*out_.position, layout.places[p].component, property.type))
        set_type(property, out_.position->type);
    }
  }

  void set_wedge_property() {
    if (out_.shape != Shape::wedges || vertex_layout(vertex(), false).has(Role::wedge_vertex))
      return;
    Property property = scalar_property(std::string(kWedgeVertex), ComponentType::u32);
    property.remarks.emplace_back(kWedgeRemark);
    // In front, where no property of a stranger with that name comes before it.
    vertex().properties.insert(vertex().properties.begin(), std::move(property));
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
      const Layout layout = out_.layout_of(name);
      std::vector<bool> named(attributes.list.size()), gone(element.properties.size());
      for (std::size_t p = 0; p < gone.size(); ++p) {
        if (layout.places[p].role != Role::attribute) continue;
        const std::size_t a = attributes.find(layout.attributes[layout.places[p].attribute]);
        gone[p] = a == NamedAttributes::kNotFound || attempt == indexed;
        if (!gone[p]) named[a] = true;
      }
      erase_properties(header(), element, gone);
      for (std::size_t a = 0; a < named.size(); ++a) {
        if (named[a]) continue;
        for (Property& property : properties_for(*attributes.list[a], attempt == kept_and_usual))
          element.properties.push_back(std::move(property));
      }
      const Layout result = out_.layout_of(name);
      const auto is_ours = [&](const Attribute& a) {
        return attributes.find(a) != NamedAttributes::kNotFound;
      };
      if (result.attributes.size() == attributes.list.size() &&
          std::ranges::all_of(result.attributes, is_ours))
        return true;
    }
    return false;
  }

  const Model& model_;
  const Mesh* const mesh_;
  const bool from_ply_;
  Description& out_;
  bool bound_ = false;               // the mesh is the one that the kept rows speak of
  std::vector<Index> image_number_;  // of each image among those written
};

}  // namespace

Layout Description::layout_of(std::string_view element) const {
  const Element& found = *kept.header.find(element);
  return element == "vertex" ? vertex_layout(found, faces_have_texcoords) : face_layout(found);
}

Result<void> describe(const Model& model, Encoding encoding, Description& out) {
  auto kept = get_kept(model.scene.foreign);
  if (!kept) return tl::unexpected(kept.error());
  const bool from_ply = kept->has_value();
  if (from_ply) out.kept = **std::move(kept);
  if (!model.meshes.empty()) {
    out.mesh = &model.meshes.front();
    if (auto refused = refusal(*out.mesh)) return tl::unexpected(*std::move(refused));
  }
  out.kept.header.encoding = encoding;
  if (!HeaderWriter(model, from_ply, out).run())
    return fail(ErrorCode::bad_argument, "attribute names clash");
  return {};
}

}  // namespace pstrips::inline formats::ply
