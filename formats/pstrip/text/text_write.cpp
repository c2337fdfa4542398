#include <algorithm>

#include "core/strip_state.h"
#include "formats/pstrip/numbers.h"
#include "formats/pstrip/text/face_finder.h"
#include "formats/pstrip/text/losses.h"
#include "formats/pstrip/text/text.h"

namespace pstrips::inline formats {
namespace {

/// How much work a replay may do for each byte of Limits::memory_bytes: what is kept of an entry
/// that a record changes takes less than 64 bytes.
constexpr std::uint64_t kBytesPerEntry = 64;

/// A mesh between two records, and what the last record changed. [spec/vsplit.md]
class Replay {
 public:
  /// max_work  entries that all records together may change
  Replay(const ProgressiveMesh& mesh, std::uint64_t max_work) : mesh_(mesh), state_(mesh) {
    state_.limit_work(max_work);
    if (!mesh.reassigned.empty()) state_.list_uses();
  }

  enum class Outcome : std::uint8_t { applied, broken, too_much };

  /// Applies the next record. Broken: it rewrites an entry that does not show its parent, or
  /// reassigns a wedge that is not its parent's.
  Outcome step() {
    const VsplitRecord record = record_at(mesh_, next_);
    bool broken = false;
    changed_.clear();
    state_.apply(
        record, [this](Index entry) { changed_.push_back(entry); },
        [&](const StripChange& change) { broken |= !is_of_parent(change, record); });
    next_.skip(mesh_.vsplits[next_.vsplit]);
    if (broken) return Outcome::broken;
    if (state_.is_exhausted()) return Outcome::too_much;
    std::ranges::sort(changed_);
    changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
    return Outcome::applied;
  }

  /// Entries whose wedge, or whose wedge's vertex, the last record changed; ascending.
  std::span<const Index> changed() const { return changed_; }
  std::span<const Index> resolved() const { return state_.resolved(); }
  Index vertex_at(Index entry) const { return state_.vertex_at(entry); }
  Index wedge_count() const { return state_.wedge_count(); }

 private:
  bool is_of_parent(const StripChange& change, const VsplitRecord& record) const {
    if (change.kind == StripChange::Kind::wedge) return true;
    if (change.kind == StripChange::Kind::owner) return change.before == record.parent;
    const Index before = state_.vertex_of(change.before);
    return before == record.parent || before == record.vertex;
  }

  const ProgressiveMesh& mesh_;
  StripState state_;
  RecordStart next_;
  std::vector<Index> changed_;
};

Error error_of(Replay::Outcome outcome, Index mesh, Index vsplit) {
  const bool broken = outcome == Replay::Outcome::broken;
  return {broken ? ErrorCode::corrupt : ErrorCode::over_limit,
          broken ? "record changes an entry or a wedge that is not its parent's"
                 : "text needs more memory than the limit",
          kNoOffset, "/meshes/" + std::to_string(mesh) + "/vsplits/" + std::to_string(vsplit)};
}

/// For each entry of the map, which texture index its corner has, in numbers of the mesh.
///
/// A face of the format keeps its texture indices for good; only the coordinates under an index
/// change. So two corners share an index when they show the same wedge at every level.
Result<std::vector<Index>> texture_slots(const ProgressiveMesh& mesh, Index index,
                                         std::uint64_t max_work, Index& slots) {
  Replay replay(mesh, max_work);
  std::vector<Index> slot(replay.resolved().begin(), replay.resolved().end());
  slots = mesh.base_wedges;
  struct Changed {
    Index slot, wedge, entry;
    auto operator<=>(const Changed&) const = default;
  };
  std::vector<Changed> changed;
  for (Index i = 0; i < mesh.vsplits.size(); ++i) {
    const Index first_new = replay.wedge_count();
    if (const auto outcome = replay.step(); outcome != Replay::Outcome::applied)
      return tl::unexpected<Error>(error_of(outcome, index, i));
    changed.clear();
    for (const Index entry : replay.changed())
      if (replay.resolved()[entry] >= first_new)
        changed.push_back({slot[entry], replay.resolved()[entry], entry});
    std::ranges::sort(changed);
    for (std::size_t k = 0; k < changed.size(); ++k) {
      const bool same = k > 0 && changed[k - 1].slot == changed[k].slot &&
                        changed[k - 1].wedge == changed[k].wedge;
      slot[changed[k].entry] = same ? slots - 1 : slots++;
    }
  }
  return slot;
}

/// Numbers that run through the whole file; those written count from 1.
struct Numbering {
  explicit Numbering(std::uint64_t key) : finder(key) {}
  Index vertices = 0, slots = 0, faces = 0;
  // Only with texture, where it matters which of two faces with the same vertices is which.
  FaceFinder finder;
  std::vector<Index> window_of;  ///< for each face, where it stands in the map of its mesh
  bool faces_exchanged = false;  ///< a reader gives two faces each other's texture indices
};

/// Writes one mesh: first its base, line kind by line kind, then record after record.
class MeshWriter {
 public:
  static Result<MeshWriter> make(const ProgressiveMesh& mesh, Index index, bool textured,
                                 std::uint64_t max_work) {
    std::vector<Index> slot;
    Index slots = 0;
    if (textured) {
      Result<std::vector<Index>> found = texture_slots(mesh, index, max_work, slots);
      if (!found) return tl::unexpected<Error>(found.error());
      slot = std::move(*found);
    }
    return MeshWriter(mesh, std::move(slot), slots, max_work);
  }

