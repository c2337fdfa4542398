// How tight the error bounds of levels are: what is promised over what is measured, and what a
// collapse costs beside choosing it.
//
//   bounds_bench [--samples N] [MODEL …]   paths in the folder of models

#include <fmt/format.h>

#include <cstdlib>
#include <ctime>
#include <limits>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "codecs/measure/error_bounds.h"
#include "codecs/measure/measure.h"
#include "codecs/simplify/simplify.h"
#include "codecs/triangulate/triangulate.h"
#include "tests/support/models.h"

namespace pstrips::bench {
namespace {

constexpr double kShares[] = {0.5, 0.2, 0.05, 0.01};

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Shape {
  std::vector<double> positions;
  std::vector<Index> triangles;
};

Shape level_of(const Shape& source, const CollapseSequence& sequence, std::size_t collapses) {
  Shape out{source.positions, {}};
  std::vector<Index> stands_for(source.positions.size() / 3);
  std::iota(stands_for.begin(), stands_for.end(), Index{0});
  for (std::size_t i = collapses; i-- > 0;)
    stands_for[sequence.collapses[i].removed] = stands_for[sequence.collapses[i].kept];
  if (!sequence.placements.empty())
    for (std::size_t i = 0; i < 3 * collapses; ++i)
      out.positions[std::size_t{3} * sequence.collapses[i / 3].kept + i % 3] =
          sequence.placements[i];
  for (std::size_t t = 0; t < source.triangles.size(); t += 3) {
    const Index a = stands_for[source.triangles[t]], b = stands_for[source.triangles[t + 1]],
                c = stands_for[source.triangles[t + 2]];
    if (a != b && b != c && a != c) out.triangles.insert(out.triangles.end(), {a, b, c});
  }
  return out;
}

void run(const std::string& model, const Shape& source, Placement placement, Metric metric,
         std::uint64_t samples) {
  double start = cpu_seconds();
  const CollapseSequence sequence = simplify({source.positions, {}, source.triangles, {}, {}, 0},
                                             {.target_triangles = source.triangles.size() / 300,
                                              .placement = placement,
                                              .metric = metric});
  const double simplify_seconds = cpu_seconds() - start;
  CollapsedSurface surface{{}, source.triangles, sequence.collapses, sequence.placements};
  for (std::size_t i = 0; i < source.positions.size(); i += 3)
    surface.positions.push_back(
        {source.positions[i], source.positions[i + 1], source.positions[i + 2]});
  start = cpu_seconds();
  const std::vector<ErrorBounds> bounds = error_bounds(std::move(surface));
  const double seconds = cpu_seconds() - start;
  const double collapses = static_cast<double>(sequence.collapses.size());
  fmt::print("{:24} {} {}: {:.2f} µs a collapse to simplify, {:.2f} to bound\n", model,
             placement == Placement::subset ? "subset " : "optimal",
             metric == Metric::qem ? "qem" : "memoryless", simplify_seconds / collapses * 1e6,
             seconds / collapses * 1e6);
  const double all = static_cast<double>(source.triangles.size() / 3);
  const double diagonal = bounding_box_diagonal(source.positions);
  for (const double share : kShares) {
    std::size_t low = 0, high = sequence.collapses.size();
    while (low < high) {
      const std::size_t middle = (low + high) / 2;
      if (static_cast<double>(level_of(source, sequence, middle).triangles.size() / 3) >
          share * all)
        low = middle + 1;
      else
        high = middle;
    }
    const Shape level = level_of(source, sequence, low);
    const Distance d = measure_distance({source.positions, source.triangles},
                                        {level.positions, level.triangles}, samples);
    const ErrorBounds& b = bounds[low];
    fmt::print(
        "  {:4.0f} %: two-sided {:.3e} of diagonal, measured {:.3e}, {:.2f} times;"
        " one-sided {:.3e}, measured {:.3e}, {:.2f} times; estimate {:.2f} times\n",
        100 * share, b.two_sided / diagonal, d.hausdorff / diagonal, b.two_sided / d.hausdorff,
        b.one_sided / diagonal, d.a_to_b.maximum / diagonal, b.one_sided / d.a_to_b.maximum,
        low > 0 ? sequence.collapses[low - 1].error / d.hausdorff : 0);
  }
}

int main(std::vector<std::string> models) {
  std::uint64_t samples = 1'000'000;
  if (models.size() >= 2 && models[0] == "--samples") {
    samples = std::strtoull(models[1].c_str(), nullptr, 10);
    models.erase(models.begin(), models.begin() + 2);
  }
  if (models.empty())
    models = {"classic/bun_zipper.ply", "classic/horse.ply",        "classic/igea.ply",
              "classic/fandisk.obj",    "classic/turbineblade.ply", "classic/nefertiti.obj"};
  for (const std::string& name : models) {
    const std::optional<Mesh> mesh = test::model_mesh(name);
    if (!mesh) {
      fmt::print(stderr, "{}: not there\n", name);
      return 1;
    }
    Shape source{positions_as_double(*mesh), {}};
    for (const Index w : triangulate(*mesh).corners) source.triangles.push_back(mesh->vertex_of(w));
    run(name, source, Placement::subset, Metric::qem, samples);
    run(name, source, Placement::optimal, Metric::memoryless, samples);
  }
  return 0;
}

}  // namespace
}  // namespace pstrips::bench

int main(int argc, char** argv) { return pstrips::bench::main({argv + 1, argv + argc}); }
