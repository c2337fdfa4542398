#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/pstrip/payload/compact/mixed_chord_weights.h"
#include "formats/pstrip/payload/compact/mixed_number.h"

namespace pstrips::inline formats {

/// All that is learned with the effort `small`, beside what the effort `fast` learns; the same on
/// both sides.
struct MixedModels {
  explicit MixedModels(Placement placement) : chord(placement) {}

  /// What is kept of a vertex.
  struct VertexTrace {
    std::uint32_t batch = 0;  ///< in which it split last or came
    std::uint8_t off = 0;     ///< how far steps were off along the surface, quarter octaves
  };
  std::vector<VertexTrace> trace;

  void start_batch() {
    ++batch;
    usual_length = visits > 0 ? static_cast<unsigned>(lengths / visits) : 0;
    lengths = visits = 0;
  }
  /// A vertex split: of the other one as much is known.
  void follow(Index vertex, Index added) {
    trace[vertex].batch = batch;
    trace[added] = trace[vertex];
  }

  // Of batches, the base's is 0.
  std::uint32_t batch = 0;
  std::uint64_t lengths = 0, visits = 0;  ///< in this batch: mean lengths of rings, vertices
  unsigned usual_length = 0;              ///< in the batch before, quarter octaves

  static constexpr unsigned kGuesses = 5;
  std::array<std::vector<MixedCounter>, kGuesses> splits = {
      std::vector<MixedCounter>(256), std::vector<MixedCounter>(384),
      std::vector<MixedCounter>(1024), std::vector<MixedCounter>(512),
      std::vector<MixedCounter>(960)};
  Mixer<kGuesses> splits_mixer{32, 64};

  std::array<BitModel, 2> long_form;  ///< ring closed, open
  MixedChordWeights chord;
  std::array<MixedNumberModel, 2> tangential = {MixedNumberModel({1, 1, 36, 8}, true),
                                                MixedNumberModel({1, 1, 36, 8}, true)};
  MixedNumberModel normal{{1, 1, 16, 16}, false};
};

}  // namespace pstrips::inline formats
