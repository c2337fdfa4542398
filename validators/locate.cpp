#include "validators/locate.h"

#include <algorithm>

#include "formats/pstrip/payload/extras.h"
#include "formats/pstrip/payload/geometry_layout.h"
#include "formats/pstrip/payload/index_rows.h"

namespace pstrips::inline validators {
namespace {

using namespace layout;

template <class Fields>
std::uint64_t position_of(const void* target, Fields&& fields) {
  LocateIo io(target);
  fields(io);
  return io.position();
}

std::string numbered(const char* what, std::uint64_t i) { return what + std::to_string(i); }

class Locator {
 public:
  Locator(const Document& doc, const Where& where)
      : doc_(doc), where_(where), chunks_(doc.frame.chunks) {}

  Location locate() const {
    switch (where_.field) {
      case Field::file:
        return byte(where_.element);
      case Field::chunk:
        return chunk(static_cast<Index>(where_.element));
      case Field::header:
        return in_payload(type(kHeaderChunk), where_.element, "");
      case Field::index:
        return chunk(type(kIndexChunk));
      case Field::row:
        return row();
      case Field::node:
        return in_scene(&doc_.strips.scene.nodes[where_.element].name, ", node ");
      case Field::material:
        return in_materials(&doc_.strips.scene.materials[where_.element].name, ", material ");
      case Field::image:
        return in_materials(&doc_.strips.scene.images[where_.element].name, ", image ");
      case Field::foreign:
        return foreign();
      default:
        return in_mesh();
    }
  }

 private:
  Location row() const {
    const auto before = std::span(doc_.index).first(where_.element);
    const std::uint64_t at = size_of_fields([&](SizeIo& io) {
      const Index index = type(kIndexChunk);
      const std::uint64_t start = chunks_[index].offset + chunks_[index].bytes();
      index_fields(io, before, doc_.strips.meshes, start);
    });
    return in_payload(type(kIndexChunk), at, numbered(", row ", where_.element));
  }

  /// The first chunk of the type; kNone when there is none.
  Index type(const ChunkType& wanted) const {
    const auto found = std::ranges::find(chunks_, wanted, &Chunk::type);
    return found == chunks_.end() ? kNone : static_cast<Index>(found - chunks_.begin());
  }

  /// "PCKT 3": chunks are counted by type.
  std::string name(Index number) const {
    const Chunk& c = chunks_[number];
    const auto before =
        std::ranges::count(chunks_.begin(), chunks_.begin() + number, c.type, &Chunk::type);
    return std::string(name_of(c.type)) + " " + std::to_string(before);
  }
  Location chunk(Index number) const {
    if (number >= chunks_.size()) return {};
    return {chunks_[number].offset, name(number)};
  }
  Location in_payload(Index number, std::uint64_t position, const std::string& path) const {
    if (number >= chunks_.size()) return {};
    return {chunks_[number].payload_offset() + position, name(number) + path};
  }
  Location byte(std::uint64_t offset) const {
    for (Index i = 0; i < chunks_.size(); ++i) {
      const Chunk& c = chunks_[i];
      if (offset < c.offset || offset >= c.offset + c.bytes()) continue;
      if (offset < c.payload_offset()) return {offset, name(i)};
      return {offset, name(i) + ", byte " + std::to_string(offset - c.payload_offset())};
    }
    return {offset, ""};
  }
  Location in_scene(const void* target, const char* what) const {
    return in_payload(type(kSceneChunk),
                      position_of(target, [&](LocateIo& io) { scene_fields(io, doc_.strips); }),
                      numbered(what, where_.element));
  }
  Location in_materials(const void* target, const char* what) const {
    const std::vector<std::uint8_t> embedded(doc_.strips.scene.images.size());
    return in_payload(
        type(kMaterialsChunk),
        position_of(target,
                    [&](LocateIo& io) { material_fields(io, doc_.strips.scene, embedded); }),
        numbered(what, where_.element));
  }
  Location foreign() const {
    std::uint64_t left = where_.element;
    for (Index i = 0; i < chunks_.size(); ++i)
      if (chunks_[i].type == kForeignChunk && left-- == 0) return chunk(i);
    return {};
  }

