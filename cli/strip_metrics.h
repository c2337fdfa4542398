#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "codecs/stripify/stats.h"
#include "codecs/stripify/stripify.h"
#include "codecs/vsplit/record.h"
#include "core/mesh.h"
#include "core/scene.h"

namespace pstrips::cli {

/// How the heap is measured, for a program that counts what operator new hands out. Empty: not at
/// all.
struct HeapMeter {
  std::function<void()> start;
  std::function<std::size_t()> peak;  ///< bytes, the largest since start()
  explicit operator bool() const { return start && peak; }
};

/// What a stripifier made of a model, all meshes together.
struct StripMetrics {
  StripStats stats;
  double milliseconds = 0;
  double cpu_milliseconds = 0;  ///< processor time: what else the machine does counts little
  std::size_t peak_bytes =
      0;  ///< largest heap of any one mesh's run, its result included; 0 without a meter
  std::string fault;  ///< what the strips miss of a stripification; empty: nothing

  double indices_per_triangle() const {
    return stats.triangles == 0
               ? 0
               : static_cast<double>(stats.indices_sent) / static_cast<double>(stats.triangles);
  }
};

/// Runs a stripifier on every mesh of a model and checks what it gives.
///
/// maps  receives the strips of each mesh when given
StripMetrics measure_strips(const Model& model, const NamedStripifier& stripifier,
                            const StripOptions& options, const HeapMeter& heap = {},
                            std::vector<StripMap>* maps = nullptr);

/// The same for a stripifier of points: those of each mesh, whatever faces it has.
/// Precondition: no mesh has more than kMaxDelaunayPoints wedges.
StripMetrics measure_point_strips(const Model& model, const NamedPointStripifier& stripifier,
                                  const StripOptions& options,
                                  std::vector<StripMap>* maps = nullptr);

}  // namespace pstrips::cli
