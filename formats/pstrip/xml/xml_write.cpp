#include "formats/pstrip/numbers.h"
#include "formats/pstrip/payload/check.h"
#include "formats/pstrip/xml/xml.h"
#include "formats/pstrip/xml/xml_names.h"
#include "formats/pstrip/xml/xml_text.h"

namespace pstrips::inline formats {
namespace {

/// Elements with their attributes, one a line, indented by their depth.
class XmlWriter {
 public:
  XmlWriter() { out_.text("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"); }

  void begin(std::string_view name) {
    indent();
    out_.character('<');
    out_.text(name);
  }
  void end_empty() { out_.text("/>\n"); }
  void end_start() {
    out_.text(">\n");
    ++depth_;
  }
  void close(std::string_view name) {
    --depth_;
    indent();
    close_text(name);
  }
  /// The start of an element that holds text; its content follows directly.
  void begin_text() { out_.character('>'); }
  void close_text(std::string_view name) {
    out_.text("</");
    out_.text(name);
    out_.text(">\n");
  }

  void begin_attribute(std::string_view name) {
    out_.character(' ');
    out_.text(name);
    out_.text("=\"");
  }
  void end_attribute() { out_.character('"'); }

  void string(std::string_view name, std::string_view value) {
    begin_attribute(name);
    write_string(out_, value);
    end_attribute();
  }
  void index(std::string_view name, std::uint32_t value) {
    begin_attribute(name);
    out_.integer(value);
    end_attribute();
  }
  void index_unless_none(std::string_view name, Index value) {
    if (value != kNone) index(name, value);
  }
  template <class T>
  void real(std::string_view name, T value) {
    begin_attribute(name);
    out_.real(value);
    end_attribute();
  }
  void flag(std::string_view name, bool value) { string(name, value ? "true" : "false"); }
  template <std::size_t N>
  void reals(std::string_view name, const std::array<double, N>& values) {
    begin_attribute(name);
    for (std::size_t i = 0; i < N; ++i) {
      if (i > 0) out_.character(' ');
      out_.real(values[i]);
    }
    end_attribute();
  }
  void indices(std::string_view name, std::span<const Index> list) {
    begin_attribute(name);
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (i > 0) out_.character(' ');
      out_.integer(list[i]);
    }
    end_attribute();
  }

  TextWriter& out() { return out_; }
  Bytes take() && { return std::move(out_).take(); }

 private:
  void indent() {
    for (int i = 0; i < depth_; ++i) out_.character(' ');
  }
  TextWriter out_;
  int depth_ = 0;
};

/// `elements` of an attribute as the text of an element, one a line.
void write_elements(XmlWriter& xml, std::string_view name, const Attribute& a,
                    std::size_t elements) {
  xml.begin(name);
  xml.begin_text();
  for (std::size_t i = 0; i < elements; ++i) {
    if (i > 0) xml.out().character('\n');
    xml.out().element(a, a.element(i));
  }
  xml.close_text(name);
}

template <class T>
void write_list(XmlWriter& xml, std::string_view name, const std::vector<T>& list) {
  constexpr std::size_t kPerLine = 16;
  xml.begin(name);
  xml.begin_text();
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (i > 0) xml.out().character(i % kPerLine == 0 ? '\n' : ' ');
    xml.out().integer(std::uint32_t{list[i]});
  }
  xml.close_text(name);
}

/// One strip a line.
void write_map(XmlWriter& xml, std::span<const Index> map) {
  xml.begin("map");
  xml.begin_text();
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (i > 0) xml.out().character(map[i - 1] == kRestart ? '\n' : ' ');
    if (is_wedge(map[i]))
      xml.out().integer(map[i]);
    else
      xml.out().text(name_of_marker(map[i]));
  }
  xml.close_text("map");
}

void write_format(XmlWriter& xml, std::string_view name, const Attribute& a) {
  xml.begin(name);
  xml.string("semantic", a.semantic);
  xml.string("type", name_of(a.type));
  xml.index("count", a.count);
  if (a.normalized) xml.flag("normalized", true);
  xml.end_empty();
}

void write_scene(XmlWriter& xml, const ProgressiveStrips& strips) {
  if (strips.generator.empty() && strips.scene.nodes.empty()) return;
  xml.begin("scene");
  xml.string("generator", strips.generator);
  xml.end_start();
  for (const Node& node : strips.scene.nodes) {
    xml.begin("node");
    xml.string("name", node.name);
    xml.index_unless_none("parent", node.parent);
    xml.reals("matrix", node.matrix);
    xml.indices("meshes", node.meshes);
    xml.end_empty();
  }
  xml.close("scene");
}

