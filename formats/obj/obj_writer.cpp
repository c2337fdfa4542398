#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cstring>
#include <set>
#include <span>

#include "core/equal_elements.h"
#include "core/parallel.h"
#include "formats/obj/mtl.h"
#include "formats/obj/names.h"
#include "formats/obj/numbers.h"
#include "formats/obj/obj.h"
#include "formats/obj/plan.h"

namespace pstrips::inline formats {
namespace {

using obj::MeshPlan;

void append_index(std::string& out, std::uint64_t index) {
  char text[20];
  out.append(text, std::to_chars(std::begin(text), std::end(text), index).ptr);
}

/// Component c of element i of an attribute of floats.
float float_component(const Attribute& a, std::size_t i, std::size_t c) {
  float value = 0;
  std::memcpy(&value, a.element(i).data() + c * sizeof value, sizeof value);
  return value;
}

/// Component c of element i; a float prints as the float it is.
void append_component(std::string& out, const Attribute& a, std::size_t i, std::size_t c) {
  out += ' ';
  if (a.type == ComponentType::f32)
    obj::append_number(out, float_component(a, i, c));
  else
    obj::append_number(out, component(a, i, c));
}

/// For each wedge the number of its `vt` or `vn` line in the file, from 1; 0: it has none. Empty:
/// no wedge has one.
using TupleLines = std::vector<std::uint64_t>;

/// Appends lines 0 to count - 1, which line(out, i) makes, some runs of them on each thread.
template <class Line>
void append_lines(std::string& out, std::size_t count, unsigned threads, Line&& line) {
  constexpr std::size_t kLines = 4096, kRunsAtOnce = 32;
  if (count <= kLines) {
    for (std::size_t i = 0; i < count; ++i) line(out, i);
    return;
  }
  std::vector<std::string> texts(std::min(kRunsAtOnce, count / kLines + 1));
  for (std::size_t first = 0; first < count; first += kLines * kRunsAtOnce) {
    const std::size_t lines = std::min(count - first, kLines * kRunsAtOnce);
    parallel_for(threads, lines, kLines, [&](std::size_t begin, std::size_t end) {
      std::string& text = texts[begin / kLines];
      text.clear();
      for (std::size_t i = begin; i < end; ++i) line(text, first + i);
    });
    std::size_t bytes = 0;
    for (std::size_t run = 0; run * kLines < lines; ++run) bytes += texts[run].size();
    if (first == 0)  // the rest is about as long a line; pages that are not written cost nothing
      out.reserve(out.size() + bytes / lines * count + bytes / lines * count / 4);
    for (std::size_t run = 0; run * kLines < lines; ++run) out += texts[run];
  }
}

/// Writes the text of a model, one mesh after the other.
class ObjWriter {
 public:
  ObjWriter(const Model& model, std::string mtl_name, unsigned threads)
      : model_(model), threads_(threads) {
    files_.mtl_name = std::move(mtl_name);
  }

  ObjFiles write() && {
    write_foreign_lines("obj/header", "#");
    write_materials();
    write_foreign_lines("obj/mtllib", "mtllib ");
    for (std::size_t m = 0; m < model_.meshes.size(); ++m) write_mesh(m);
    write_foreign_lines("obj/notes", "# note: ");
    report_scene();
    files_.obj = bytes_of(out_);
    files_.dropped.assign(dropped_.begin(), dropped_.end());
    return std::move(files_);
  }

 private:
  static Bytes bytes_of(std::string_view text) {
    const ByteView bytes = as_bytes(text);
    return Bytes(bytes.begin(), bytes.end());
  }

  void drop(std::string_view what) { dropped_.emplace(what); }

  /// A backslash at the end would join the next line.
  void end_line() {
    if (out_.ends_with('\\')) out_ += ' ';
    out_ += '\n';
  }

  std::string_view foreign(std::string_view key) const {
    const auto& list = model_.scene.foreign;
    const auto found = std::ranges::find(list, key, &Foreign::key);
    return found == list.end() ? std::string_view() : as_text(found->data);
  }

  void write_foreign_lines(std::string_view key, std::string_view prefix) {
    std::string_view text = foreign(key);
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      const std::string_view line = text.substr(0, end);
      text.remove_prefix(std::min(end + 1, text.size()));
      if (prefix != "#" || !line.starts_with('#')) out_ += prefix;
      out_ += line;
      end_line();
    }
  }

