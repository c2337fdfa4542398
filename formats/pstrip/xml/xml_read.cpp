#include <tinyxml2.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "formats/pstrip/container/chunks.h"
#include "formats/pstrip/numbers.h"
#include "formats/pstrip/payload/check.h"
#include "formats/pstrip/xml/xml.h"
#include "formats/pstrip/xml/xml_fault.h"
#include "formats/pstrip/xml/xml_names.h"
#include "formats/pstrip/xml/xml_scan.h"
#include "formats/pstrip/xml/xml_text.h"

namespace pstrips::inline formats {
namespace {

using tinyxml2::XMLElement;
using tinyxml2::XMLNode;

/// "/pstrips/packet[3]/vsplit[17]". Only for errors: it counts siblings.
std::string path_of(const XMLElement& element) {
  const XMLNode* parent = element.Parent();
  const XMLElement* above = parent == nullptr ? nullptr : parent->ToElement();
  if (above == nullptr) return std::string("/") + element.Name();
  std::size_t same = 0;
  for (auto* e = element.PreviousSiblingElement(element.Name()); e != nullptr;
       e = e->PreviousSiblingElement(element.Name()))
    ++same;
  return path_of(*above) + "/" + element.Name() + "[" + std::to_string(same) + "]";
}

/// What all parts of the reader share: limits and the first error, which sticks.
class Context {
 public:
  Context(ByteView document, const Limits& limits) : document_(document), limits_(limits) {}

  /// fault  xml_schema when only the shape of the document is wrong
  void fail(const XMLElement& at, Fault fault, std::string_view message,
            std::string_view attribute = {}) {
    if (error_) return;
    const auto line = static_cast<std::uint64_t>(at.GetLineNum());
    std::string path = "line " + std::to_string(line) + ", " + path_of(at);
    if (!attribute.empty()) path.append("/@").append(attribute);
    if (fault == Fault::xml_schema) fault = schema_fault_;
    error_ = Error{code_of(fault), std::string(message), offset_of_line(document_, line),
                   std::move(path), fault};
  }
  bool ok() const { return !error_; }
  const std::optional<Error>& error() const { return error_; }
  const Limits& limits() const { return limits_; }

  /// An element or attribute that no version 1.0 file has.
  void fail_unknown(const XMLElement& at, const char* message) {
    fail(at, newer_version ? Fault::xml_unsupported : Fault::xml_schema, message);
  }
  /// The shape of a vsplit is a demand of its own. [spec/xml.md X-013]
  void set_in_vsplit(bool inside) {
    schema_fault_ = inside ? Fault::xml_vsplit_form : Fault::xml_schema;
  }
  bool newer_version = false;

 private:
  ByteView document_;
  const Limits& limits_;
  Fault schema_fault_ = Fault::xml_schema;
  std::optional<Error> error_;
};

/// Takes the children of an element one after the other, in the order that the format fixes.
class Children {
 public:
  Children(Context& in, const XMLElement& parent) : in_(in), parent_(parent) {
    next_ = element_from(parent.FirstChild());
  }

  /// The next child when it has that name, else null.
  const XMLElement* take_if(std::string_view name) {
    if (!in_.ok() || next_ == nullptr || next_->Name() != name) return nullptr;
    const XMLElement* taken = next_;
    next_ = element_from(taken->NextSibling());
    return taken;
  }
  const XMLElement* take(std::string_view name) {
    const XMLElement* taken = take_if(name);
    if (taken == nullptr)
      in_.fail(next_ ? *next_ : parent_, Fault::xml_schema,
               "required element is missing before or in here");
    return taken;
  }
  void finish() {
    if (next_ != nullptr) in_.fail_unknown(*next_, "element is unknown or out of place");
  }

 private:
  const XMLElement* element_from(const XMLNode* node) {
    for (; node != nullptr; node = node->NextSibling()) {
      if (const XMLElement* element = node->ToElement()) return element;
      if (node->ToText() != nullptr)
        in_.fail(parent_, Fault::xml_schema, "text where only elements may be");
    }
    return nullptr;
  }
  Context& in_;
  const XMLElement& parent_;
  const XMLElement* next_;
};

/// The attributes of an element; `finish` refuses those that nobody asked for.
class Attributes {
 public:
  Attributes(Context& in, const XMLElement& element) : in_(in), element_(element) {}

  bool has(const char* name) const { return element_.FindAttribute(name) != nullptr; }

