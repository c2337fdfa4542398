#include "codecs/filter/display_level.h"

#include <algorithm>

#include "codecs/filter/derived_strips.h"

namespace pstrips::inline codecs {

DisplayLevel::DisplayLevel(const ProgressiveMesh& mesh, Filter filter)
    : level_(mesh), filter_(filter), filtered_to_(level_.next()) {
  if (is_derived()) {
    derive();
    return;
  }
  strips_ = strip_ranges(level_.resolved());
  segments_.resize(strips_.size());
  is_changed_.resize(strips_.size());
  level_.track_reassigned();
  for (std::size_t s = 0; s < strips_.size(); ++s) refilter(s);
}

void DisplayLevel::refine(Index vsplits) { level_.refine(vsplits); }

void DisplayLevel::mark_changed(std::span<const Index> entries) {
  for (const Index entry : entries) {
    const auto after = std::ranges::upper_bound(strips_, entry, {}, &StripRange::first);
    const auto strip = static_cast<Index>(after - strips_.begin() - 1);
    if (is_changed_[strip]) continue;
    is_changed_[strip] = true;
    changed_.push_back(strip);
  }
}

void DisplayLevel::derive() {
  pool_ = derive_strips(level_.view());
  cost_ = display_cost(pool_);
}

std::uint64_t DisplayLevel::derived_strips() const {
  return is_derived() && !pool_.empty() ? cost_.restarts + 1 : 0;
}

// Entries that follow a written one are in its strip.
std::size_t DisplayLevel::update() {
  if (is_derived()) {
    if (filtered_to_ == level_.next()) return 0;
    filtered_to_ = level_.next();
    derive();
    return derived_strips();
  }
  changed_.clear();
  mark_changed(level_.offsets_since(filtered_to_));
  mark_changed(level_.take_reassigned());
  filtered_to_ = level_.next();
  for (const Index strip : changed_) {
    refilter(strip);
    is_changed_[strip] = false;
  }
  if (pool_.size() > 2 * used_ + 1024) compact();
  return changed_.size();
}

void DisplayLevel::refilter(std::size_t strip) {
  Segment& segment = segments_[strip];
  used_ -= segment.entries;
  cost_.vertices_sent -= segment.cost.vertices_sent;
  cost_.restarts -= segment.cost.restarts;
  segment.first = pool_.size();
  const StripRange& range = strips_[strip];
  append_filtered(filter_, level_.resolved().subspan(range.first, range.end - range.first),
                  level_.wedge_vertices(), pool_);
  segment.entries = static_cast<Index>(pool_.size() - segment.first);
  segment.cost = display_cost(std::span(pool_).subspan(segment.first));
  used_ += segment.entries;
  cost_.vertices_sent += segment.cost.vertices_sent;
  cost_.restarts += segment.cost.restarts;
}

void DisplayLevel::compact() {
  DisplayStrips pool{kRestart};
  pool.reserve(used_ + 1);
  for (Segment& segment : segments_) {
    const auto first = pool_.begin() + static_cast<std::ptrdiff_t>(segment.first);
    segment.first = pool.size();
    pool.insert(pool.end(), first, first + segment.entries);
  }
  pool_ = std::move(pool);
}

DisplayCost DisplayLevel::cost() const {
  DisplayCost out = cost_;
  if (out.restarts > 0 && !is_derived()) --out.restarts;  // the first segment's
  return out;
}

void DisplayLevel::append_display(DisplayStrips& out) const {
  const std::size_t start = out.size();
  if (is_derived()) {
    if (start > 0 && !pool_.empty()) out.push_back(kRestart);
    out.insert(out.end(), pool_.begin(), pool_.end());
    return;
  }
  for (const Segment& segment : segments_) {
    const auto first = pool_.begin() + static_cast<std::ptrdiff_t>(segment.first);
    out.insert(out.end(), first, first + segment.entries);
  }
  if (start == 0 && !out.empty()) out.erase(out.begin());  // the first segment's restart
}

}  // namespace pstrips::inline codecs