  void write_vertices(TextWriter& out, Numbering& numbers) {
    for (Index v = 0; v < mesh_->base_vertices; ++v) {
      out.text("v ");
      write_position(out, mesh_->position.element(v));
      out.character('\n');
      vertex_number_.push_back(++numbers.vertices);
    }
  }

  /// Texture coordinates of the base, in the order in which the faces name them.
  void write_texture(TextWriter& out, Numbering& numbers) {
    for (const Index window : base_windows_)
      for (const Index entry : corners_of(window))
        if (announce(entry, numbers)) {
          out.text("vt ");
          write_coordinates(out, entry);
          out.character('\n');
        }
  }

  void write_faces(TextWriter& out, Numbering& numbers) {
    for (const Index window : base_windows_) {
      out.character('f');
      for (const Index entry : corners_of(window)) {
        out.character(' ');
        out.integer(vertex_number_[replay_.vertex_at(entry)]);
        if (slot_.empty()) continue;
        out.character('/');
        out.integer(slot_number_[slot_[entry]]);
      }
      out.character('\n');
      add_face(window, numbers);
    }
  }

  /// Record `split`, the one after the last.
  Replay::Outcome write_record(TextWriter& out, Numbering& numbers, Index split) {
    const Index vertex = mesh_->base_vertices + split;
    if (const auto outcome = replay_.step(); outcome != Replay::Outcome::applied) return outcome;
    vertex_number_.push_back(++numbers.vertices);
    move_parent(split);
    sort_windows(vertex);
    out.text("s ");
    for (const Index v : {mesh_->vsplits[split].parent, vertex}) {
      out.integer(vertex_number_[v]);
      out.character(' ');
      const std::size_t bytes = mesh_->position.element_bytes();
      write_position(out, ByteView(positions_).subspan(v * bytes, bytes));
      out.character(' ');
    }
    write_added(out, numbers);
    write_changed(out, numbers, vertex, mesh_->vsplits[split].parent);
    write_texture_changes(out, numbers);
    out.character('\n');
    return Replay::Outcome::applied;
  }

  /// After the last record: whether each wedge that a face uses has one texture index of its own.
  bool wedges_survive() const {
    std::vector<Index> slot_of_wedge(mesh_->wedges, kNone);
    for (Index window = 0; window < face_of_.size(); ++window) {
      if (face_of_[window] == kNone) continue;
      for (const Index entry : corners_of(window)) {
        const Index slot = slot_.empty() ? replay_.vertex_at(entry) : slot_[entry];
        Index& known = slot_of_wedge[replay_.resolved()[entry]];
        if (known != kNone && known != slot) return false;
        known = slot;
      }
    }
    return std::ranges::find(slot_of_wedge, kNone) == slot_of_wedge.end();
  }