  std::string_view raw(const char* name) {
    const tinyxml2::XMLAttribute* found = element_.FindAttribute(name);
    if (found == nullptr) {
      in_.fail(element_, Fault::xml_schema, "required attribute is missing", name);
      return {};
    }
    ++taken_;
    return found->Value();
  }
  std::string string(const char* name) {
    const std::string_view text = raw(name);
    if (text.size() > in_.limits().string_bytes)
      in_.fail(element_, Fault::over_limit, "string longer than the limit", name);
    std::optional<std::string> value = in_.ok() ? unescape(text) : std::nullopt;
    if (!value) in_.fail(element_, Fault::xml_backslash, "backslash that escapes nothing", name);
    return value.value_or("");
  }
  template <class T>
  T number(const char* name) {
    T value{};
    const std::string_view text = raw(name);
    if (in_.ok() && !parse_number(text, value))
      in_.fail(element_, Fault::xml_number, "not a number in range", name);
    return value;
  }
  Index index(const char* name) { return number<Index>(name); }
  Index index_or_none(const char* name) { return has(name) ? index(name) : kNone; }
  bool flag(const char* name) {
    const std::string_view text = raw(name);
    if (in_.ok() && text != "true" && text != "false" && text != "1" && text != "0")
      in_.fail(element_, Fault::xml_schema, "neither true nor false", name);
    return text == "true" || text == "1";
  }
  bool flag_or(const char* name, bool value) { return has(name) ? flag(name) : value; }
  template <class E>
  E choice(const char* name, std::span<const std::string_view> words) {
    const std::string_view text = raw(name);
    const auto found = std::ranges::find(words, text);
    if (in_.ok() && found == words.end())
      in_.fail(element_, Fault::value_undefined, "word is none of those defined", name);
    return static_cast<E>(found == words.end() ? 0 : found - words.begin());
  }
  ComponentType component_type(const char* name) {
    const std::string_view text = raw(name);
    for (int i = 0; i <= static_cast<int>(ComponentType::f64); ++i)
      if (name_of(static_cast<ComponentType>(i)) == text) return static_cast<ComponentType>(i);
    in_.fail(element_, Fault::type_undefined, "word is none of those defined", name);
    return ComponentType::f32;
  }
  template <std::size_t N>
  void reals(const char* name, std::array<double, N>& values) {
    Tokens tokens(raw(name));
    for (double& value : values)
      if (in_.ok() && !parse_number(tokens.next(), value))
        in_.fail(element_, Fault::xml_number, "number is missing, malformed or out of range", name);
    if (in_.ok() && !tokens.at_end())
      in_.fail(element_, Fault::xml_list_length, "more numbers than announced", name);
  }
  /// Appends all indices of the list; returns how many.
  Index indices(const char* name, std::vector<Index>& list) {
    const std::size_t before = list.size();
    for (Tokens tokens(raw(name)); in_.ok() && !tokens.at_end();) {
      Index value = 0;
      if (!parse_number(tokens.next(), value))
        in_.fail(element_, Fault::xml_number, "not a number in range", name);
      list.push_back(value);
    }
    return static_cast<Index>(list.size() - before);
  }

  void finish() {
    std::size_t present = 0;
    for (auto* a = element_.FirstAttribute(); a != nullptr; a = a->Next()) ++present;
    if (present != taken_) in_.fail_unknown(element_, "attribute is unknown or stands twice");
  }