  Location in_mesh() const {
    const MeshChunks& at = doc_.mesh_chunks[where_.mesh];
    const ProgressiveMesh& mesh = doc_.strips.meshes[where_.mesh];
    const std::uint64_t i = where_.element;
    switch (where_.field) {
      case Field::mesh:
        return chunk(find(kMeshChunk));
      case Field::position_format:
        return in_header(&mesh.position.semantic, ", position");
      case Field::wedge_format:
        return in_header(&mesh.wedge_attributes[i].semantic, numbered(", wedge attribute ", i));
      case Field::face_format:
        return in_header(&mesh.face_attribute_formats[i].semantic,
                         numbered(", face attribute ", i));
      case Field::group:
        return in_header(&mesh.groups[i].name, numbered(", group ", i));
      case Field::counts: {
        const MeshCounts& c = doc_.declared[where_.mesh];
        const Index* const counts[] = {&c.vertices, &c.wedges,        &c.triangles,
                                       &c.strips,   &c.map_entries,   &c.vsplits,
                                       &c.faces,    &c.base_vertices, &c.base_wedges};
        return in_header(counts[i], ", counts");
      }
      case Field::base:
        return chunk(find(kBaseChunk));
      case Field::base_wedge_vertex:
        return in_base(&mesh.base_wedge_vertex, ", wedge ");
      case Field::base_map:
        return in_base(&mesh.base_map, ", map entry ");
      case Field::triangle_group:
        return triangle_group();
      case Field::packet:
        return chunk(at.packets[where_.packet]);
      case Field::record:
      case Field::parent:
        return in_packet(&mesh.vsplits, where_.record, "");
      case Field::reassigned:
        return in_packet(&mesh.reassigned, i, ", reassigned wedge");
      case Field::map_offset:
        return in_packet(&mesh.map_offsets, i, ", map offset");
      case Field::new_corner:
        return in_packet(&mesh.new_corners, i, ", corner of a new triangle");
      case Field::faces:
        return chunk(find(kFacesChunk));
      case Field::face_first:
        return in_faces(&mesh.faces.first, ", face ");
      case Field::face_corner:
        return in_faces(&mesh.faces.corners, ", corner ");
      case Field::face_group:
        return in_faces(&mesh.faces.group, ", group of face ");
      case Field::replaced_first:
        return in_faces(&mesh.faces.replaced_first, ", face ");
      case Field::replaced:
        return in_faces(&mesh.faces.replaced, ", replaced triangle ");
      case Field::welding:
        return chunk(find(kWeldingChunk));
      case Field::digest:
        return chunk(find(kDigestChunk));
      default:
        return in_order();
    }
  }
  Location in_order() const {
    const ProgressiveMesh& mesh = doc_.strips.meshes[where_.mesh];
    switch (where_.field) {
      case Field::order:
        return chunk(find(kOrderChunk));
      case Field::order_vertex:
        return in_extra(OrderPayload{}, &mesh.order.vertex, ", vertex ");
      case Field::order_wedge:
        return in_extra(OrderPayload{}, &mesh.order.wedge, ", wedge ");
      case Field::order_face:
        return in_extra(OrderPayload{}, &mesh.order.face, ", face ");
      case Field::rotation:
        return in_extra(OrderPayload{}, &mesh.order.rotation, ", rotation ");
      default:
        return {};
    }
  }

  Location in_header(const void* target, const std::string& path) const {
    const auto fields = [&](LocateIo& io) {
      mesh_fields(io, doc_.strips.meshes[where_.mesh], doc_.declared[where_.mesh],
                  doc_.strips.profile);
    };
    return in_payload(find(kMeshChunk), position_of(target, fields), path);
  }
  /// Where they are coded, no element has bytes of its own.
  Location in_faces(const void* list, const char* path) const {
    if (doc_.strips.profile == Profile::plain) return in_extra(FacesPayload{}, list, path);
    return in_payload(find(kFacesChunk), 0, numbered(path, where_.element));
  }
  Location in_base(const void* list, const char* path) const {
    return in_geometry(find(kBaseChunk), list, where_.element, numbered(path, where_.element));
  }
  Location in_packet(const void* list, std::uint64_t element, const char* path) const {
    return in_geometry(doc_.mesh_chunks[where_.mesh].packets[where_.packet], list, element,
                       numbered(", vsplit ", where_.record) + path);
  }
  /// In the BASE or the PCKT that brings the triangle.
  Location triangle_group() const {
    const ProgressiveMesh& mesh = doc_.strips.meshes[where_.mesh];
    const std::string path = numbered(", group of triangle ", where_.element);
    std::uint64_t first = 0, end = mesh.base_map.size() / 3;
    Index chunk = find(kBaseChunk);
    std::size_t vsplit = 0;
    for (std::size_t k = 0; end <= where_.element; ++k) {
      chunk = doc_.mesh_chunks[where_.mesh].packets[k];
      first = end;
      const Packet& packet = doc_.strips.packets[doc_.packets_of[where_.mesh][k]];
      for (const std::size_t last = vsplit + packet.vsplits; vsplit < last; ++vsplit)
        end += mesh.vsplits[vsplit].triangles;
    }
    return in_geometry(chunk, &mesh.triangle_group, where_.element - first, path);
  }
  Location in_geometry(Index number, const void* list, std::uint64_t element,
                       const std::string& path) const {
    if (number >= chunks_.size()) return {};
    const GeometryLayout& layout = layout_of(doc_.strips.profile);
    const ProgressiveMesh& mesh = doc_.strips.meshes[where_.mesh];
    return in_payload(number, layout.position_of(chunks_[number], mesh, list, element), path);
  }
  /// In a chunk of the description Extra. [payload/extras.h]
  template <class Extra>
  Location in_extra(Extra extra, const void* list, const char* path) const {
    const Index number = find(Extra::kType);
    if (number >= chunks_.size()) return {};
    FirstFault ignored;
    ReadIo in(chunks_[number], 0, ignored);
    typename Extra::Head head;
    Extra::head_fields(in, head);
    LocateIo io(list);
    extra_fields(io, extra, std::as_const(head), doc_.declared[where_.mesh],
                 doc_.strips.meshes[where_.mesh]);
    return in_payload(number, io.position_of_element(where_.element),
                      numbered(path, where_.element));
  }
  /// The chunk of the type that the mesh has one of.
  Index find(const ChunkType& type) const { return doc_.mesh_chunks[where_.mesh].find(type); }

  const Document& doc_;
  const Where& where_;
  const std::vector<Chunk>& chunks_;
};

}  // namespace

Location locate_binary(const Document& doc, const Where& where) {
  return Locator(doc, where).locate();
}

}  // namespace pstrips::inline validators