 private:
  enum class Window : std::uint8_t { none, even, odd };

  MeshWriter(const ProgressiveMesh& mesh, std::vector<Index> slot, Index slots,
             std::uint64_t max_work)
      : mesh_(&mesh),
        texture_(texture_of(mesh)),
        slot_(std::move(slot)),
        slot_number_(slots, kNone),
        slot_wedge_(slots, kNone),
        replay_(mesh, max_work) {
    const std::span<const Index> map = replay_.resolved();
    windows_.assign(map.size(), Window::none);
    face_of_.assign(map.size(), kNone);
    std::size_t strip = 0;
    for (std::size_t i = 0; i + 2 < map.size(); ++i) {
      if (map[i] == kRestart) strip = i + 1;
      if (map[i] == kRestart || map[i + 1] == kRestart || map[i + 2] == kRestart) continue;
      windows_[i] = (i - strip) % 2 == 0 ? Window::even : Window::odd;
      if (is_triangle(static_cast<Index>(i))) base_windows_.push_back(static_cast<Index>(i));
    }
    positions_ = mesh.position.data;
  }

  bool is_triangle(Index window) const {
    if (windows_[window] == Window::none) return false;
    const auto [a, b, c] = vertices_of({window, window + 1, window + 2});
    return a != b && b != c && a != c;
  }
  /// Entries of the corners, wound as the mesh.
  std::array<Index, 3> corners_of(Index window) const {
    if (windows_[window] == Window::even) return {window, window + 1, window + 2};
    return {window + 1, window, window + 2};
  }
  FaceFinder::Triangle vertices_of(const std::array<Index, 3>& entries) const {
    return {replay_.vertex_at(entries[0]), replay_.vertex_at(entries[1]),
            replay_.vertex_at(entries[2])};
  }
  FaceFinder::Triangle numbers_of(Index window) const {
    FaceFinder::Triangle t = vertices_of(corners_of(window));
    for (Index& v : t) v = vertex_number_[v];
    return t;
  }

  void write_position(TextWriter& out, ByteView element) const {
    const Attribute& position = mesh_->position;
    for (std::size_t c = 0; c < 3; ++c) {
      if (c > 0) out.character(' ');
      if (c < position.count)
        out.component(position.type, element.data() + c * size_of(position.type));
      else
        out.character('0');
    }
  }
  void write_coordinates(TextWriter& out, Index entry) const {
    const ByteView element = texture_->element(replay_.resolved()[entry]);
    for (std::size_t c = 0; c < 2; ++c) {
      if (c > 0) out.character(' ');
      if (c < texture_->count)
        out.component(texture_->type, element.data() + c * size_of(texture_->type));
      else
        out.character('0');
    }
  }
  void write_indexed_coordinates(TextWriter& out, Index entry) const {
    out.character(' ');
    out.integer(slot_number_[slot_[entry]]);
    out.character(' ');
    write_coordinates(out, entry);
  }

  void move_parent(Index split) {
    if (mesh_->placement != Placement::optimal) return;
    const std::size_t bytes = mesh_->position.element_bytes();
    std::memcpy(positions_.data() + mesh_->vsplits[split].parent * bytes,
                mesh_->parent_position.data() + split * bytes, bytes);
  }

  /// The windows that the last step changed: those that are faces now, those that were already.
  void sort_windows(Index vertex) {
    added_.clear();
    changed_.clear();
    Index done = 0;  // windows below this one are sorted already
    for (const Index entry : replay_.changed())
      for (Index window = std::max(done, entry < 2 ? 0 : entry - 2); window <= entry; ++window) {
        done = window + 1;
        if (!is_triangle(window)) continue;
        const FaceFinder::Triangle t = vertices_of({window, window + 1, window + 2});
        if (face_of_[window] == kNone)
          added_.push_back(window);
        else if (std::ranges::find(t, vertex) != t.end())
          changed_.push_back(window);
      }
  }