 private:
  Context& in_;
  const XMLElement& element_;
  std::size_t taken_ = 0;
};

/// The text of an element that holds nothing else; comments around it do not matter.
std::string_view text_of(Context& in, const XMLElement& element) {
  std::string_view text;
  bool seen = false;
  for (const XMLNode* node = element.FirstChild(); node != nullptr; node = node->NextSibling()) {
    if (node->ToComment() != nullptr) continue;
    if (node->ToText() == nullptr || seen) {
      in.fail(element, Fault::xml_schema, "more than one run of text");
      return {};
    }
    text = node->Value();
    seen = true;
  }
  return text;
}

/// Appends the components of one element of the format.
void read_element(Context& in, const XMLElement& at, Tokens& tokens, const Attribute& format,
                  Bytes& out, const char* name) {
  const std::size_t before = out.size(), size = size_of(format.type);
  out.resize(before + format.element_bytes());
  for (std::size_t c = 0; c < format.count; ++c)
    if (!parse_component(tokens.next(), format.type, out.data() + before + c * size))
      return in.fail(at, Fault::xml_number, "number is missing, malformed or out of range", name);
}

void read_element_attribute(Context& in, const XMLElement& at, Attributes& attributes,
                            const char* name, const Attribute& format, Bytes& out) {
  Tokens tokens(attributes.raw(name));
  if (!in.ok()) return;
  read_element(in, at, tokens, format, out, name);
  if (!tokens.at_end()) in.fail(at, Fault::xml_list_length, "more numbers than announced", name);
}

/// Appends `elements` elements from the text of an element.
void read_elements(Context& in, const XMLElement* at, Attribute& attribute, std::size_t elements) {
  if (at == nullptr) return;
  Attributes(in, *at).finish();
  Tokens tokens(text_of(in, *at));
  if (elements > tokens.max_left() / attribute.count)
    return in.fail(*at, Fault::xml_list_length, "fewer numbers than announced");
  attribute.data.reserve(elements * attribute.element_bytes());
  for (std::size_t i = 0; i < elements && in.ok(); ++i)
    read_element(in, *at, tokens, attribute, attribute.data, "");
  if (in.ok() && !tokens.at_end())
    in.fail(*at, Fault::xml_list_length, "more numbers than announced");
}

template <class T>
void read_list(Context& in, const XMLElement* at, std::vector<T>& list) {
  if (at == nullptr) return;
  Attributes(in, *at).finish();
  for (Tokens tokens(text_of(in, *at)); in.ok() && !tokens.at_end();) {
    std::uint32_t value = 0;
    if (!parse_number(tokens.next(), value) || value > std::numeric_limits<T>::max())
      in.fail(*at, Fault::xml_number, "not a number in range");
    list.push_back(static_cast<T>(value));
  }
}

void read_map(Context& in, const XMLElement* at, std::vector<Index>& map) {
  if (at == nullptr) return;
  Attributes(in, *at).finish();
  for (Tokens tokens(text_of(in, *at)); in.ok() && !tokens.at_end();) {
    const std::string_view token = tokens.next();
    const auto marker = std::ranges::find(kMarkerNames, token);
    Index entry = kSameAsMinus2 + static_cast<Index>(marker - kMarkerNames.begin());
    if (marker == kMarkerNames.end() && (!parse_number(token, entry) || !is_wedge(entry)))
      in.fail(*at, Fault::xml_number, "index-map entry is neither a wedge nor a marker");
    map.push_back(entry);
  }
}

Bytes read_base64(Context& in, const XMLElement& at) {
  std::optional<Bytes> bytes = parse_base64(text_of(in, at));
  if (!bytes) in.fail(at, Fault::xml_base64, "malformed base64");
  return std::move(bytes).value_or(Bytes{});
}

Attribute read_format(Context& in, const XMLElement& at) {
  Attributes attributes(in, at);
  Attribute out;
  out.semantic = attributes.string("semantic");
  out.type = attributes.component_type("type");
  const Index count = attributes.index("count");
  if (in.ok() && (count == 0 || count > 255))
    in.fail(at, Fault::no_components, "not between 1 and 255", "count");
  out.count = static_cast<std::uint8_t>(std::clamp<Index>(count, 1, 255));
  out.normalized = attributes.flag_or("normalized", false);
  attributes.finish();
  Children(in, at).finish();
  return out;
}

/// Builds the model from the DOM, element after element in the order of the format.
class Reader {
 public:
  explicit Reader(Context& in) : in_(in) {}

  ProgressiveStrips read(const XMLElement& root) {
    read_root(root);
    Children children(in_, root);
    if (const XMLElement* at = children.take_if("scene")) read_scene(*at);
    if (const XMLElement* at = children.take_if("materials")) read_materials(*at);
    while (const XMLElement* at = children.take_if("mesh")) read_mesh(*at);
    while (const XMLElement* at = children.take_if("base")) read_base(*at);
    if (in_.ok() && out_.bases.size() != out_.meshes.size())
      in_.fail(root, Fault::xml_bases, "not one base for each mesh");
    while (const XMLElement* at = children.take_if("packet")) read_packet(*at);
    for (;;) {
      if (const XMLElement* at = children.take_if("faces"))
        read_faces(*at);
      else if (const XMLElement* order = children.take_if("order"))
        read_order(*order);
      else if (const XMLElement* digest = children.take_if("digest"))
        read_digest(*digest);
      else
        break;
    }
    while (const XMLElement* at = children.take_if("image_data")) read_image_data(*at);
    while (const XMLElement* at = children.take_if("foreign")) read_foreign(*at);
    while (const XMLElement* at = children.take_if("chunk")) read_unknown(*at);
    if (in_.ok()) children.finish();
    return std::move(out_);
  }

