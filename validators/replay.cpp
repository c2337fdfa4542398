#include "validators/replay.h"

#include <algorithm>

#include "core/strip_state.h"

namespace pstrips::inline validators {
namespace {

/// How many triangles and strips a map shows, kept up to date entry by entry.
class ShownCounts {
 public:
  ShownCounts(const StripState& state, MapEncoding encoding)
      : state_(state), has_whole_triangles_(encoding == MapEncoding::triangles) {
    for (std::size_t i = 0; i < state.resolved().size(); ++i) add_entry(i);
    for (std::size_t i = 0; i < state.resolved().size(); ++i) count_window(i);
  }

  Shown shown(Index vertices) const { return {vertices, triangles_, strips_}; }

  /// Entry `at` shows another wedge or vertex.
  void operator()(std::size_t at) {
    if (at == strip_of_.size()) add_entry(at);
    for (std::size_t i = at < 2 ? 0 : at - 2; i <= at; ++i) count_window(i);
  }

 private:
  /// Counts the triangle of the entries i, i+1, i+2 when it has come or gone.
  void count_window(std::size_t i) {
    const bool is = shows_triangle(i);
    if (is == (is_triangle_[i] != 0)) return;
    is_triangle_[i] = is;
    Index& of_strip = triangles_of_strip_[strip_of_[i]];
    if (is) {
      ++triangles_;
      if (of_strip++ == 0) ++strips_;
    } else {
      --triangles_;
      if (--of_strip == 0) --strips_;
    }
  }

  void add_entry(std::size_t at) {
    if (at == 0 || (has_whole_triangles_ && at % 3 == 0)) triangles_of_strip_.push_back(0);
    strip_of_.push_back(static_cast<Index>(triangles_of_strip_.size() - 1));
    is_triangle_.push_back(0);
    if (state_.resolved()[at] == kRestart) triangles_of_strip_.push_back(0);
  }

  bool shows_triangle(std::size_t i) const {
    if (has_whole_triangles_ && i % 3 != 0) return false;
    const std::span<const Index> map = state_.resolved();
    if (map.size() - i < 3) return false;
    if (map[i] == kRestart || map[i + 1] == kRestart || map[i + 2] == kRestart) return false;
    const Index a = state_.vertex_of(map[i]), b = state_.vertex_of(map[i + 1]),
                c = state_.vertex_of(map[i + 2]);
    return a != b && b != c && a != c;
  }

  const StripState& state_;
  bool has_whole_triangles_;  // each a strip of its own
  std::vector<Index> strip_of_;
  std::vector<std::uint8_t> is_triangle_;  // by first entry
  std::vector<Index> triangles_of_strip_;
  Index triangles_ = 0, strips_ = 0;
};

/// Replays one record at a time; a rule that is broken becomes a fault.
class Records {
 public:
  Records(const ProgressiveMesh& mesh, Faults& faults)
      : mesh_(mesh),
        faults_(faults),
        state_(mesh),
        counts_(state_, mesh.encoding),
        wedges_of_(mesh.base_vertices + mesh.vsplits.size()),
        vertices_(mesh.base_vertices) {
    for (Index w = 0; w < state_.wedge_count(); ++w) ++wedges_of_[state_.vertex_of(w)];
    state_.grant_work(mesh.map_offsets.size() + mesh.reassigned.size());
    if (!mesh.reassigned.empty()) state_.list_uses();
  }

  Replay run(std::span<const Index> packets) {
    Replay out;
    out.finished = has_triangles(state_.resolved(), Field::base_map, 0);
    if (out.finished) out.levels.push_back(counts_.shown(vertices_));
    for (packet_ = 0; packet_ < packets.size() && out.finished; ++packet_) {
      packet_start_ = at_;
      for (record_ = 0; record_ < packets[packet_] && out.finished; ++record_)
        out.finished = apply();
      if (out.finished) out.levels.push_back(counts_.shown(vertices_));
    }
    const std::span<const Index> map = state_.resolved(), vertices = state_.wedge_vertices();
    out.map.assign(map.begin(), map.end());
    out.wedge_vertex.assign(vertices.begin(), vertices.end());
    return out;
  }

 private:
  bool apply() {
    const VsplitRecord record = record_at(mesh_, at_);
    if (record.parent > record.vertex) return broken(Fault::parent_not_there, Field::parent);
    const bool alone = record.parent == record.vertex;
    if (alone && !record.reassigned.empty())
      return broken(Fault::isolated_vertex_reassigns, Field::record);
    if (alone && !(record.map_offsets.empty() && record.new_corners.empty()))
      return broken(Fault::isolated_vertex_writes, Field::record);
    if (alone && moves(record.vertex)) return broken(Fault::isolated_vertex_moves, Field::record);
    ++vertices_;
    const Index first_wedge = state_.wedge_count();
    if (!offsets_hold(record) || !write_offsets(record, first_wedge)) return false;
    if (!reassign_wedges(record, first_wedge) || !append_triangles(record)) return false;
    if (wedges_of_[record.vertex] == 0)
      return broken(Fault::new_vertex_without_wedge, Field::record);
    if (wedges_of_[record.parent] == 0) return broken(Fault::parent_without_wedge, Field::record);
    if (state_.is_exhausted()) return broken(Fault::too_much_work, Field::record);
    at_.skip(mesh_.vsplits[at_.vsplit]);
    return true;
  }

