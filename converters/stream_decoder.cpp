#include "converters/stream_decoder.h"

#include "converters/decode.h"

namespace pstrips::inline converters {

StreamDecoder::StreamDecoder(const Limits& limits, Filter filter)
    : parser_(limits), filter_(filter) {}

Result<void> StreamDecoder::feed(ByteView bytes) {
  const Result<void> fed = parser_.feed(bytes);
  const ProgressiveStrips& strips = parser_.strips();
  if (!parser_.has_base()) return fed;
  if (!now_) {
    for (const ProgressiveMesh& mesh : strips.meshes) levels_.emplace_back(mesh, filter_);
    now_.emplace(strips);
  }
  for (; packets_ < strips.packets.size(); ++packets_) {
    const Packet& packet = strips.packets[packets_];
    levels_[packet.mesh].refine(packet.vsplits);
    now_->add(packet);
  }
  const std::span<const Index> completed = parser_.completed_meshes();
  for (; completed_ < completed.size(); ++completed_)
    levels_[completed[completed_]].reload_positions();
  return fed;
}

StreamDecoder::Totals StreamDecoder::totals() const {
  if (!now_) return {};
  std::uint64_t strips = now_->strips();
  for (const DisplayLevel& level : levels_) strips += level.derived_strips();
  return {now_->vertices(), now_->triangles(), strips, now_->error()};
}

bool StreamDecoder::update() {
  if (!now_ || updated_to_ == changes()) return false;
  for (DisplayLevel& level : levels_) level.update();
  updated_to_ = changes();
  return true;
}

Result<Model> StreamDecoder::model() const {
  Model out;
  out.scene = parser_.strips().scene;
  for (const DisplayLevel& shown : levels_) {
    Result<Mesh> mesh = decoded_mesh(shown.level());
    if (!mesh) return tl::unexpected(mesh.error());
    out.meshes.push_back(std::move(mesh).value());
  }
  return out;
}

}  // namespace pstrips::inline converters