 private:
  void read_root(const XMLElement& root) {
    if (std::string_view(root.Name()) != "pstrips")
      return in_.fail(root, Fault::xml_schema, "root element is not pstrips");
    Attributes attributes(in_, root);
    const std::string_view version = attributes.raw("version");
    const std::size_t dot = version.find('.');
    Index major = 0, minor = 0;
    if (in_.ok() &&
        (dot == std::string_view::npos || !parse_number(version.substr(0, dot), major) ||
         !parse_number(version.substr(dot + 1), minor)))
      in_.fail(root, Fault::xml_schema, "malformed version", "version");
    if (in_.ok() && major != kXmlVersionMajor)
      in_.fail(root, Fault::version_unknown, "version that this build does not know", "version");
    in_.newer_version = minor > 0;
    if (const auto profile = profile_named(attributes.raw("profile")))
      out_.profile = *profile;
    else if (in_.ok())
      in_.fail(root, Fault::profile_unknown, "profile that this build does not know", "profile");
    out_.complete = attributes.flag_or("complete", true);
    attributes.finish();
  }

  void read_scene(const XMLElement& at) {
    Attributes attributes(in_, at);
    out_.generator = attributes.string("generator");
    attributes.finish();
    Children children(in_, at);
    while (const XMLElement* node = children.take_if("node")) read_node(*node);
    children.finish();
  }

  void read_node(const XMLElement& at) {
    Attributes attributes(in_, at);
    Node& node = added(out_.scene.nodes, at);
    node.name = attributes.string("name");
    node.parent = attributes.index_or_none("parent");
    attributes.reals("matrix", node.matrix);
    attributes.indices("meshes", node.meshes);
    finish_empty(attributes, at);
  }

  void read_materials(const XMLElement& at) {
    Attributes(in_, at).finish();
    Children children(in_, at);
    while (const XMLElement* material = children.take_if("material")) read_material(*material);
    while (const XMLElement* image = children.take_if("image")) read_image(*image);
    children.finish();
  }

  void read_material(const XMLElement& at) {
    Attributes attributes(in_, at);
    Material& m = added(out_.scene.materials, at);
    m.name = attributes.string("name");
    attributes.reals("base_color", m.base_color);
    attributes.reals("emissive", m.emissive);
    m.metallic = attributes.number<double>("metallic");
    m.roughness = attributes.number<double>("roughness");
    m.base_color_image = attributes.index_or_none("base_color_image");
    m.double_sided = attributes.flag("double_sided");
    finish_empty(attributes, at);
  }

  void read_image(const XMLElement& at) {
    Attributes attributes(in_, at);
    Image& image = added(out_.scene.images, at);
    image.name = attributes.string("name");
    image.uri = attributes.string("uri");
    image.mime_type = attributes.string("mime_type");
    finish_empty(attributes, at);
  }

  void read_mesh(const XMLElement& at) {
    Attributes attributes(in_, at);
    ProgressiveMesh& mesh = added(out_.meshes, at);
    mesh.name = attributes.string("name");
    mesh.encoding = attributes.choice<MapEncoding>("encoding", kEncodingNames);
    mesh.placement = attributes.choice<Placement>("placement", kPlacementNames);
    mesh.single_wedges = attributes.flag("single_wedges");
    mesh.vertices = attributes.index("vertices");
    mesh.wedges = attributes.index("wedges");
    mesh.triangles = attributes.index("triangles");
    mesh.strips = attributes.index("strips");
    mesh.base_vertices = attributes.index("base_vertices");
    mesh.base_wedges = attributes.index("base_wedges");
    attributes.finish();
    Children children(in_, at);
    if (const XMLElement* e = children.take("position")) mesh.position = read_format(in_, *e);
    while (const XMLElement* e = children.take_if("wedge_attribute"))
      mesh.wedge_attributes.push_back(read_format(in_, *e));
    while (const XMLElement* e = children.take_if("face_attribute"))
      mesh.face_attribute_formats.push_back(read_format(in_, *e));
    while (const XMLElement* e = children.take_if("group")) read_group(*e, mesh);
    children.finish();
    vertices_ += mesh.vertices;
    wedges_ += mesh.wedges;
    for (const Index entries : mesh.group_entries) corners_ += entries;
    check_totals(at);
  }

  void read_group(const XMLElement& at, ProgressiveMesh& mesh) {
    Attributes attributes(in_, at);
    Group& group = added(mesh.groups, at);
    group.name = attributes.string("name");
    group.material = attributes.index_or_none("material");
    group.kind = attributes.choice<FaceKind>("kind", kFaceKindNames);
    mesh.group_entries.push_back(attributes.index("map_entries"));
    finish_empty(attributes, at);
  }

  void read_level(Attributes& attributes, Packet& level) {
    level.mesh = attributes.index("mesh");
    level.vertices = attributes.index("vertices");
    level.triangles = attributes.index("triangles");
    level.strips = attributes.index("strips");
    level.error = attributes.number<float>("error");
    level.one_sided_error = attributes.number<float>("one_sided_error");
  }

