#include "validators/locate.h"

#include <algorithm>

#include "formats/pstrip/payload/layout.h"

namespace pstrips::inline validators {
namespace {

using namespace layout;

/// The Io of the layout functions that finds where one field or list stands in a payload, by the
/// address of the object that holds it.
class LocateIo : public SizeIo {
 public:
  explicit LocateIo(const void* target) : target_(target) {}

  template <class T>
  void number(const T& v) {
    mark(&v);
    SizeIo::number(v);
  }
  template <class E>
  void choice(const E& v, std::uint8_t values) {
    mark(&v);
    SizeIo::choice(v, values);
  }
  void string(const std::string& s) {
    mark(&s);
    SizeIo::string(s);
  }
  template <class T>
  void run(const std::vector<T>& v, std::size_t first, std::uint64_t n) {
    mark(&v);
    SizeIo::run(v, first, n);
  }
  void run(const Attribute& a, std::size_t first, std::uint64_t n) {
    mark(&a);
    SizeIo::run(a, first, n);
  }
  void run(const Bytes& data, std::size_t element, std::size_t first, std::uint64_t n) {
    mark(&data);
    SizeIo::run(data, element, first, n);
  }
  template <class T>
  void packed(const std::vector<T>& v, unsigned bits, std::uint64_t n) {
    mark(&v);
    if (&v == target_) bits_ = bits;
    SizeIo::packed(v, bits, n);
  }
  template <class S, class T>
  void column(const std::vector<S>& v, T S::*field, std::size_t first, std::uint64_t n) {
    if (position_ == kNoOffset) mark(&v);  // the first column stands for the records
    SizeIo::column(v, field, first, n);
  }

  /// From the start of the payload; 0 when the target is not in it.
  std::uint64_t position() const { return position_ == kNoOffset ? 0 : position_; }
  /// The same of the byte where a number of a packed target begins.
  std::uint64_t position_in_packed(std::uint64_t element) const {
    return position() + element * bits_ / 8;
  }

 private:
  void mark(const void* at) {
    if (at == target_) position_ = size();
  }
  const void* target_;
  std::uint64_t position_ = kNoOffset;
  unsigned bits_ = 0;
};

template <class Fields>
std::uint64_t position_of(const void* target, Fields&& fields) {
  LocateIo io(target);
  fields(io);
  return io.position();
}

template <class Head, class Fields>
Head read_head(const Chunk& chunk, Fields&& fields) {
  Head head;
  ReadIo io(chunk.payload, chunk.payload_offset(), 0);
  fields(io, head);
  return head;
}

std::string numbered(const char* what, std::uint64_t i) { return what + std::to_string(i); }

class Locator {
 public:
  Locator(const Document& doc, const Where& where)
      : doc_(doc), where_(where), chunks_(doc.frame.chunks) {}

  Location find() const {
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
        return in_payload(type(kIndexChunk), 8 + kIndexRowBytes * where_.element,
                          numbered(", row ", where_.element));
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
        return chunk(at.mesh);
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
        return chunk(at.base);
      case Field::base_wedge_vertex:
        return in_base(&mesh.base_wedge_vertex, ", wedge ");
      case Field::base_map:
        return in_base(&mesh.base_map, ", map entry ");
      case Field::packet:
        return chunk(at.packets[where_.packet]);
      case Field::record:
      case Field::parent:
        return in_packet(&mesh.vsplits, where_.record, "");
      case Field::reassigned:
        return in_packet(&mesh.reassigned, i, ", reassigned wedge");
      case Field::map_offset:
        return in_packet(&mesh.map_offsets, i, ", map offset");
      case Field::faces:
        return chunk(at.faces);
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
      case Field::order:
        return chunk(at.order);
      case Field::order_vertex:
        return in_order(&mesh.order.vertex, ", vertex ");
      case Field::order_wedge:
        return in_order(&mesh.order.wedge, ", wedge ");
      case Field::order_face:
        return in_order(&mesh.order.face, ", face ");
      case Field::rotation:
        return in_order(&mesh.order.rotation, ", rotation ");
      case Field::digest:
        return chunk(at.digest);
      default:
        return {};
    }
  }

  Location in_header(const void* target, const std::string& path) const {
    const auto fields = [&](LocateIo& io) {
      mesh_fields(io, doc_.strips.meshes[where_.mesh], doc_.declared[where_.mesh]);
    };
    return in_payload(doc_.mesh_chunks[where_.mesh].mesh, position_of(target, fields), path);
  }
  Location in_base(const void* list, const char* path) const {
    const Index number = doc_.mesh_chunks[where_.mesh].base;
    if (number >= chunks_.size()) return {};
    const auto head = read_head<BaseHead>(chunks_[number],
                                          [](ReadIo& io, BaseHead& h) { base_head_fields(io, h); });
    const auto fields = [&](LocateIo& io) {
      base_head_fields(io, head);
      base_array_fields(io, head, doc_.strips.meshes[where_.mesh]);
    };
    return in_payload(number, position_of(list, fields) + 4 * where_.element,
                      numbered(path, where_.element));
  }
  Location in_packet(const void* list, std::uint64_t element, const char* path) const {
    const Index number = doc_.mesh_chunks[where_.mesh].packets[where_.packet];
    const auto head = read_head<PacketHead>(
        chunks_[number], [](ReadIo& io, PacketHead& h) { packet_head_fields(io, h); });
    const auto fields = [&](LocateIo& io) {
      packet_head_fields(io, head);
      packet_array_fields(io, head, doc_.strips.meshes[where_.mesh], PacketStart{});
    };
    return in_payload(number, position_of(list, fields) + 4 * element,
                      numbered(", vsplit ", where_.record) + path);
  }
  Location in_faces(const void* list, const char* path) const {
    const Index number = doc_.mesh_chunks[where_.mesh].faces;
    if (number >= chunks_.size()) return {};
    const auto head = read_head<FacesHead>(
        chunks_[number], [](ReadIo& io, FacesHead& h) { faces_head_fields(io, h); });
    const auto fields = [&](LocateIo& io) {
      faces_head_fields(io, head);
      faces_array_fields(io, head, doc_.strips.meshes[where_.mesh].faces, 0);
    };
    return in_payload(number, position_of(list, fields) + 4 * where_.element,
                      numbered(path, where_.element));
  }
  Location in_order(const void* list, const char* path) const {
    const Index number = doc_.mesh_chunks[where_.mesh].order;
    if (number >= chunks_.size()) return {};
    const ProgressiveMesh& mesh = doc_.strips.meshes[where_.mesh];
    const auto head = read_head<OrderHead>(
        chunks_[number], [](ReadIo& io, OrderHead& h) { order_head_fields(io, h); });
    LocateIo io(list);
    order_head_fields(io, head);
    order_array_fields(io, head, doc_.declared[where_.mesh], mesh.single_wedges, mesh.order);
    return in_payload(number, io.position_in_packed(where_.element),
                      numbered(path, where_.element));
  }

  const Document& doc_;
  const Where& where_;
  const std::vector<Chunk>& chunks_;
};

}  // namespace

Location locate_binary(const Document& doc, const Where& where) {
  return Locator(doc, where).find();
}

}  // namespace pstrips::inline validators