  /// Gives the corner's texture index a number and takes its coordinates; false when it has one.
  bool announce(Index entry, Numbering& numbers) {
    Index& number = slot_number_[slot_[entry]];
    if (number != kNone) return false;
    number = ++numbers.slots;
    slot_wedge_[slot_[entry]] = replay_.resolved()[entry];
    return true;
  }

  void add_face(Index window, Numbering& numbers) {
    face_of_[window] = numbers.faces++;
    if (slot_.empty()) return;
    numbers.window_of.resize(numbers.faces);
    numbers.window_of[face_of_[window]] = window;
    numbers.finder.insert(face_of_[window], numbers_of(window));
  }

  void write_added(TextWriter& out, Numbering& numbers) {
    out.integer(std::uint64_t{added_.size()});
    for (const Index window : added_) {
      write_triple(out, numbers_of(window));
      add_face(window, numbers);
    }
  }

  /// Names the faces as they were before the record.
  void write_changed(TextWriter& out, Numbering& numbers, Index vertex, Index parent) {
    out.character(' ');
    out.integer(std::uint64_t{changed_.size()});
    for (const Index window : changed_) {
      const FaceFinder::Triangle after = numbers_of(window);
      FaceFinder::Triangle before = after;
      std::ranges::replace(before, vertex_number_[vertex], vertex_number_[parent]);
      write_triple(out, before);
      if (slot_.empty()) continue;
      const Index face = numbers.finder.take(before);
      if (face != face_of_[window]) exchange(window, face, numbers);
      numbers.finder.insert(face, after);
    }
  }

  /// A reader takes `face` for the one in this window: from now on it is.
  void exchange(Index window, Index face, Numbering& numbers) {
    const Index other = numbers.window_of[face];
    std::swap(numbers.window_of[face], numbers.window_of[face_of_[window]]);
    std::swap(face_of_[window], face_of_[other]);
    numbers.faces_exchanged = true;
  }

  void write_texture_changes(TextWriter& out, Numbering& numbers) {
    if (slot_.empty()) return out.text(" 0 0 0");
    std::vector<Index> announced, moved;  // an entry for each texture index
    for (const Index window : added_)
      for (const Index entry : corners_of(window))
        if (announce(entry, numbers)) announced.push_back(entry);
    for (const Index entry : replay_.changed()) {
      const Index slot = slot_[entry], wedge = replay_.resolved()[entry];
      if (slot_number_[slot] == kNone || slot_wedge_[slot] == wedge) continue;
      if (!std::ranges::equal(texture_->element(slot_wedge_[slot]), texture_->element(wedge)))
        moved.push_back(entry);
      slot_wedge_[slot] = wedge;
    }
    out.character(' ');
    out.integer(std::uint64_t{added_.size()});
    for (const Index window : added_) {
      const std::array<Index, 3> entries = corners_of(window);
      write_triple(out, {slot_number_[slot_[entries[0]]], slot_number_[slot_[entries[1]]],
                         slot_number_[slot_[entries[2]]]});
    }
    for (const std::vector<Index>& list : {announced, moved}) {
      out.character(' ');
      out.integer(std::uint64_t{list.size()});
      for (const Index entry : list) write_indexed_coordinates(out, entry);
    }
  }

  void write_triple(TextWriter& out, const FaceFinder::Triangle& t) const {
    for (const Index v : t) {
      out.character(' ');
      out.integer(v);
    }
  }