  void read_base(const XMLElement& at) {
    Attributes attributes(in_, at);
    BaseLevel& base = added(out_.bases, at);
    read_level(attributes, base);
    attributes.finish();
    if (in_.ok() && (base.mesh + 1 != out_.bases.size() || base.mesh >= out_.meshes.size()))
      in_.fail(at, Fault::xml_bases, "bases are not in the order of the meshes", "mesh");
    if (!in_.ok()) return;
    ProgressiveMesh& mesh = out_.meshes[base.mesh];
    Children children(in_, at);
    read_elements(in_, children.take("positions"), mesh.position, mesh.base_vertices);
    if (!mesh.single_wedges) read_list(in_, children.take("wedge_vertex"), mesh.base_wedge_vertex);
    for (Attribute& a : mesh.wedge_attributes)
      read_elements(in_, children.take("values"), a, mesh.base_wedges);
    read_map(in_, children.take("map"), mesh.base_map);
    children.finish();
  }

  void read_packet(const XMLElement& at) {
    Attributes attributes(in_, at);
    Packet& packet = out_.packets.emplace_back();
    packet.first_vsplit = attributes.index("first_vsplit");
    packet.vsplits = attributes.index("vsplits");
    read_level(attributes, packet);
    attributes.finish();
    if (in_.ok() && packet.mesh >= out_.meshes.size())
      in_.fail(at, Fault::packet_mesh, "packet names a mesh past the end", "mesh");
    if (!in_.ok()) return;
    ProgressiveMesh& mesh = out_.meshes[packet.mesh];
    const std::size_t before = mesh.vsplits.size();
    Children children(in_, at);
    while (const XMLElement* e = children.take_if("vsplit")) {
      in_.set_in_vsplit(true);
      read_vsplit(*e, mesh);
      in_.set_in_vsplit(false);
    }
    children.finish();
    if (in_.ok() && mesh.vsplits.size() - before != packet.vsplits)
      in_.fail(at, Fault::xml_packet_vsplits, "not as many vsplits as announced", "vsplits");
  }

  void read_vsplit(const XMLElement& at, ProgressiveMesh& mesh) {
    Attributes attributes(in_, at);
    Vsplit v{};
    v.parent = attributes.index("parent");
    read_element_attribute(in_, at, attributes, "position", mesh.position, mesh.position.data);
    if (mesh.placement == Placement::optimal)
      read_element_attribute(in_, at, attributes, "parent_position", mesh.position,
                             mesh.parent_position);
    if (mesh.single_wedges) {
      read_wedge(at, attributes, mesh, v);
      finish_empty(attributes, at);
    } else {
      if (attributes.has("reassigned"))
        v.reassigned = attributes.indices("reassigned", mesh.reassigned);
      attributes.finish();
      Children children(in_, at);
      while (const XMLElement* e = children.take_if("wedge")) {
        Attributes wedge(in_, *e);
        read_wedge(*e, wedge, mesh, v);
        finish_empty(wedge, *e);
      }
      children.finish();
    }
    mesh.vsplits.push_back(v);
  }

  void read_wedge(const XMLElement& at, Attributes& attributes, ProgressiveMesh& mesh, Vsplit& v) {
    if (!mesh.wedge_attributes.empty()) {
      Tokens tokens(attributes.raw("values"));
      for (Attribute& a : mesh.wedge_attributes)
        if (in_.ok()) read_element(in_, at, tokens, a, a.data, "values");
      if (in_.ok() && !tokens.at_end())
        in_.fail(at, Fault::xml_list_length, "more numbers than announced", "values");
    }
    const Index map_offsets = attributes.indices("map_offsets", mesh.map_offsets);
    mesh.wedge_offset_counts.push_back(map_offsets);
    v.map_offsets += map_offsets;
    ++v.wedges;
  }

  /// The mesh that a tail element names; null with an error, or when that part was there already.
  ProgressiveMesh* tail_mesh(const XMLElement& at, Attributes& attributes, Fault past_end,
                             bool (*has)(const ProgressiveMesh&)) {
    const Index mesh = attributes.index("mesh");
    if (in_.ok() && mesh >= out_.meshes.size())
      in_.fail(at, past_end, "names a mesh past the end", "mesh");
    if (in_.ok() && has(out_.meshes[mesh]))
      in_.fail(at, Fault::xml_twice, "stands twice for a mesh", "mesh");
    return in_.ok() ? &out_.meshes[mesh] : nullptr;
  }