  // Materials.

  void write_materials() {
    const Scene& scene = model_.scene;
    if (keeps_original_mtl()) {
      for (const Material& material : scene.materials) material_names_.push_back(material.name);
      files_.mtl = bytes_of(foreign("obj/mtl"));
    } else {
      make_material_names();
      files_.mtl = bytes_of(obj::write_mtl(scene, material_names_, dropped_));
      for (const Image& image : scene.images)
        if (image.uri.empty()) drop("embedded images");
    }
    if (files_.mtl_name.empty() && !files_.mtl.empty()) {
      drop("materials");
      files_.mtl.clear();
    }
    if (files_.mtl.empty()) files_.mtl_name.clear();
    if (files_.mtl.empty()) return;
    out_ += "mtllib " + files_.mtl_name;
    end_line();
  }

  /// The original text still makes these materials, followed by some that are only names.
  bool keeps_original_mtl() const {
    Scene original;
    if (!obj::read_mtl(foreign("obj/mtl"), original, Limits{})) return false;
    const auto& materials = model_.scene.materials;
    const auto defined = original.materials.size();
    if (materials.size() < defined || !same_uris(model_.scene.images, original.images))
      return false;
    std::set<std::string_view> seen;
    std::vector<bool> is_first(materials.size());
    for (std::size_t m = 0; m < materials.size(); ++m) {
      const Material& material = materials[m];
      const Material expected =
          m < defined ? original.materials[m] : obj::named_material(obj::clean_name(material.name));
      if (material != expected) return false;
      is_first[m] = !material.name.empty() && seen.insert(material.name).second;
    }
    for (const Mesh& mesh : model_.meshes)
      for (const Group& group : mesh.groups)
        if (group.material != kNone && !is_first[group.material]) return false;
    return true;
  }

  /// Their bytes may have been read meanwhile.
  static bool same_uris(const std::vector<Image>& a, const std::vector<Image>& b) {
    return std::ranges::equal(a, b, {}, &Image::uri, &Image::uri);
  }

  void make_material_names() {
    std::set<std::string> taken;
    for (const Material& material : model_.scene.materials) {
      const std::string clean = obj::clean_name(material.name);
      const std::string base = clean.empty() ? "material" : clean;
      std::string name = base;
      for (std::size_t n = 2; !taken.insert(name).second; ++n)
        name = base + '_' + std::to_string(n);
      material_names_.push_back(std::move(name));
    }
  }

  void report_scene() {
    for (const Node& node : model_.scene.nodes)
      if (!node.meshes.empty() && node.matrix != Node{}.matrix) drop("node transforms");
    std::vector<int> uses(model_.meshes.size());
    for (const Node& node : model_.scene.nodes)
      for (const Index mesh : node.meshes)
        if (mesh < uses.size() && ++uses[mesh] > 1) drop("node instances");
  }

  // Meshes.

  void write_mesh(std::size_t m) {
    const Mesh& mesh = model_.meshes[m];
    assert(find_inconsistency(mesh).empty());
    std::string name = obj::clean_name(mesh.name);
    if (name.empty() && model_.meshes.size() > 1) name = "mesh_" + std::to_string(m + 1);
    if (m > 0 || name != object_) write_statement("o", name);
    object_ = name;
    instance_ = 1;
    MeshPlan plan = obj::plan_mesh(mesh, model_.meshes.size() == 1, dropped_);
    set_turns(plan);
    append_lines(out_, mesh.vertex_count(), threads_, [&](std::string& out, std::size_t v) {
      append_vertex(out, mesh, plan, static_cast<Index>(v));
    });
    const TupleLines texcoords =
        write_tuples(mesh, plan, plan.texcoord, kHasTexcoord, texcoord_count_);
    const TupleLines normals = write_tuples(mesh, plan, plan.normal, kHasNormal, normal_count_);
    write_faces(mesh, plan, name, texcoords, normals);
    vertex_count_ += mesh.vertex_count();
  }

  void write_statement(std::string_view word, std::string_view name) {
    out_ += word;
    if (!name.empty()) (out_ += ' ') += name;
    end_line();
  }

