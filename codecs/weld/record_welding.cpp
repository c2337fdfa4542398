#include "codecs/weld/record_welding.h"

#include <algorithm>
#include <utility>

namespace pstrips::inline codecs {
namespace {

class WeldingRecorder {
 public:
  WeldingRecorder(const Mesh& source, const Welds& welds, const Mesh& decoded,
                  std::span<const Index> wedge_from)
      : source_(source),
        decoded_(decoded),
        copies_(decoded.wedge_count(), 1),
        named_(decoded.wedge_count(), 0),
        number_(source.wedge_count(), kNone) {
    std::vector<Index> size(welds.wedge_from.size(), 0);
    for (const Index set : welds.wedge) ++size[set];
    first_.reserve(copies_.size());
    Index wedges = 0;
    for (Index w = 0; w < copies_.size(); ++w) {
      copies_[w] = size[wedge_from[w]];
      first_.push_back(wedges);
      wedges += copies_[w];
      owner_.insert(owner_.end(), copies_[w], w);
    }
    out_.wedge_from.resize(wedges);
    for (Index w = 0; w < copies_.size(); ++w)
      out_.wedge_from[first_[w]] = welds.wedge_from[wedge_from[w]];
    out_.welding.wedges = wedges;
  }

  void list_copies();
  void number_corners(const OriginalOrder& order);
  void number_vertices();
  void note_moved();
  WeldingRecord take() { return std::move(out_); }

 private:
  void number_corner(Index wedge, Index from);

  const Mesh& source_;
  const Mesh& decoded_;
  std::vector<Index> copies_, first_, named_;  // by wedge of `decoded_`
  std::vector<Index> number_;  // of each wedge of the source, among those that it is welded with
  std::vector<Index> owner_;   // of each decoded wedge the one that it was welded into
  WeldingRecord out_;
};

void WeldingRecorder::list_copies() {
  Index skipped = 0;
  for (const Index copies : copies_) {
    if (copies == 1) {
      ++skipped;
      continue;
    }
    out_.welding.skip.push_back(std::exchange(skipped, 0));
    out_.welding.more.push_back(copies - 2);
  }
}

void WeldingRecorder::number_corners(const OriginalOrder& order) {
  for (Index f = 0; f < decoded_.face_count(); ++f) {
    const std::span<const Index> face = decoded_.face(f), from = source_.face(order.face[f]);
    const std::size_t n = face.size();
    for (std::size_t k = 0; k < n; ++k)
      number_corner(face[k], from[(k + n - order.rotation[f]) % n]);
  }
}

void WeldingRecorder::number_corner(Index wedge, Index from) {
  if (copies_[wedge] == 1) return;
  Index& named = named_[wedge];
  Index& number = number_[from];
  const bool is_new = number == kNone;
  if (is_new) {
    number = named++;
    out_.wedge_from[first_[wedge] + number] = from;
  }
  const bool is_last = number + 1 == copies_[wedge];
  out_.welding.corner.push_back(is_new || is_last ? 0 : number + 1);
}

void WeldingRecorder::number_vertices() {
  std::vector<Index> wedges(decoded_.vertex_count(), 0), known(decoded_.vertex_count(), 0);
  for (const Index w : owner_) ++wedges[decoded_.vertex_of(w)];
  std::vector<Index> number(source_.vertex_count(), kNone);
  for (Index w = 0; w < owner_.size(); ++w) {
    const Index place = decoded_.vertex_of(owner_[w]);
    const Index vertex = source_.vertex_of(out_.wedge_from[w]);
    const bool is_new = number[vertex] == kNone;
    if (wedges[place] > 1) out_.welding.vertex.push_back(is_new ? 0 : number[vertex] + 1);
    if (!is_new) continue;
    number[vertex] = known[place]++;
    out_.vertex_from.push_back(vertex);
  }
  out_.welding.vertices = static_cast<Index>(out_.vertex_from.size());
}

void WeldingRecorder::note_moved() {
  std::vector<Index> place(source_.vertex_count(), kNone);
  for (Index w = 0; w < owner_.size(); ++w)
    place[source_.vertex_of(out_.wedge_from[w])] = decoded_.vertex_of(owner_[w]);
  Welding& welding = out_.welding;
  welding.moved_position = source_.position.format();
  for (Index v = 0; v < out_.vertex_from.size(); ++v) {
    const Index from = out_.vertex_from[v];
    const ByteView stands = source_.position.element(from);
    if (std::ranges::equal(stands, decoded_.position.element(place[from]))) continue;
    welding.moved.push_back(v);
    Bytes& data = welding.moved_position.data;
    data.insert(data.end(), stands.begin(), stands.end());
  }
}

}  // namespace

WeldingRecord record_welding(const Mesh& source, const Welds& welds, const Mesh& decoded,
                             std::span<const Index> wedge_from, const OriginalOrder& order) {
  WeldingRecorder recorder(source, welds, decoded, wedge_from);
  recorder.list_copies();
  recorder.number_corners(order);
  recorder.number_vertices();
  recorder.note_moved();
  return recorder.take();
}

}  // namespace pstrips::inline codecs