  void read_faces(const XMLElement& at) {
    Attributes attributes(in_, at);
    ProgressiveMesh* mesh = tail_mesh(at, attributes, Fault::faces_mesh,
                                      [](const ProgressiveMesh& m) { return !m.faces.empty(); });
    attributes.finish();
    if (mesh == nullptr) return;
    Children children(in_, at);
    FaceTable& faces = mesh->faces;
    while (const XMLElement* e = children.take_if("face")) read_face(*e, faces);
    corners_ += faces.corners.size();
    check_totals(at);
    if (in_.ok() && faces.replaced.size() > mesh->triangles)
      in_.fail(at, Fault::xml_list_length, "more triangles replaced than there are");
    for (const Attribute& format : mesh->face_attribute_formats) {
      if (!in_.ok()) return;
      Attribute& a = faces.attributes.emplace_back(format);
      read_elements(in_, children.take("values"), a, face_count(*mesh));
    }
    children.finish();
    if (in_.ok() && faces.empty()) in_.fail(at, Fault::xml_twice, "element without content");
  }

  void read_face(const XMLElement& at, FaceTable& faces) {
    if (faces.first.empty()) {
      faces.first.push_back(0);
      faces.replaced_first.push_back(0);
    }
    Attributes attributes(in_, at);
    faces.group.push_back(attributes.index("group"));
    attributes.indices("corners", faces.corners);
    attributes.indices("replaced", faces.replaced);
    faces.first.push_back(static_cast<Index>(faces.corners.size()));
    faces.replaced_first.push_back(static_cast<Index>(faces.replaced.size()));
    finish_empty(attributes, at);
  }

  void read_order(const XMLElement& at) {
    Attributes attributes(in_, at);
    ProgressiveMesh* mesh =
        tail_mesh(at, attributes, Fault::order_mesh,
                  [](const ProgressiveMesh& m) { return m.order != OriginalOrder{}; });
    attributes.finish();
    if (mesh == nullptr) return;
    Children children(in_, at);
    read_list(in_, children.take("vertex"), mesh->order.vertex);
    if (!mesh->single_wedges) read_list(in_, children.take("wedge"), mesh->order.wedge);
    read_list(in_, children.take("face"), mesh->order.face);
    read_list(in_, children.take("rotation"), mesh->order.rotation);
    children.finish();
    if (in_.ok() && mesh->order == OriginalOrder{})
      in_.fail(at, Fault::xml_twice, "element without content");
  }

  void read_digest(const XMLElement& at) {
    Attributes attributes(in_, at);
    ProgressiveMesh* mesh = tail_mesh(at, attributes, Fault::digest_mesh,
                                      [](const ProgressiveMesh& m) { return !m.digest.empty(); });
    if (attributes.raw("algorithm") != kDigestAlgorithm && in_.ok())
      in_.fail(at, Fault::digest_unknown, "algorithm that this build does not know", "algorithm");
    attributes.finish();
    Tokens tokens(text_of(in_, at));
    const std::string_view digits = tokens.next();
    constexpr std::size_t kDigestBytes = 32;
    if (in_.ok() && (digits.size() != 2 * kDigestBytes || !tokens.at_end()))
      in_.fail(at, Fault::xml_schema, "digest is not 64 hexadecimal digits");
    for (std::size_t i = 0; i < kDigestBytes && in_.ok(); ++i) {
      std::uint8_t value = 0;
      const char* begin = digits.data() + 2 * i;
      if (std::from_chars(begin, begin + 2, value, 16).ptr != begin + 2)
        in_.fail(at, Fault::xml_schema, "digest is not 64 hexadecimal digits");
      mesh->digest.push_back(static_cast<std::byte>(value));
    }
  }

  void read_image_data(const XMLElement& at) {
    Attributes attributes(in_, at);
    const Index image = attributes.index("image");
    attributes.finish();
    if (in_.ok() && image >= out_.scene.images.size())
      in_.fail(at, Fault::image_data, "names an image past the end", "image");
    if (in_.ok() && !out_.scene.images[image].data.empty())
      in_.fail(at, Fault::xml_twice, "stands twice for an image", "image");
    Bytes data = read_base64(in_, at);
    if (in_.ok() && data.empty()) in_.fail(at, Fault::xml_twice, "element without content");
    if (in_.ok()) out_.scene.images[image].data = std::move(data);
  }

  void read_foreign(const XMLElement& at) {
    constexpr std::string_view kForms[] = {"text", "base64"};
    Attributes attributes(in_, at);
    Foreign& foreign = added(out_.scene.foreign, at);
    foreign.key = attributes.string("key");
    const bool base64 = attributes.choice<std::uint8_t>("form", kForms) == 1;
    attributes.finish();
    if (base64) {
      foreign.data = read_base64(in_, at);
    } else {
      const ByteView text = as_bytes(text_of(in_, at));
      foreign.data.assign(text.begin(), text.end());
    }
  }

