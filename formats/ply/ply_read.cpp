#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>

#include "core/gather.h"
#include "formats/ply/ply.h"
#include "formats/ply/ply_body.h"
#include "formats/ply/ply_edges.h"
#include "formats/ply/ply_header.h"
#include "formats/ply/ply_kept.h"
#include "formats/ply/ply_layout.h"
#include "formats/ply/ply_numbers.h"
#include "formats/ply/ply_strips.h"
#include "formats/ply/ply_textures.h"
#include "formats/ply/ply_wedges.h"

namespace pstrips::inline formats {
namespace ply {
namespace {

using Role = Layout::Role;

class ModelReader {
 public:
  ModelReader(ByteView file, const Limits& limits, std::size_t run_bytes)
      : file_(file), limits_(limits), run_bytes_(run_bytes) {}

  Result<Model> run() {
    Result<Header> header = parse_header(file_, limits_);
    if (!header) return tl::unexpected<Error>(header.error());
    kept_.header = *std::move(header);
    model_.scene.texture_origin = TextureOrigin::lower_left;
    if (!plan() || !expect_room() || !read_body() || !keep_rest())
      return tl::unexpected<Error>(std::move(error_));
    if (has_mesh_) {
      if (!expand_strips() || !set_wedge_vertices() || !set_texcoords())
        return tl::unexpected<Error>(std::move(error_));
      if (!read_textures(kept_.header, limits_.meshes, model_.scene, mesh_))
        return fail(ErrorCode::over_limit, "more textures than the limit");
      canonicalize(mesh_);
      for (Element& e : kept_.header.elements)
        if (e.name == "vertex" || e.name == "face") e.count = 0;
      if (!kept_.columns.empty()) kept_.digest = digest_of(mesh_);
      read_edges(kept_, vertex_layout_.has(Role::wedge_vertex), mesh_);
      model_.meshes.push_back(std::move(mesh_));
    }
    put_kept(kept_, model_.scene.foreign);
    if (!rest_.empty())
      model_.scene.foreign.push_back({"ply/rest", Bytes(rest_.begin(), rest_.end())});
    return std::move(model_);
  }

 private:
  bool refuse(Error error) {
    error_ = std::move(error);
    return false;
  }
  bool refuse(ErrorCode code, std::string_view message, std::string_view element) {
    return refuse(
        {code, std::string(message), kept_.header.body, "element " + std::string(element)});
  }
  Element* element(std::string_view name) { return kept_.header.find(name); }

  /// Decides from the header alone what goes where.
  bool plan() {
    kept_.header.encoding = std::exchange(encoding_, kept_.header.encoding);
    const Element* const vertex = element("vertex");
    has_mesh_ = vertex != nullptr;
    if (!has_mesh_) {
      for (const std::string_view name : {"face", "tristrips"})
        if (element(name) != nullptr && element(name)->count != 0)
          return refuse(ErrorCode::corrupt, "has faces but no vertices", name);
      return true;
    }
    const std::uint64_t most =
        std::min<std::uint64_t>({limits_.vertices, limits_.wedges, kMaxCount});
    if (vertex->count > most)
      return refuse(ErrorCode::over_limit, over_limit_message(vertex->count, "vertices", most),
                    "vertex");
    const Element* const face = element("face");
    if (face != nullptr) face_layout_ = face_layout(*face);
    vertex_layout_ = vertex_layout(*vertex, face != nullptr && has_texcoord_list(*face));
    if (!vertex_layout_.has_position)
      return refuse(ErrorCode::unsupported, "vertices have no x, y and z", "vertex");
    return plan_faces() && plan_strips();
  }

  bool plan_faces() {
    const Element* const face = element("face");
    if (face == nullptr) return true;
    if (const auto most = std::min<std::uint64_t>(limits_.corners, kMaxCount); face->count > most)
      return refuse(ErrorCode::over_limit, over_limit_message(face->count, "faces", most), "face");
    for (std::size_t p = 0; p < face->properties.size(); ++p)
      if (face_layout_.places[p].role == Role::corners) {
        if (is_integer(face->properties[p].type)) return true;
        return refuse(ErrorCode::unsupported, "vertex indices are not integers", "face");
      }
    return face->count == 0 ||
           refuse(ErrorCode::unsupported, "faces have no vertex indices", "face");
  }

  bool plan_strips() {
    const Element* const strips = element("tristrips");
    if (strips == nullptr) return true;
    const Element* const face = element("face");
    if (face != nullptr && face->properties.size() > 1 && strips->count != 0)
      return refuse(ErrorCode::unsupported, "strips beside faces with properties", "tristrips");
    if (strips->properties.size() != 1 || !strips->properties[0].is_list())
      return refuse(ErrorCode::unsupported, "strips are not one list", "tristrips");
    if (!is_integer(strips->properties[0].type))
      return refuse(ErrorCode::unsupported, "vertex indices are not integers", "tristrips");
    return true;
  }