  static void append_vertex(std::string& out, const Mesh& mesh, const MeshPlan& plan, Index v) {
    out += 'v';
    for (std::size_t c = 0; c < 3; ++c) {
      if (c < mesh.position.count)
        append_component(out, mesh.position, v, c);
      else
        out += " 0";
    }
    const Index w = plan.vertex_wedge[v];
    if (plan.color && plan.has(w, kHasColor)) {
      const bool alpha = plan.color->count == 4 && plan.has(w, kHasAlpha);
      for (std::size_t c = 0; c < (alpha ? 4u : 3u); ++c) append_component(out, *plan.color, w, c);
    } else if (plan.weight && plan.has(w, kHasWeight)) {
      append_component(out, *plan.weight, w, 0);
    }
    out += '\n';
  }

  /// For each of the wedges the first of them with the same `vt` or `vn` line.
  std::vector<Index> first_of_tuples(const MeshPlan& plan, const Attribute& a,
                                     std::span<const Index> wedges) const {
    const bool texcoord = &a == plan.texcoord;
    const Attribute* const texw = texcoord ? plan.texw : nullptr;
    const bool has_present = texcoord && plan.present;
    const std::size_t size =
        a.element_bytes() + (texw ? texw->element_bytes() : 0) + (has_present ? 1 : 0);
    Bytes table;  // what lines differ by
    table.reserve(size * wedges.size());
    const auto append = [&](ByteView bytes) {
      table.insert(table.end(), bytes.begin(), bytes.end());
    };
    for (const Index w : wedges) {
      append(a.element(w));
      if (texw) append(texw->element(w));
      if (has_present) table.push_back(plan.present->data[w] & std::byte{kHasTexV | kHasTexW});
    }
    return first_equals(table, size, threads_);
  }

  /// Writes each distinct tuple once, in order of first use; a cloud's one for each vertex.
  TupleLines write_tuples(const Mesh& mesh, const MeshPlan& plan, const Attribute* a,
                          ObjPresent what, std::uint64_t& count) {
    TupleLines out;
    if (!a) return out;
    out.assign(mesh.wedge_count(), 0);
    if (plan.cloud) {
      append_lines(out_, mesh.wedge_count(), threads_, [&](std::string& text, std::size_t w) {
        append_tuple(text, plan, *a, static_cast<Index>(w));
      });
      return out;
    }
    std::vector<Index> wedges;  // those with a tuple
    for (Index w = 0; w < mesh.wedge_count(); ++w)
      if (plan.used[w] && plan.has(w, what)) wedges.push_back(w);
    const std::vector<Index> first = first_of_tuples(plan, *a, wedges);
    std::vector<Index> written;
    for (std::size_t i = 0; i < wedges.size(); ++i) {
      if (first[i] == i) written.push_back(wedges[i]);
      out[wedges[i]] = first[i] == i ? count + written.size() : out[wedges[first[i]]];
    }
    count += written.size();
    append_lines(out_, written.size(), threads_, [&](std::string& text, std::size_t i) {
      append_tuple(text, plan, *a, written[i]);
    });
    return out;
  }

  void set_turns(MeshPlan& plan) const {
    plan.turns_v = plan.texcoord && model_.scene.texture_origin == TextureOrigin::upper_left;
    if (!plan.turns_v || plan.texcoord->type != ComponentType::f32) return;
    for (std::size_t w = 0; w < plan.used.size() && plan.turns_in_f32; ++w)
      plan.turns_in_f32 = obj::turns_in_f32(float_component(*plan.texcoord, w, 1));
  }

  static void append_turned_component(std::string& out, const MeshPlan& plan, const Attribute& a,
                                      Index w) {
    out += ' ';
    if (a.type == ComponentType::f32)
      obj::append_turned(out, float_component(a, w, 1), plan.turns_in_f32);
    else
      obj::append_turned(out, component(a, w, 1));
  }

  static void append_tuple(std::string& out, const MeshPlan& plan, const Attribute& a, Index w) {
    const bool texcoord = &a == plan.texcoord;
    out += texcoord ? "vt" : "vn";
    std::size_t components = std::min<std::size_t>(a.count, 3);
    if (texcoord && plan.present && !plan.has(w, kHasTexV)) components = 1;
    for (std::size_t c = 0; c < components; ++c)
      if (texcoord && c == 1 && plan.turns_v)
        append_turned_component(out, plan, a, w);
      else
        append_component(out, a, w, c);
    if (texcoord && plan.texw && components == 2 && plan.has(w, kHasTexW))
      append_component(out, *plan.texw, w, 0);
    out += '\n';
  }