  void read_unknown(const XMLElement& at) {
    Attributes attributes(in_, at);
    UnknownChunk& chunk = added(out_.unknown, at);
    const std::string_view type = attributes.raw("type");
    attributes.finish();
    if (type.size() == chunk.type.size()) std::ranges::copy(type, chunk.type.begin());
    if (in_.ok() && (type.size() != chunk.type.size() || !is_chunk_type(chunk.type)))
      in_.fail(at, Fault::xml_chunk_type, "not a chunk type", "type");
    if (in_.ok() && is_known(chunk.type))
      in_.fail(at, Fault::xml_chunk_type, "chunk type that has elements of its own", "type");
    if (in_.ok() && is_critical(chunk.type))
      in_.fail(at, Fault::critical_chunk_unknown, "critical chunk that this build does not know",
               "type");
    chunk.payload = read_base64(in_, at);
  }

  /// A new last item of a list that Limits::meshes bounds.
  template <class T>
  T& added(std::vector<T>& list, const XMLElement& at) {
    if (list.size() >= in_.limits().meshes)
      in_.fail(at, Fault::over_limit, "more of these than the limit");
    return list.emplace_back();
  }

  void finish_empty(Attributes& attributes, const XMLElement& at) {
    attributes.finish();
    Children(in_, at).finish();
  }

  void check_totals(const XMLElement& at) {
    const Limits& limits = in_.limits();
    const auto check = [&](std::uint64_t figure, const char* what, std::uint64_t limit) {
      if (figure > limit) in_.fail(at, Fault::over_limit, over_limit_message(figure, what, limit));
    };
    check(vertices_, "vertices", limits.vertices);
    check(wedges_, "wedges", limits.wedges);
    check(corners_, "corners and map entries", limits.corners);
  }

  Context& in_;
  ProgressiveStrips out_;
  std::uint64_t vertices_ = 0, wedges_ = 0, corners_ = 0;
};

/// Notes lines by model paths.
class Locator {
 public:
  XmlLocations locate(const XMLElement& root) {
    list(root.FirstChildElement("scene"), "node", "/scene/nodes");
    list(root.FirstChildElement("materials"), "material", "/scene/materials");
    list(root.FirstChildElement("materials"), "image", "/scene/images");
    for (auto* e = first(&root, "mesh"); e != nullptr; e = e->NextSiblingElement("mesh")) mesh(*e);
    for (auto* e = first(&root, "base"); e != nullptr; e = e->NextSiblingElement("base")) base(*e);
    list(&root, "packet", "/packets");
    for (auto* e = first(&root, "packet"); e != nullptr; e = e->NextSiblingElement("packet")) {
      const std::size_t mesh = e->UnsignedAttribute("mesh");
      if (mesh >= out_.vsplits.size()) continue;
      for (auto* v = first(e, "vsplit"); v != nullptr; v = v->NextSiblingElement("vsplit"))
        out_.vsplits[mesh].push_back(static_cast<std::uint32_t>(v->GetLineNum()));
    }
    tail(root, "faces", {"face"});
    tail(root, "order", {"vertex", "wedge", "face", "rotation"});
    tail(root, "digest", {});
    for (auto* e = first(&root, "image_data"); e != nullptr;
         e = e->NextSiblingElement("image_data"))
      note("/scene/images/" + std::to_string(e->UnsignedAttribute("image")) + "/data", *e);
    list(&root, "foreign", "/scene/foreign");
    list(&root, "chunk", "/unknown");
    return std::move(out_);
  }

 private:
  static const XMLElement* first(const XMLElement* parent, const char* name) {
    return parent == nullptr ? nullptr : parent->FirstChildElement(name);
  }
  void note(std::string path, const XMLElement& at) {
    out_.elements.emplace(std::move(path), static_cast<std::uint32_t>(at.GetLineNum()));
  }
  void list(const XMLElement* parent, const char* name, const std::string& path) {
    std::size_t i = 0;
    for (auto* e = first(parent, name); e != nullptr; e = e->NextSiblingElement(name))
      note(path + "/" + std::to_string(i++), *e);
  }
  void mesh(const XMLElement& at) {
    const std::string path = "/meshes/" + std::to_string(out_.vsplits.size());
    out_.vsplits.emplace_back();
    note(path, at);
    if (auto* e = first(&at, "position")) note(path + "/position", *e);
    list(&at, "wedge_attribute", path + "/wedge_attributes");
    list(&at, "face_attribute", path + "/face_attributes");
    list(&at, "group", path + "/groups");
  }
  void base(const XMLElement& at) {
    const std::string path = "/meshes/" + std::to_string(bases_);
    note("/bases/" + std::to_string(bases_++), at);
    if (auto* e = first(&at, "wedge_vertex")) note(path + "/base_wedge_vertex", *e);
    if (auto* e = first(&at, "map")) note(path + "/base_map", *e);
  }
  void tail(const XMLElement& root, const char* name, std::initializer_list<const char*> lists) {
    for (auto* e = first(&root, name); e != nullptr; e = e->NextSiblingElement(name)) {
      const std::string path =
          "/meshes/" + std::to_string(e->UnsignedAttribute("mesh")) + "/" + name;
      note(path, *e);
      const bool one_each = lists.size() > 1;
      for (const char* item : lists) {
        if (!one_each)
          list(e, item, path);
        else if (auto* child = first(e, item))
          note(path + "/" + item, *child);
      }
    }
  }