void write_materials(XmlWriter& xml, const Scene& scene) {
  if (scene.materials.empty() && scene.images.empty()) return;
  xml.begin("materials");
  xml.end_start();
  for (const Material& m : scene.materials) {
    xml.begin("material");
    xml.string("name", m.name);
    xml.reals("base_color", m.base_color);
    xml.reals("emissive", m.emissive);
    xml.real("metallic", m.metallic);
    xml.real("roughness", m.roughness);
    xml.index_unless_none("base_color_image", m.base_color_image);
    xml.flag("double_sided", m.double_sided);
    xml.end_empty();
  }
  for (const Image& image : scene.images) {
    xml.begin("image");
    xml.string("name", image.name);
    xml.string("uri", image.uri);
    xml.string("mime_type", image.mime_type);
    xml.end_empty();
  }
  xml.close("materials");
}

void write_mesh(XmlWriter& xml, const ProgressiveMesh& mesh) {
  xml.begin("mesh");
  xml.string("name", mesh.name);
  xml.string("encoding", name_of(mesh.encoding));
  xml.string("placement", name_of(mesh.placement));
  xml.flag("single_wedges", mesh.single_wedges);
  xml.index("vertices", mesh.vertices);
  xml.index("wedges", mesh.wedges);
  xml.index("triangles", mesh.triangles);
  xml.index("strips", mesh.strips);
  xml.index("base_vertices", mesh.base_vertices);
  xml.index("base_wedges", mesh.base_wedges);
  xml.end_start();
  write_format(xml, "position", mesh.position);
  for (const Attribute& a : mesh.wedge_attributes) write_format(xml, "wedge_attribute", a);
  for (const Attribute& a : mesh.face_attribute_formats) write_format(xml, "face_attribute", a);
  for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
    xml.begin("group");
    xml.string("name", mesh.groups[g].name);
    xml.index_unless_none("material", mesh.groups[g].material);
    xml.string("kind", name_of(mesh.groups[g].kind));
    xml.index("map_entries", mesh.group_entries[g]);
    xml.end_empty();
  }
  xml.close("mesh");
}

void write_level(XmlWriter& xml, const Packet& level) {
  xml.index("vertices", level.vertices);
  xml.index("triangles", level.triangles);
  xml.index("strips", level.strips);
  xml.real("error", level.error);
  xml.real("one_sided_error", level.one_sided_error);
}

void write_base(XmlWriter& xml, const ProgressiveMesh& mesh, const BaseLevel& base) {
  xml.begin("base");
  xml.index("mesh", base.mesh);
  write_level(xml, base);
  xml.end_start();
  write_elements(xml, "positions", mesh.position, mesh.base_vertices);
  if (!mesh.single_wedges) write_list(xml, "wedge_vertex", mesh.base_wedge_vertex);
  for (const Attribute& a : mesh.wedge_attributes)
    write_elements(xml, "values", a, mesh.base_wedges);
  write_map(xml, mesh.base_map);
  xml.close("base");
}

/// All attributes of one wedge, one after the other.
void write_values(XmlWriter& xml, const ProgressiveMesh& mesh, std::size_t wedge) {
  if (mesh.wedge_attributes.empty()) return;
  xml.begin_attribute("values");
  for (const Attribute& a : mesh.wedge_attributes) {
    if (&a != &mesh.wedge_attributes.front()) xml.out().character(' ');
    xml.out().element(a, a.element(wedge));
  }
  xml.end_attribute();
}

void write_vsplit(XmlWriter& xml, const ProgressiveMesh& mesh, const PacketStart& at) {
  const Vsplit& v = mesh.vsplits[at.vsplit];
  xml.begin("vsplit");
  xml.index("parent", v.parent);
  xml.begin_attribute("position");
  xml.out().element(mesh.position, mesh.position.element(at.vertices));
  xml.end_attribute();
  if (mesh.placement == Placement::optimal) {
    const std::size_t bytes = mesh.position.element_bytes();
    xml.begin_attribute("parent_position");
    xml.out().element(mesh.position,
                      ByteView(mesh.parent_position).subspan(at.vsplit * bytes, bytes));
    xml.end_attribute();
  }
  const std::span<const Index> map_offsets(mesh.map_offsets);
  if (mesh.single_wedges) {
    write_values(xml, mesh, at.wedges);
    xml.indices("map_offsets", map_offsets.subspan(at.map_offset, v.map_offsets));
    return xml.end_empty();
  }
  if (v.reassigned > 0)
    xml.indices("reassigned", std::span(mesh.reassigned).subspan(at.reassigned, v.reassigned));
  if (v.wedges == 0) return xml.end_empty();
  xml.end_start();
  std::size_t place = at.map_offset;
  for (Index w = 0; w < v.wedges; ++w) {
    const Index count = mesh.wedge_offset_counts[at.offset_count + w];
    xml.begin("wedge");
    write_values(xml, mesh, at.wedges + w);
    xml.indices("map_offsets", map_offsets.subspan(place, count));
    xml.end_empty();
    place += count;
  }
  xml.close("vsplit");
}