  /// Refuses by the rows that the header announces, before the first is read.
  bool expect_room() {
    constexpr std::uint64_t kMax = ~std::uint64_t{0};
    std::uint64_t bytes = 0;
    for (const Element& e : kept_.header.elements) {
      std::uint64_t row_bytes = 0;
      for (const Property& property : e.properties)
        row_bytes += property.is_list() ? 0 : size_of(property.type);
      if (row_bytes == 0) continue;
      bytes += std::min(e.count, (kMax - bytes) / row_bytes) * row_bytes;
    }
    return bytes <= limits_.memory_bytes ||
           refuse({ErrorCode::over_limit,
                   over_limit_message(bytes, "bytes of memory", limits_.memory_bytes),
                   kept_.header.body,
                   {}});
  }

  bool read_body() {
    const std::uint64_t vertices = has_mesh_ ? element("vertex")->count : 0;
    BodyReader body(
        file_, kept_.header.body, encoding_,
        {vertices, std::min<std::uint64_t>(limits_.corners, kMaxCount), limits_.memory_bytes},
        limits_.threads, run_bytes_);
    for (Element& e : kept_.header.elements) {
      if (const auto good = body.expect(e); !good) return refuse(good.error());
      if (!make_room(e)) return false;
      if (e.name == "tristrips" && has_mesh_) strips_offset_ = body.position();
      if (const auto good = body.read(e, sinks_); !good) return refuse(good.error());
    }
    rest_ = body.rest();
    return true;
  }

  /// Sinks for the rows of an element, and memory for its scalars.
  bool make_room(Element& e) {
    sinks_.assign(e.properties.size(), {});
    kept_rows_ = e.count;
    if (!has_mesh_) return keep_element(e);
    if (e.name == "vertex") return make_room(e, vertex_layout_, mesh_.wedge_attributes);
    if (e.name == "face") return make_room(e, face_layout_, mesh_.face_attributes);
    if (e.name != "tristrips") return keep_element(e);
    sinks_[0] = {.kind = Sink::Kind::list, .list = &strips_};
    return true;
  }

  bool keep_element(Element& e) {
    for (std::size_t p = 0; p < e.properties.size(); ++p)
      if (!keep(e.properties[p], sinks_[p])) return false;
    return true;
  }

  bool make_room(Element& e, Layout& layout, std::vector<Attribute>& attributes) {
    attributes = std::move(layout.attributes);
    for (Attribute& attribute : attributes)
      if (!allocate(attribute.data, e.count, attribute.element_bytes())) return false;
    Attribute& position = mesh_.position;
    if (layout.has_position) {
      position.type = layout.position_type;
      if (!allocate(position.data, e.count, position.element_bytes())) return false;
    }
    const auto component_of = [](Attribute& a, std::size_t c) -> Sink {
      return {.stored = a.type,
              .data = a.data.empty() ? nullptr : a.data.data() + c * size_of(a.type),
              .stride = a.element_bytes()};
    };
    for (std::size_t p = 0; p < e.properties.size(); ++p) {
      const Layout::Place& place = layout.places[p];
      switch (place.role) {
        case Role::position:
          sinks_[p] = component_of(position, place.component);
          break;
        case Role::attribute:
          sinks_[p] = component_of(attributes[place.attribute], place.component);
          break;
        case Role::wedge_vertex:
          if (!allocate(wedge_vertices_, e.count, sizeof(Index))) return false;
          sinks_[p] = {.stored = ComponentType::u32,
                       .data = wedge_vertices_.data(),
                       .stride = sizeof(Index)};
          break;
        case Role::corners:
          sinks_[p] = {.kind = Sink::Kind::faces, .faces = &faces_};
          break;
        case Role::texcoord:
          sinks_[p] = {.kind = Sink::Kind::list, .list = &texcoords_};
          break;
        case Role::kept:
          if (!keep(e.properties[p], sinks_[p])) return false;
          break;
      }
    }
    return true;
  }

  bool keep(Property& property, Sink& sink) {
    property.kept = kept_.columns.size();
    KeptColumn& column = kept_.columns.emplace_back();
    column.rows = kept_rows_;
    const std::size_t bytes = size_of(property.type);
    if (!property.is_list() && !allocate(column.data.values, kept_rows_, bytes)) return false;
    sink = {.kind = property.is_list() ? Sink::Kind::list : Sink::Kind::scalars,
            .stored = property.type,
            .data = column.data.values.data(),
            .stride = bytes,
            .list = &column.data};
    return true;
  }

  bool allocate(Bytes& data, std::uint64_t rows, std::size_t row_bytes) {
    // rows × row_bytes is at most eight times the file: BodyReader::expect has seen to it.
    const std::uint64_t bytes = rows * row_bytes;
    if (bytes > limits_.memory_bytes - used_bytes_)
      return refuse(
          {ErrorCode::over_limit,
           over_limit_message(used_bytes_ + bytes, "bytes of memory", limits_.memory_bytes),
           kept_.header.body,
           {}});
    used_bytes_ += bytes;
    data.resize(bytes);
    return true;
  }