  // Faces.

  void write_faces(const Mesh& mesh, const MeshPlan& plan, const std::string& mesh_object,
                   const TupleLines& texcoords, const TupleLines& normals) {
    Index group = kNone;
    for (Index f = 0, next = 0; f < mesh.face_count(); f = next) {
      next = f + 1;
      if (mesh.face(f).empty()) {
        drop("faces without a corner");
        continue;
      }
      if (mesh.group_of(f) != group) {
        group = mesh.group_of(f);
        enter_group(mesh.groups[group], mesh_object);
      }
      const std::uint32_t smoothing = smoothing_of(plan, f);
      enter_smoothing(plan.smoothing, smoothing);
      while (next < mesh.face_count() && mesh.group_of(next) == group && !mesh.face(next).empty() &&
             smoothing_of(plan, next) == smoothing)
        ++next;
      const FaceKind kind = mesh.groups[group].kind;
      append_lines(out_, next - f, threads_, [&](std::string& out, std::size_t i) {
        out += kind == FaceKind::polygons ? 'f' : kind == FaceKind::lines ? 'l' : 'p';
        for (const Index w : mesh.face(f + static_cast<Index>(i)))
          append_corner(out, mesh, w, texcoords, normals);
        out += '\n';
      });
    }
  }

  static std::uint32_t smoothing_of(const MeshPlan& plan, Index face) {
    std::uint32_t value = 0;
    if (plan.smoothing) std::memcpy(&value, plan.smoothing->element(face).data(), sizeof value);
    return value;
  }

  void enter_group(const Group& group, const std::string& mesh_object) {
    assert(group.material == kNone || group.material < material_names_.size());
    const obj::GroupName name = obj::split_group_name(group.name);
    const std::string object = obj::clean_name(name.object);
    const std::string& wanted = object.empty() ? mesh_object : object;
    if (wanted != object_ || name.instance != instance_) write_statement("o", wanted);
    object_ = wanted;
    instance_ = name.instance;
    change(group_, obj::clean_group(name.group), "g");
    change(material_, group.material == kNone ? std::string() : material_names_[group.material],
           "usemtl");
  }

  void change(std::string& state, std::string wanted, std::string_view word) {
    if (state == wanted) return;
    state = std::move(wanted);
    write_statement(word, state);
  }

  /// A mesh that has no smoothing groups only ends that of the one before.
  void enter_smoothing(const Attribute* smoothing, std::uint32_t value) {
    if (smoothing_ == value || (!smoothing && smoothing_ < 0)) return;
    smoothing_ = value;
    write_statement("s", value == 0 ? "off" : std::to_string(value));
  }

  void append_corner(std::string& out, const Mesh& mesh, Index w, const TupleLines& texcoords,
                     const TupleLines& normals) const {
    out += ' ';
    append_index(out, vertex_count_ + mesh.vertex_of(w) + 1);
    const std::uint64_t vt = texcoords.empty() ? 0 : texcoords[w];
    const std::uint64_t vn = normals.empty() ? 0 : normals[w];
    if (vt == 0 && vn == 0) return;
    out += '/';
    if (vt != 0) append_index(out, vt);
    if (vn == 0) return;
    out += '/';
    append_index(out, vn);
  }

  const Model& model_;
  const unsigned threads_;
  ObjFiles files_;
  std::string out_;
  std::set<std::string> dropped_;
  std::vector<std::string> material_names_;
  // Lines written so far, and the state in force.
  std::uint64_t vertex_count_ = 0, texcoord_count_ = 0, normal_count_ = 0;
  std::string object_, group_, material_;
  Index instance_ = 1;           ///< of the object among those of its name
  std::int64_t smoothing_ = -1;  ///< -1: nothing said yet
};

}  // namespace

Result<ObjFiles> write_obj(const Model& model, std::string mtl_name, unsigned threads) {
  const bool refused =
      !mtl_name.empty() && (!obj::companion_path(mtl_name) || trimmed(mtl_name) != mtl_name);
  if (refused)
    return fail(ErrorCode::bad_argument, "not a name for a companion file", kNoOffset, mtl_name);
  return ObjWriter(model, std::move(mtl_name), threads).write();
}

}  // namespace pstrips::inline formats