void write_packet(XmlWriter& xml, const ProgressiveMesh& mesh, const Packet& packet,
                  PacketStart& at) {
  xml.begin("packet");
  xml.index("mesh", packet.mesh);
  xml.index("first_vsplit", packet.first_vsplit);
  xml.index("vsplits", packet.vsplits);
  write_level(xml, packet);
  xml.end_start();
  for (Index i = 0; i < packet.vsplits; ++i) {
    write_vsplit(xml, mesh, at);
    at = packet_after(mesh, at, 1);
  }
  xml.close("packet");
}

void write_faces(XmlWriter& xml, const ProgressiveMesh& mesh, Index index) {
  const FaceTable& faces = mesh.faces;
  if (faces.empty()) return;
  xml.begin("faces");
  xml.index("mesh", index);
  xml.end_start();
  const auto run = [](const std::vector<Index>& list, const std::vector<Index>& first, Index i) {
    return std::span(list).subspan(first[i], first[i + 1] - first[i]);
  };
  for (Index f = 0; f < faces.count(); ++f) {
    xml.begin("face");
    xml.index("group", faces.group[f]);
    xml.indices("corners", run(faces.corners, faces.first, f));
    xml.indices("replaced", run(faces.replaced, faces.replaced_first, f));
    xml.end_empty();
  }
  for (const Attribute& a : faces.attributes) write_elements(xml, "values", a, a.elements());
  xml.close("faces");
}

void write_order(XmlWriter& xml, const ProgressiveMesh& mesh, Index index) {
  if (mesh.order == OriginalOrder{}) return;
  xml.begin("order");
  xml.index("mesh", index);
  xml.end_start();
  write_list(xml, "vertex", mesh.order.vertex);
  if (!mesh.single_wedges) write_list(xml, "wedge", mesh.order.wedge);
  write_list(xml, "face", mesh.order.face);
  write_list(xml, "rotation", mesh.order.rotation);
  xml.close("order");
}

void write_digest(XmlWriter& xml, const ProgressiveMesh& mesh, Index index) {
  if (mesh.digest.empty()) return;
  xml.begin("digest");
  xml.index("mesh", index);
  xml.string("algorithm", kDigestAlgorithm);
  xml.begin_text();
  constexpr char kDigits[] = "0123456789abcdef";
  for (const std::byte b : mesh.digest) {
    xml.out().character(kDigits[std::to_integer<unsigned>(b) >> 4]);
    xml.out().character(kDigits[std::to_integer<unsigned>(b) & 15]);
  }
  xml.close_text("digest");
}

void write_images(XmlWriter& xml, const Scene& scene) {
  for (std::size_t i = 0; i < scene.images.size(); ++i) {
    if (scene.images[i].data.empty()) continue;
    xml.begin("image_data");
    xml.index("image", static_cast<Index>(i));
    xml.begin_text();
    write_base64(xml.out(), scene.images[i].data);
    xml.close_text("image_data");
  }
}

void write_foreign(XmlWriter& xml, const Foreign& foreign) {
  const bool as_content = fits_content(foreign.data);
  xml.begin("foreign");
  xml.string("key", foreign.key);
  xml.string("form", as_content ? "text" : "base64");
  xml.begin_text();
  if (as_content)
    write_content(xml.out(), foreign.data);
  else
    write_base64(xml.out(), foreign.data);
  xml.close_text("foreign");
}

void write_unknown(XmlWriter& xml, const UnknownChunk& chunk) {
  xml.begin("chunk");
  xml.string("type", {chunk.type.data(), chunk.type.size()});
  xml.begin_text();
  write_base64(xml.out(), chunk.payload);
  xml.close_text("chunk");
}

}  // namespace

Bytes write_xml(const ProgressiveStrips& strips) {
  XmlWriter xml;
  xml.begin("pstrips");
  xml.string("version", kXmlVersion);
  xml.string("profile", name_of(strips.profile));
  if (!strips.complete) xml.flag("complete", false);
  xml.end_start();
  write_scene(xml, strips);
  write_materials(xml, strips.scene);
  for (const ProgressiveMesh& mesh : strips.meshes) write_mesh(xml, mesh);
  std::vector<PacketStart> reached;
  for (std::size_t m = 0; m < strips.meshes.size(); ++m) {
    write_base(xml, strips.meshes[m], strips.bases[m]);
    reached.push_back(first_packet(strips.meshes[m]));
  }
  for (const Packet& packet : strips.packets)
    write_packet(xml, strips.meshes[packet.mesh], packet, reached[packet.mesh]);
  for (Index m = 0; m < strips.meshes.size(); ++m) {
    write_faces(xml, strips.meshes[m], m);
    write_order(xml, strips.meshes[m], m);
    write_digest(xml, strips.meshes[m], m);
  }
  write_images(xml, strips.scene);
  for (const Foreign& foreign : strips.scene.foreign) write_foreign(xml, foreign);
  for (const UnknownChunk& chunk : strips.unknown) write_unknown(xml, chunk);
  xml.close("pstrips");
  return std::move(xml).take();
}

}  // namespace pstrips::inline formats
