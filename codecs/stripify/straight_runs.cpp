#include "codecs/stripify/straight_runs.h"

namespace pstrips::inline codecs {

StraightRuns::StraightRuns(const StripFaces& faces)
    : faces_(faces), place_of_(2 * std::size_t{faces.count()}, kNone) {
  for (Index f = 0; f < faces.count(); ++f)
    for (Index h = faces.first[f]; faces.size(f) == 4 && h < faces.first[f] + 2; ++h)
      if (place_of_[slot(h)] == kNone) lay_down(h);
}

// The same for both ends of a way across a quad.
Index StraightRuns::slot(Index half_edge) const {
  const Index f = faces_.face[half_edge];
  return 2 * f + (half_edge - faces_.first[f]) % 2;
}

void StraightRuns::lay_down(Index first_exit) {
  const auto next = [&](Index exit) {
    const Index entry = faces_.opposite[exit];
    return entry == kNone || faces_.size(faces_.face[entry]) != 4 ? kNone : faces_.turned(entry, 2);
  };
  // Back to where the row begins, or once around.
  Index begin = faces_.turned(first_exit, 2);
  for (Index back = next(begin); back != kNone && slot(back) != slot(first_exit); back = next(back))
    begin = back;
  const auto first = static_cast<Index>(exits_.size());
  for (Index exit = faces_.turned(begin, 2); exit != kNone && place_of_[slot(exit)] == kNone;
       exit = next(exit)) {
    place_of_[slot(exit)] = static_cast<Index>(exits_.size());
    exits_.push_back(exit);
  }
  run_at_.resize(exits_.size());
  add({first, static_cast<Index>(exits_.size())});
}

void StraightRuns::add(Run run) {
  const auto name = static_cast<Index>(runs_.size());
  for (Index i = run.begin; i < run.end; ++i) run_at_[i] = name;
  runs_.push_back(run);
  queue_.push({run.length(), ~name});
}

void StraightRuns::take(Index face) {
  if (faces_.size(face) != 4) return;
  for (const Index s : {2 * face, 2 * face + 1}) part(std::exchange(place_of_[s], kNone));
}

void StraightRuns::part(Index place) {
  Run& run = runs_[run_at_[place]];
  Run shorter{run.begin, place}, longer{place + 1, run.end};
  if (shorter.length() > longer.length()) std::swap(shorter, longer);
  run = longer;
  queue_.push({longer.length(), ~run_at_[place]});
  if (shorter.length() > 0) add(shorter);
}

std::span<const Index> StraightRuns::longest(Index least) {
  for (; !queue_.empty() && queue_.top().first >= least; queue_.pop()) {
    const Run run = runs_[~queue_.top().second];
    if (run.length() == queue_.top().first)
      return std::span(exits_).subspan(run.begin, run.length());
  }
  return {};
}

}  // namespace pstrips::inline codecs
