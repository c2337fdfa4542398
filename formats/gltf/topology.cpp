#include "formats/gltf/topology.h"

#include <algorithm>
#include <array>

#include "core/group_by.h"

namespace pstrips::inline formats::gltf {
namespace {

using Triangle = std::array<Index, 3>;

/// Joins triangles that follow each other as a strip's do. [gltf.h, GltfTopology]
class StripBuilder {
 public:
  explicit StripBuilder(bool swaps) : swaps_(swaps) {}
  void add(const Triangle& t) {
    if (strip_.empty()) {
      first_ = t;
      strip_ = {t[0], t[1], t[2]};
      return;
    }
    const bool joins = extend(t) || (strip_.size() == 3 && turn_first(t) && extend(t)) ||
                       (swaps_ && strip_.size() > 3 && swap_and_extend(t));
    if (!joins) {
      end_strip();
      add(t);
    }
  }
  std::vector<std::vector<Index>> take() && {
    end_strip();
    return std::move(strips_);
  }

 private:
  /// Appends the third corner when the triangle stands on the strip's last edge.
  bool extend(const Triangle& t) {
    Index a = strip_[strip_.size() - 2], b = strip_.back();
    if (strip_.size() % 2 != 0) std::swap(a, b);  // every second triangle is wound the other way
    for (std::size_t k = 0; k < 3; ++k)
      if (t[k] == a && t[(k + 1) % 3] == b) {
        strip_.push_back(t[(k + 2) % 3]);
        return true;
      }
    return false;
  }
  /// Turns the strip's only triangle so that the next one shares its last edge, if it can be.
  bool turn_first(const Triangle& next) {
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t n = 0; n < 3; ++n)
        if (next[n] == first_[(k + 2) % 3] && next[(n + 1) % 3] == first_[(k + 1) % 3]) {
          strip_ = {first_[k], first_[(k + 1) % 3], first_[(k + 2) % 3]};
          return true;
        }
    return false;
  }
  /// Repeats the third last index before the last one: no triangle more, but another last edge.
  bool swap_and_extend(const Triangle& t) {
    strip_.insert(strip_.end() - 1, strip_[strip_.size() - 3]);
    if (extend(t)) return true;
    strip_.erase(strip_.end() - 2);
    return false;
  }
  void end_strip() {
    if (!strip_.empty()) strips_.push_back(std::move(strip_));
    strip_ = {};
  }

  bool swaps_;
  Triangle first_{};
  std::vector<Index> strip_;
  std::vector<std::vector<Index>> strips_;
};

/// One strip: between two parts the last and the next index are repeated, so that all triangles
/// between are degenerate, and once more where the next part would start on an odd place.
std::vector<Index> join(const std::vector<std::vector<Index>>& strips) {
  std::vector<Index> out;
  for (const auto& strip : strips) {
    if (!out.empty()) {
      out.insert(out.end(), {out.back(), strip.front()});
      if (out.size() % 2 != 0) out.push_back(strip.front());
    }
    out.insert(out.end(), strip.begin(), strip.end());
  }
  return out;
}

class GroupWriter {
 public:
  GroupWriter(const Mesh& mesh, const GltfWriteOptions& options)
      : mesh_(mesh), topology_(options.topology), swaps_(options.swaps) {}

  std::vector<IndexList> write(std::span<const Index> faces, FaceKind kind) {
    if (faces.empty()) return {};
    if (kind == FaceKind::points) return points(faces);
    if (kind == FaceKind::lines) return lines(faces);
    return topology_ == GltfTopology::triangles ? triangles(faces) : strips(faces);
  }
  void report(std::vector<std::string>& dropped) const {
    const auto note = [&](std::uint64_t count, const char* what) {
      if (count > 0) dropped.push_back(std::to_string(count) + ' ' + what);
    };
    note(small_, "faces with too few corners");
    note(degenerate_, "degenerate triangles, which strips cannot show");
    note(cut_, "polylines, cut into segments");
  }

 private:
  template <class Visit>
  void each_triangle(std::span<const Index> faces, Visit&& visit) {
    for (const Index f : faces) {
      const auto corners = mesh_.face(f);
      if (corners.size() < 3) ++small_;
      for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        visit(Triangle{corners[0], corners[i], corners[i + 1]});
    }
  }
  std::vector<IndexList> triangles(std::span<const Index> faces) {
    IndexList out{Mode::triangles, {}};
    out.indices.reserve(3 * faces.size());
    each_triangle(faces, [&](const Triangle& t) {
      out.indices.insert(out.indices.end(), t.begin(), t.end());
    });
    return non_empty(std::move(out));
  }
  std::vector<IndexList> strips(std::span<const Index> faces) {
    StripBuilder builder(swaps_);
    each_triangle(faces, [&](const Triangle& t) {
      if (t[0] == t[1] || t[1] == t[2] || t[0] == t[2])
        ++degenerate_;
      else
        builder.add(t);
    });
    std::vector<std::vector<Index>> strips = std::move(builder).take();
    if (topology_ == GltfTopology::joined_strips) return non_empty({Mode::strip, join(strips)});
    std::vector<IndexList> out;
    for (auto& strip : strips) out.push_back({Mode::strip, std::move(strip)});
    return out;
  }
  std::vector<IndexList> points(std::span<const Index> faces) {
    IndexList out{Mode::points, {}};
    for (const Index f : faces) {
      const auto corners = mesh_.face(f);
      out.indices.insert(out.indices.end(), corners.begin(), corners.end());
    }
    return non_empty(std::move(out));
  }
  std::vector<IndexList> lines(std::span<const Index> faces) {
    if (faces.size() == 1 && mesh_.face(faces.front()).size() > 2) {
      const auto corners = mesh_.face(faces.front());
      return {{Mode::line_strip, {corners.begin(), corners.end()}}};
    }
    IndexList out{Mode::lines, {}};
    for (const Index f : faces) {
      const auto corners = mesh_.face(f);
      if (corners.size() < 2) ++small_;
      if (corners.size() > 2) ++cut_;
      for (std::size_t i = 1; i < corners.size(); ++i)
        out.indices.insert(out.indices.end(), {corners[i - 1], corners[i]});
    }
    return non_empty(std::move(out));
  }
  static std::vector<IndexList> non_empty(IndexList list) {
    if (list.indices.empty()) return {};
    std::vector<IndexList> out;
    out.push_back(std::move(list));
    return out;
  }

  const Mesh& mesh_;
  GltfTopology topology_;
  bool swaps_;
  std::uint64_t small_ = 0, degenerate_ = 0, cut_ = 0;
};

}  // namespace

std::vector<std::vector<IndexList>> index_lists(const Mesh& mesh, const GltfWriteOptions& options,
                                                std::vector<std::string>& dropped) {
  const Grouped<Index> faces_by_group =
      group_by(mesh.groups.size(), mesh.face_count(), [&](Index f) { return mesh.group_of(f); });
  GroupWriter writer(mesh, options);
  std::vector<std::vector<IndexList>> out;
  for (std::size_t g = 0; g < mesh.groups.size(); ++g)
    out.push_back(writer.write(faces_by_group[g], mesh.groups[g].kind));
  writer.report(dropped);
  return out;
}

}  // namespace pstrips::inline formats::gltf