  XmlLocations out_;
  std::size_t bases_ = 0;
};

/// What the DOM and the model may take at most, before either is built.
std::uint64_t memory_for(const XmlExtent& extent, std::uint64_t document_bytes) {
  // The DOM keeps a copy of the text. No token is shorter than two characters, with its space, and
  // the widest component they can stand for has eight bytes.
  return extent.elements * sizeof(XMLElement) + extent.attributes * sizeof(tinyxml2::XMLAttribute) +
         extent.texts * sizeof(tinyxml2::XMLText) + document_bytes * 5;
}

}  // namespace

std::uint32_t XmlLocations::line_of(std::string_view path) const {
  constexpr std::string_view kMeshes = "/meshes/", kVsplits = "/vsplits/";
  const std::size_t at = path.find(kVsplits);
  if (path.starts_with(kMeshes) && at != std::string_view::npos) {
    Index mesh = 0, vsplit = 0;
    const std::string_view number = path.substr(at + kVsplits.size());
    if (parse_number(path.substr(kMeshes.size(), at - kMeshes.size()), mesh) &&
        parse_number(number.substr(0, number.find('/')), vsplit) && mesh < vsplits.size() &&
        vsplit < vsplits[mesh].size())
      return vsplits[mesh][vsplit];
  }
  while (!path.empty()) {
    if (const auto found = elements.find(path); found != elements.end()) return found->second;
    path = path.substr(0, path.rfind('/'));
  }
  return 1;
}

namespace {

Result<ProgressiveStrips> read(ByteView document, const Limits& limits, bool checked,
                               XmlLocations* locations) {
  const Result<XmlExtent> extent = scan_xml(document, limits);
  if (!extent) return tl::unexpected<Error>(extent.error());
  if (memory_for(*extent, document.size()) > limits.memory_bytes)
    return tl::unexpected(Error{.code = ErrorCode::over_limit,
                                .message = "document needs more memory than the limit",
                                .fault = Fault::over_limit});
  tinyxml2::XMLDocument dom;
  const std::string_view text = as_text(document);
  if (dom.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    const auto line = static_cast<std::uint64_t>(dom.ErrorLineNum());
    const bool deep = dom.ErrorID() == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED;
    const Fault fault = deep ? Fault::over_limit : Fault::xml_malformed;
    return tl::unexpected(
        Error{code_of(fault), deep ? "elements nest deeper than the limit" : "malformed XML",
              offset_of_line(document, line), "line " + std::to_string(line), fault});
  }
  const XMLElement& root = *dom.RootElement();
  Context in(document, limits);
  ProgressiveStrips strips = Reader(in).read(root);
  if (in.error()) return tl::unexpected<Error>(*in.error());
  if (Result<void> ok = checked ? check(strips) : Result<void>{}; !ok) {
    Error error = ok.error();
    const std::uint32_t line = Locator().locate(root).line_of(error.path);
    error.path = "line " + std::to_string(line) + ", " + error.path;
    error.offset = offset_of_line(document, line);
    return tl::unexpected<Error>(std::move(error));
  }
  if (locations != nullptr) *locations = Locator().locate(root);
  return strips;
}

}  // namespace

Result<ProgressiveStrips> read_xml(ByteView document, const Limits& limits,
                                   XmlLocations* locations) {
  return read(document, limits, true, locations);
}

Result<ProgressiveStrips> read_xml_unchecked(ByteView document, const Limits& limits,
                                             XmlLocations* locations) {
  return read(document, limits, false, locations);
}

bool looks_like_xml(ByteView start) {
  std::string_view text = as_text(start);
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  return Tokens(text).next().starts_with('<');
}

}  // namespace pstrips::inline formats