  bool keep_rest() {
    if (encoding_ != Encoding::ascii || rest_.empty()) return true;
    const std::uint64_t offset = file_.size() - rest_.size();
    return refuse(
        {ErrorCode::corrupt, "has values after its last element", offset, line_of(file_, offset)});
  }

  bool expand_strips() {
    Element* const strips = element("tristrips");
    if (strips != nullptr) {
      const std::uint64_t most = std::min<std::uint64_t>(limits_.corners, kMaxCount);
      StripExpander expander(faces_, element("vertex")->count, most);
      auto error = expander.add(strips_, strips->properties[0].type, strips_offset_);
      if (error) return refuse(*std::move(error));
      turn_strips_into_faces(kept_.header);
    }
    mesh_.corners = std::move(faces_.corners);
    mesh_.face_first = std::move(faces_.first);
    return true;
  }

  /// Rows that are wedges: finds each vertex again at its first row.
  bool set_wedge_vertices() {
    if (!vertex_layout_.has(Role::wedge_vertex)) return true;
    const auto wrong = [&](std::string_view message) {
      return refuse(ErrorCode::corrupt, message, "vertex");
    };
    std::vector<Index>& wedge_vertex = mesh_.wedge_vertex;
    wedge_vertex.resize(wedge_vertices_.size() / sizeof(Index));
    if (!wedge_vertex.empty())
      std::memcpy(wedge_vertex.data(), wedge_vertices_.data(), wedge_vertices_.size());
    std::vector<Index> first_row(wedge_vertex.size(), kNone);
    const std::size_t bytes = mesh_.position.element_bytes();
    Index vertices = 0;
    for (Index row = 0; row < wedge_vertex.size(); ++row) {
      const Index v = wedge_vertex[row];
      if (v >= first_row.size()) return wrong("wedge_vertex is past the rows");
      vertices = std::max(vertices, v + 1);
      if (first_row[v] == kNone) first_row[v] = row;
      const std::byte* const data = mesh_.position.data.data();
      if (std::memcmp(data + row * bytes, data + first_row[v] * bytes, bytes) != 0)
        return wrong("wedges of one vertex have different positions");
    }
    first_row.resize(vertices);
    if (std::ranges::count(first_row, kNone) != 0) return wrong("wedge_vertex leaves a vertex out");
    mesh_.position.data = gather(mesh_.position.data, bytes, first_row);
    return true;
  }

  /// Turns the faces' texcoord lists into wedges, or keeps them when they are not pairs a corner.
  bool set_texcoords() {
    const auto place = std::ranges::find(face_layout_.places, Role::texcoord, &Layout::Place::role);
    if (place == face_layout_.places.end()) return true;
    Property& property =
        element("face")->properties[static_cast<std::size_t>(place - face_layout_.places.begin())];
    bool pairs = mesh_.wedge_vertex.empty() && !vertex_layout_.has(Role::wedge_vertex);
    for (Index f = 0; pairs && f < texcoords_.sizes.size(); ++f)
      pairs = texcoords_.sizes[f] == 2 * mesh_.face(f).size();
    if (!pairs) {
      property.kept = kept_.columns.size();
      kept_.columns.push_back({texcoords_.sizes.size(), std::move(texcoords_)});
      return true;
    }
    CornerWedges wedges = wedges_of_corners(mesh_.corners, mesh_.vertex_count(), texcoords_.values,
                                            2 * size_of(property.type));
    if (wedges.wedge_vertex.size() > std::min<std::uint64_t>(limits_.wedges, kMaxCount))
      return refuse(ErrorCode::over_limit, "more wedges than the limit", "face");
    for (Attribute& attribute : mesh_.wedge_attributes)
      attribute.data = gather(attribute.data, attribute.element_bytes(), wedges.wedge_vertex);
    mesh_.wedge_attributes.push_back({.semantic = "TEXCOORD_0",
                                      .type = property.type,
                                      .count = 2,
                                      .normalized = false,
                                      .data = std::move(wedges.pairs)});
    mesh_.wedge_vertex = std::move(wedges.wedge_vertex);
    mesh_.corners = std::move(wedges.corners);
    return true;
  }

  ByteView file_;
  const Limits& limits_;
  const std::size_t run_bytes_;
  Model model_;
  Mesh mesh_;
  Kept kept_;
  Encoding encoding_ = Encoding::ascii;  // the file's; the kept header says ascii
  bool has_mesh_ = false;
  Layout vertex_layout_, face_layout_;
  std::vector<Sink> sinks_;
  std::uint64_t kept_rows_ = 0, used_bytes_ = 0, strips_offset_ = 0;
  FaceLists faces_;
  ListColumn texcoords_, strips_;
  Bytes wedge_vertices_;
  ByteView rest_;
  Error error_;
};

}  // namespace

Result<Model> read_ply_in_runs(ByteView file, const Limits& limits, std::size_t run_bytes) {
  return ModelReader(file, limits, run_bytes).run();
}

}  // namespace ply

Result<Model> read_ply(ByteView file, const Limits& limits) {
  return ply::read_ply_in_runs(file, limits, ply::kRunBytes);
}

}  // namespace pstrips::inline formats
