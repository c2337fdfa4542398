#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "codecs/filter/display_level.h"
#include "converters/scene_level.h"
#include "core/limits.h"
#include "core/scene.h"
#include "formats/pstrip/container/binary.h"

namespace pstrips::inline converters {

/// Decodes a binary progressive file while it arrives: feed bytes, show the level reached.
///
///     StreamDecoder decoder;
///     while (more) { decoder.feed(bytes); if (decoder.update()) draw(decoder); }
///
/// Each call costs what it brings: a packet's vsplits, and the filtering of the strips that they
/// rewrote; where strips are derived, update() takes O(level). Any prefix of a valid file is shown
/// up to its last whole packet. [spec/container.md §9]
class StreamDecoder {
 public:
  explicit StreamDecoder(const Limits& limits = {}, Filter filter = Filter::dtfs);
  StreamDecoder(const StreamDecoder&) = delete;
  StreamDecoder& operator=(const StreamDecoder&) = delete;

  /// Takes the next bytes and applies every packet that they complete.
  ///
  /// errors  as BinaryParser; the first one stays, and what was reached before it can be shown
  Result<void> feed(ByteView bytes);

  bool has_base() const { return parser_.has_base(); }  ///< level 0 can be shown
  bool complete() const { return parser_.complete(); }  ///< the whole file is there
  /// What to answer when no more bytes come: truncated, or nothing when complete.
  std::optional<Error> end() const { return parser_.end(); }
  std::size_t packets() const { return packets_; }  ///< applied so far, of header()->packets
  /// Grows with each change of what is shown.
  std::size_t changes() const { return packets_ + completed_; }
  const std::optional<FileHeader>& header() const { return parser_.header(); }
  std::uint64_t bytes_taken() const { return parser_.bytes_taken(); }
  const ProgressiveStrips& strips() const { return parser_.strips(); }

  /// What the level shows now, all meshes together.
  struct Totals {
    std::uint64_t vertices = 0, triangles = 0;
    std::uint64_t strips = 0;  ///< those that are derived as of the last update()
    double error = 0;          ///< see SceneLevel
  };
  Totals totals() const;

  /// Filters the strips that have changed since the last call, or derives those of meshes that have
  /// changed. True when there is something new to draw: once there is a base, after each packet,
  /// and when what follows them completes the numbers of a mesh.
  bool update();
  /// The level of a mesh and its display strips as of the last update().
  /// Precondition: has_base().
  const DisplayLevel& mesh(Index i) const { return levels_[i]; }

  /// The meshes as they are now. Precondition: has_base().
  /// errors  as decode()
  Result<Model> model() const;

 private:
  BinaryParser parser_;
  Filter filter_;
  std::deque<DisplayLevel> levels_;  // they do not move
  std::optional<SceneLevel> now_;    // from the last base on
  std::size_t packets_ = 0;
  std::size_t completed_ = 0;              // meshes whose numbers are
  std::optional<std::size_t> updated_to_;  // changes(); nothing before there is a base
};

}  // namespace pstrips::inline converters
