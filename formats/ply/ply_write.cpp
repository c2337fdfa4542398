#include <algorithm>
#include <cstring>

#include "core/gather.h"
#include "formats/ply/ply.h"
#include "formats/ply/ply_body.h"
#include "formats/ply/ply_description.h"
#include "formats/ply/ply_edges.h"

namespace pstrips::inline formats {
namespace ply {
namespace {

using Role = Layout::Role;

/// Where the values of all rows come from that a description speaks of.
class RowSources {
 public:
  explicit RowSources(const Description& description)
      : description_(description), mesh_(description.mesh) {
    if (mesh_ == nullptr) return;
    gather_rows();
    gather_corners();
  }

  std::vector<Source> sources_of(const Element& element) {
    const bool is_vertex = element.name == "vertex";
    const bool ours = mesh_ != nullptr && (is_vertex || element.name == "face");
    const Layout layout = ours ? description_.layout_of(element.name) : Layout{};
    std::vector<Source> out;
    for (std::size_t p = 0; p < element.properties.size(); ++p)
      out.push_back(ours ? source_of(element.properties[p], layout.places[p], layout, is_vertex)
                         : kept_source(element.properties[p]));
    return out;
  }

 private:
  /// Brings positions and attributes into the order of the rows where it is not theirs.
  void gather_rows() {
    if (mesh_->wedge_vertex.empty()) return;
    if (description_.shape == Shape::wedges) {
      row_position_ = gather(*description_.position, mesh_->wedge_vertex).data;
      return;
    }
    const std::vector<Index> first = first_wedges(*mesh_);
    for (const Attribute* attribute : description_.wedge_attributes.list)
      row_attributes_.push_back(gather(*attribute, first).data);
  }

  /// The same for what faces say of their corners.
  void gather_corners() {
    if (!description_.has_faces) return;
    if (description_.shape != Shape::wedges && !mesh_->wedge_vertex.empty())
      for (const Index wedge : mesh_->corners) row_corners_.push_back(mesh_->wedge_vertex[wedge]);
    if (description_.shape != Shape::vertices_texcoords) return;
    const auto texcoord = std::ranges::find_if(mesh_->wedge_attributes, is_texcoord);
    corner_texcoords_ = gather(*texcoord, mesh_->corners).data;
  }

  Source scalar_source(const Attribute& attribute, const Bytes& data, std::size_t component) const {
    return {.kind = Source::Kind::scalars,
            .stored = attribute.type,
            .data = data.empty() ? nullptr : data.data() + component * size_of(attribute.type),
            .stride = attribute.element_bytes()};
  }

  Source kept_source(const Property& property) const {
    const KeptColumn& column = description_.kept.columns[property.kept];
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
        return scalar_source(*description_.position,
                             row_position_.empty() ? description_.position->data : row_position_,
                             place.component);
      case Role::wedge_vertex:
        if (wedge_rows_.empty())
          for (Index w = 0; w < description_.rows; ++w) wedge_rows_.push_back(mesh_->vertex_of(w));
        return {.stored = ComponentType::u32,
                .data = reinterpret_cast<const std::byte*>(wedge_rows_.data()),
                .stride = sizeof(Index)};
      case Role::corners:
        return corner_source(
            {.kind = Source::Kind::indices,
             .indices = row_corners_.empty() ? mesh_->corners.data() : row_corners_.data()});
      case Role::texcoord:
        if (description_.shape != Shape::vertices_texcoords) return kept_source(property);
        return corner_source(
            {.kind = Source::Kind::list, .data = corner_texcoords_.data(), .values_per_corner = 2});
      case Role::kept:
        return kept_source(property);
      case Role::attribute:
        break;
    }
    const auto& attributes =
        is_vertex ? description_.wedge_attributes : description_.face_attributes;
    const std::size_t a = attributes.find(layout.attributes[place.attribute]);
    const bool from_rows = is_vertex && !row_attributes_.empty();
    return scalar_source(*attributes.list[a],
                         from_rows ? row_attributes_[a] : attributes.list[a]->data,
                         place.component);
  }

  const Description& description_;
  const Mesh* const mesh_;
  Bytes row_position_, corner_texcoords_;
  std::vector<Bytes> row_attributes_;
  std::vector<Index> row_corners_, wedge_rows_;
};

Bytes write_file(const Description& description, const Foreign* rest, unsigned threads) {
  const Header& header = description.kept.header;
  RowSources rows(description);
  std::vector<std::vector<Source>> sources;
  const std::string text = format_header(header);
  std::size_t bytes = text.size();
  for (const Element& element : header.elements) {
    sources.push_back(rows.sources_of(element));
    bytes += expected_bytes(element, sources.back(), header.encoding);
  }
  Bytes out;
  out.reserve(bytes);
  out.insert(out.end(), as_bytes(text).begin(), as_bytes(text).end());
  for (std::size_t e = 0; e < sources.size(); ++e)
    write_rows(header.elements[e], sources[e], header.encoding, threads, out);
  if (rest != nullptr && header.encoding != Encoding::ascii)
    out.insert(out.end(), rest->data.begin(), rest->data.end());
  return out;
}

}  // namespace
}  // namespace ply

Result<Bytes> write_ply(const Model& model, const PlyWriteOptions& options,
                        std::vector<std::string>* dropped) {
  if (model.meshes.size() > 1) return fail(ErrorCode::bad_argument, "ply holds one mesh");
  if (!model.meshes.empty())
    if (const std::string wrong = find_inconsistency(model.meshes.front()); !wrong.empty())
      return fail(ErrorCode::bad_argument, wrong);
  ply::Description description;
  description.has_edges =
      std::ranges::any_of(model.meshes, [](const Mesh& m) { return ply::has_lines_or_points(m); });
  // Only what a mesh with other faces has is copied.
  const Model polygons = description.has_edges
                             ? Model{model.scene, {ply::polygons_of(model.meshes.front())}}
                             : Model{};
  const auto described = ply::describe(description.has_edges ? polygons : model,
                                       static_cast<ply::Encoding>(options.format), description);
  if (!described) return tl::unexpected(described.error());
  if (description.has_edges) ply::add_edges(model.meshes.front(), description);
  if (dropped) *dropped = description.dropped;
  return ply::write_file(description, ply::find_foreign(model.scene.foreign, "ply/rest"),
                         options.threads);
}

bool has_rows_bound_to_order(const Scene& scene) {
  const auto kept = ply::get_kept(scene.foreign);
  return kept && kept->has_value() &&
         std::ranges::any_of((*kept)->header.elements, [](const ply::Element& element) {
           return (element.name == "vertex" || element.name == "face" || element.name == "edge") &&
                  std::ranges::any_of(element.properties, [](const ply::Property& property) {
                    return property.kept != ply::Property::kNotKept;
                  });
         });
}

}  // namespace pstrips::inline formats