  /// With optimal placement: the record gives its own vertex two positions.
  bool moves(Index vertex) const {
    if (mesh_.placement != Placement::optimal) return false;
    const std::size_t bytes = mesh_.position.element_bytes();
    const ByteView moved = ByteView(mesh_.parent_position).subspan(at_.vsplit * bytes, bytes);
    return !std::ranges::equal(mesh_.position.element(vertex), moved);
  }

  /// All map offsets are judged by the state before the record.
  bool offsets_hold(const VsplitRecord& record) {
    std::size_t k = 0;
    for (const Index count : record.offset_counts)
      for (const std::size_t first = k, end = k + count; k < end; ++k) {
        const Index offset = record.map_offsets[k];
        if (offset >= state_.resolved().size()) return broken_offset(Fault::offset_past_end, k);
        if (state_.resolved()[offset] == kRestart)
          return broken_offset(Fault::offset_is_restart, k);
        if (k > first && offset <= record.map_offsets[k - 1])
          return broken_offset(Fault::offsets_not_ascending, k);
        if (state_.vertex_at(offset) != record.parent)
          return broken_offset(Fault::offset_not_of_parent, k);
      }
    return true;
  }

  bool write_offsets(const VsplitRecord& record, Index first_wedge) {
    wedges_of_[record.vertex] += static_cast<Index>(record.offset_counts.size());
    for (std::size_t w = 0; w < record.offset_counts.size(); ++w) state_.add_wedge(record.vertex);
    Index wedge = first_wedge;
    std::size_t k = 0;
    for (const Index count : record.offset_counts) {
      for (const std::size_t end = k + count; k < end; ++k) {
        const Index before = state_.stored(record.map_offsets[k]);
        if (is_wedge(before) && before >= first_wedge) return broken_offset(Fault::offset_twice, k);
        state_.write(record.map_offsets[k], wedge, wedge, counts_);
      }
      ++wedge;
    }
    return true;
  }

  bool reassign_wedges(const VsplitRecord& record, Index first_wedge) {
    for (std::size_t k = 0; k < record.reassigned.size(); ++k) {
      const Index wedge = record.reassigned[k];
      if (wedge >= first_wedge) return broken_wedge(Fault::reassigned_not_there, k);
      if (state_.vertex_of(wedge) != record.parent)
        return broken_wedge(Fault::reassigned_not_of_parent, k);
      --wedges_of_[record.parent];
      ++wedges_of_[record.vertex];
      state_.reassign(wedge, record.vertex, counts_);
    }
    return true;
  }

  bool append_triangles(const VsplitRecord& record) {
    const std::span<const Index> corners = record.new_corners;
    const std::size_t first = at_.new_corner - packet_start_.new_corner;
    for (std::size_t k = 0; k < corners.size(); ++k)
      if (corners[k] >= state_.wedge_count())
        return broken(Fault::corner_not_there, Field::new_corner, first + k);
    if (!has_triangles(corners, Field::new_corner, first)) return false;
    for (std::size_t k = 0; k < corners.size(); k += 3)
      state_.append(corners.subspan(k).first<3>(), counts_);
    return true;
  }

  /// Of a map of triangles: each has corners of three vertices.
  bool has_triangles(std::span<const Index> corners, Field field, std::size_t first) {
    if (mesh_.encoding != MapEncoding::triangles) return true;
    for (std::size_t k = 0; k < corners.size(); k += 3) {
      const Index a = state_.vertex_of(corners[k]), b = state_.vertex_of(corners[k + 1]),
                  c = state_.vertex_of(corners[k + 2]);
      if (a == b || b == c || a == c) return broken(Fault::degenerate_triangle, field, first + k);
    }
    return true;
  }

  /// Faults of the k-th list element of the record.
  bool broken_offset(Fault fault, std::size_t k) {
    return broken(fault, Field::map_offset, at_.map_offset - packet_start_.map_offset + k);
  }
  bool broken_wedge(Fault fault, std::size_t k) {
    return broken(fault, Field::reassigned, at_.reassigned - packet_start_.reassigned + k);
  }
  bool broken(Fault fault, Field field, std::uint64_t element = 0) {
    Where where{.field = field, .element = element};
    if (field != Field::base_map) {
      where.packet = packet_;
      where.record = record_;
    }
    if (field == Field::parent) where.element = record_;
    faults_.add(fault, where);
    return false;
  }

  const ProgressiveMesh& mesh_;
  Faults& faults_;
  StripState state_;
  ShownCounts counts_;
  std::vector<Index> wedges_of_;  // how many wedges each vertex has
  Index vertices_;
  RecordStart at_, packet_start_;
  Index packet_ = 0, record_ = 0;
};

}  // namespace

Replay replay(const ProgressiveMesh& mesh, std::span<const Index> packets, Faults& faults) {
  return Records(mesh, faults).run(packets);
}

}  // namespace pstrips::inline validators