  const ProgressiveMesh* mesh_;
  const Attribute* texture_;
  std::vector<Index> slot_;         // texture index of each entry; empty: no texture
  std::vector<Index> slot_number_;  // in the file
  std::vector<Index> slot_wedge_;   // whose coordinates were written last
  Replay replay_;
  std::vector<Window> windows_;  // that start at each entry
  std::vector<Index> face_of_;   // the face of each window
  std::vector<Index> base_windows_, added_, changed_;
  std::vector<Index> vertex_number_;  // in the file
  Bytes positions_;                   // where vertices stand now
};

/// The type of an attribute when all meshes agree, else the one that holds them all.
template <class AttributeOf>
ComponentType common_type(const ProgressiveStrips& strips, AttributeOf&& attribute_of) {
  if (strips.meshes.empty()) return ComponentType::f32;
  const ComponentType first = attribute_of(strips.meshes.front())->type;
  const bool all = std::ranges::all_of(
      strips.meshes, [&](const ProgressiveMesh& m) { return attribute_of(m)->type == first; });
  return all ? first : ComponentType::f64;
}

/// The first line, once it is known what follows.
Bytes header(const ProgressiveStrips& strips, bool textured, const Numbering& numbers,
             Losses& losses) {
  const auto position_of = [](const ProgressiveMesh& m) { return &m.position; };
  std::uint64_t vsplits = 0;
  for (const ProgressiveMesh& mesh : strips.meshes) vsplits += mesh.vsplits.size();
  TextWriter out;
  out.text("# pstrips text 1.0 vertices=");
  out.integer(numbers.vertices);
  out.text(" faces=");
  out.integer(numbers.faces);
  out.text(" vsplits=");
  out.integer(vsplits);
  const auto write_type = [&](std::string_view key, auto&& attribute_of) {
    const ComponentType type = common_type(strips, attribute_of);
    out.text(key);
    out.text(name_of(type));
    for (const ProgressiveMesh& mesh : strips.meshes)
      losses.add(attribute_of(mesh)->type != type, "component types that differ between meshes");
  };
  write_type(" position=", position_of);
  if (textured) write_type(" texture=", texture_of);
  out.character('\n');
  return std::move(out).take();
}

}  // namespace

Result<TextFile> write_text(const ProgressiveStrips& strips, const Limits& limits) {
  for (std::size_t m = 0; m < strips.meshes.size(); ++m)
    if (strips.meshes[m].encoding == MapEncoding::triangles)
      return fail(ErrorCode::bad_argument, "text files have no place for maps of triangles",
                  kNoOffset, "/meshes/" + std::to_string(m));
  const bool textured =
      !strips.meshes.empty() &&
      std::ranges::all_of(strips.meshes, [](const auto& m) { return texture_of(m) != nullptr; });
  Losses losses = losses_of(strips, textured);

  std::uint64_t key = 0;
  std::vector<MeshWriter> meshes;
  for (Index m = 0; m < strips.meshes.size(); ++m) {
    key ^= fingerprint(std::as_bytes(std::span(strips.meshes[m].map_offsets)));
    Result<MeshWriter> mesh =
        MeshWriter::make(strips.meshes[m], m, textured, limits.memory_bytes / kBytesPerEntry);
    if (!mesh) return tl::unexpected<Error>(mesh.error());
    meshes.push_back(std::move(*mesh));
  }
  TextWriter out;
  Numbering numbers(key);
  for (MeshWriter& mesh : meshes) mesh.write_vertices(out, numbers);
  if (textured)
    for (MeshWriter& mesh : meshes) mesh.write_texture(out, numbers);
  for (MeshWriter& mesh : meshes) mesh.write_faces(out, numbers);
  for (const Packet& packet : strips.packets)
    for (Index i = packet.first_vsplit; i < packet.first_vsplit + packet.vsplits; ++i) {
      auto outcome = meshes[packet.mesh].write_record(out, numbers, i);
      if (out.size() > limits.memory_bytes) outcome = Replay::Outcome::too_much;
      if (outcome != Replay::Outcome::applied)
        return tl::unexpected<Error>(error_of(outcome, packet.mesh, i));
    }
  losses.add(numbers.faces_exchanged,
             "which texture coordinates go with which of several faces on the same vertices");
  losses.add(std::ranges::any_of(meshes, [](const auto& m) { return !m.wedges_survive(); }),
             "wedges that are not the corners' vertices and texture coordinates");
  Bytes bytes = header(strips, textured, numbers, losses);
  const Bytes body = std::move(out).take();
  bytes.insert(bytes.end(), body.begin(), body.end());
  return TextFile{std::move(bytes), std::move(losses).take()};
}

}  // namespace pstrips::inline formats
