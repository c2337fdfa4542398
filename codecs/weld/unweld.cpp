#include "codecs/weld/unweld.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/gather.h"

namespace pstrips::inline codecs {
namespace {

// Reads a list to its end; what is past it makes the whole unsound.
class Numbers {
 public:
  explicit Numbers(std::span<const Index> list) : list_(list) {}
  Index next() {
    if (at_ == list_.size()) {
      past_end_ = true;
      return 0;
    }
    return list_[at_++];
  }
  bool is_used_up() const { return at_ == list_.size() && !past_end_; }

 private:
  std::span<const Index> list_;
  std::size_t at_ = 0;
  bool past_end_ = false;
};

class Unwelder {
 public:
  Unwelder(const Mesh& welded, const Welding& welding) : from_(welded), welding_(welding) {}

  bool number_wedges();
  bool number_corners();
  bool number_vertices();
  bool place_vertices();
  Mesh take();

 private:
  Index copies(Index wedge) const { return first_[wedge + 1] - first_[wedge]; }

  const Mesh& from_;
  const Welding& welding_;
  std::vector<Index> first_;  // of each welded wedge its first decoded one, and one past the end
  std::vector<Index> owner_;  // of each decoded wedge the welded one
  std::vector<Index> vertex_from_;  // of each decoded vertex the welded one
  Mesh out_;
};

bool Unwelder::number_wedges() {
  const Index wedges = from_.wedge_count();
  first_.assign(std::size_t{wedges} + 1, 1);
  std::uint64_t at = 0, all = wedges;
  // A corner names each that does not stand for itself.
  if (welding_.skip.size() != welding_.more.size() ||
      welding_.wedges > std::min<std::uint64_t>(all + from_.corners.size(), kMaxCount))
    return false;
  for (std::size_t i = 0; i < welding_.skip.size(); ++i, ++at) {
    at += welding_.skip[i];
    all += std::uint64_t{welding_.more[i]} + 1;
    if (at >= wedges || all > welding_.wedges) return false;
    first_[at] = welding_.more[i] + 2;
  }
  if (all != welding_.wedges) return false;
  owner_.reserve(all);
  Index next = 0;
  for (Index w = 0; w < wedges; ++w) {
    const Index copies = std::exchange(first_[w], next);
    owner_.insert(owner_.end(), copies, w);
    next += copies;
  }
  first_[wedges] = next;
  return true;
}

bool Unwelder::number_corners() {
  out_.corners = from_.corners;
  std::vector<Index> named(from_.wedge_count(), 0);
  Numbers numbers(welding_.corner);
  for (Index& corner : out_.corners) {
    const Index wedge = corner;
    corner = first_[wedge];
    if (copies(wedge) == 1) continue;
    const Index number = numbers.next();
    if (number > named[wedge]) return false;
    if (number > 0)
      corner += number - 1;
    else if (named[wedge] < copies(wedge))
      corner += named[wedge]++;
    else
      corner += copies(wedge) - 1;
  }
  for (Index w = 0; w < named.size(); ++w)
    if (copies(w) > 1 && named[w] < copies(w)) return false;
  return numbers.is_used_up();
}

bool Unwelder::number_vertices() {
  // Decoded vertices of each welded one, in runs as long as it has wedges.
  std::vector<Index> run(std::size_t{from_.vertex_count()} + 1, 0);
  for (const Index w : owner_) ++run[from_.vertex_of(w) + 1];
  for (std::size_t v = 1; v < run.size(); ++v) run[v] += run[v - 1];
  std::vector<Index> known(from_.vertex_count(), 0), there(owner_.size());
  Numbers numbers(welding_.vertex);
  out_.wedge_vertex.reserve(owner_.size());
  for (const Index w : owner_) {
    const Index v = from_.vertex_of(w);
    const Index number = run[v + 1] - run[v] > 1 ? numbers.next() : 0;
    if (number > known[v]) return false;
    if (number == 0) {
      there[run[v] + known[v]] = static_cast<Index>(vertex_from_.size());
      vertex_from_.push_back(v);
    }
    out_.wedge_vertex.push_back(there[run[v] + (number == 0 ? known[v]++ : number - 1)]);
  }
  return numbers.is_used_up() && vertex_from_.size() == welding_.vertices;
}

bool Unwelder::place_vertices() {
  out_.position = gather(from_.position, vertex_from_);
  const Attribute& moved = welding_.moved_position;
  if (welding_.moved.empty()) return true;
  if (!moved.same_format(from_.position) || moved.elements() != welding_.moved.size()) return false;
  const std::size_t size = moved.element_bytes();
  for (std::size_t i = 0; i < welding_.moved.size(); ++i) {
    const Index v = welding_.moved[i];
    if (v >= vertex_from_.size() || (i > 0 && v <= welding_.moved[i - 1])) return false;
    std::memcpy(out_.position.data.data() + v * size, moved.element(i).data(), size);
  }
  return true;
}

Mesh Unwelder::take() {
  out_.name = from_.name;
  out_.face_first = from_.face_first;
  out_.face_group = from_.face_group;
  out_.face_attributes = from_.face_attributes;
  out_.groups = from_.groups;
  for (const Attribute& a : from_.wedge_attributes)
    out_.wedge_attributes.push_back(gather(a, owner_));
  canonicalize(out_);
  return std::move(out_);
}

}  // namespace

Result<Mesh> unweld(const Mesh& welded, const Welding& welding) {
  Unwelder mesh(welded, welding);
  if (!mesh.number_wedges() || !mesh.number_corners() || !mesh.number_vertices() ||
      !mesh.place_vertices())
    return fail(ErrorCode::corrupt, "the welding does not fit the mesh");
  return mesh.take();
}

}  // namespace pstrips::inline codecs
