#include "converters/encode.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <queue>
#include <span>
#include <utility>

#include "codecs/compact/record_batches.h"
#include "codecs/stripify/stripify.h"
#include "codecs/triangulate/triangulate.h"
#include "codecs/vsplit/record.h"
#include "converters/capacity.h"
#include "converters/level_bounds.h"
#include "converters/level_cost.h"
#include "converters/packets.h"
#include "converters/position_grid.h"
#include "converters/scene_level.h"
#include "converters/strip_mesh.h"
#include "converters/welded_mesh.h"
#include "core/equal_elements.h"
#include "core/gather.h"
#include "core/parallel.h"
#include "formats/ply/ply.h"
#include "formats/pstrip/payload/check.h"

namespace pstrips::inline converters {
namespace {

// How much a difference of an attribute counts against a displacement, as a share of the
// bounding-box diagonal a full swing of it costs; a swing is the range of UVs and colours and the
// unit length of normals. By pictures of textured models (tests/bench/textured_bench): with four
// times as much for normals they look no better, and outlines are a seventh worse.
double attribute_weight(std::string_view semantic, const EncodeOptions& options) {
  const std::string_view unnumbered = semantic.substr(0, semantic.find_last_of('_'));
  for (const std::string_view name : {semantic, unnumbered})
    for (const AttributeWeight& w : options.attribute_weights)
      if (w.semantic == name) return w.weight;
  if (semantic == "NORMAL") return 0.005;
  if (semantic.starts_with("TEXCOORD_")) return 0.2;
  if (semantic.starts_with("COLOR_")) return 0.1;
  return 0;
}

constexpr double kBaseShare = 0.05, kCompactBaseShare = 0.1;
// Batches that leave less than this of a packet to the base. So a base gets larger by a tenth at
// most, which is left free for it.
constexpr double kLeastShareOfBatch = 0.5, kTargetOfBase = 0.9;

// So many triangles of a base go to components that would vanish otherwise.
constexpr std::uint64_t kMostOfComponents = 400;

// Cells that lie around zero show as zero, others as their middle: off by a step on each axis.
constexpr double kBlur = 1.7320508075688773;

struct AttributeTable {
  std::vector<float> values;
  std::uint32_t count = 0;
  std::uint32_t texture = kNone;  ///< column of the first texture coordinates
};

AttributeTable attributes_for_simplify(const Mesh& mesh, const EncodeOptions& options) {
  struct Column {
    const Attribute* attribute;
    std::size_t component;
    double scale;
  };
  AttributeTable out;
  std::vector<Column> columns;
  for (const Attribute& a : mesh.wedge_attributes) {
    const double weight = attribute_weight(a.semantic, options);
    if (weight == 0) continue;
    double low = 0, high = 0;  // over all components, so that UVs are not stretched
    for (std::size_t w = 0; w < a.elements(); ++w)
      for (std::size_t c = 0; c < a.count; ++c) {
        const double v = component(a, w, c);
        if (!std::isfinite(v)) continue;
        low = std::min(low, v);
        high = std::max(high, v);
      }
    const double range = a.semantic == "NORMAL" ? 1 : high - low;
    if (!(range > 0)) continue;
    if (out.texture == kNone && a.semantic.starts_with("TEXCOORD_") && a.count == 2)
      out.texture = static_cast<std::uint32_t>(columns.size());
    for (std::size_t c = 0; c < a.count; ++c) columns.push_back({&a, c, weight / range});
  }
  out.count = static_cast<std::uint32_t>(columns.size());
  out.values.resize(std::size_t{out.count} * mesh.wedge_count());
  for (std::size_t k = 0; k < columns.size(); ++k)
    for (std::size_t w = 0; w < mesh.wedge_count(); ++w) {
      const double v = component(*columns[k].attribute, w, columns[k].component) * columns[k].scale;
      out.values[w * out.count + k] = std::isfinite(v) ? static_cast<float>(v) : 0.f;
    }
  return out;
}

CollapseSequence choose_collapses(const Mesh& mesh, const Triangulation& triangles,
                                  const EncodeOptions& options, SimplifyOptions simplify_options,
                                  const Progress& progress) {
  const std::vector<double> positions = positions_as_double(mesh);
  std::vector<Index> group;
  if (!mesh.face_group.empty())
    for (const Index f : triangles.face) group.push_back(mesh.group_of(f));
  const AttributeTable attributes = attributes_for_simplify(mesh, options);
  return simplify({.positions = positions,
                   .wedge_vertex = mesh.wedge_vertex,
                   .triangles = triangles.corners,
                   .group = group,
                   .attributes = attributes.values,
                   .attribute_count = attributes.count,
                   .texture = attributes.texture},
                  simplify_options, progress);
}

struct Encoded {
  ProgressiveMesh mesh;
  Packet base;
  std::vector<Packet> packets;
  std::optional<SimplifyReport> report;  // when the collapses were chosen
};

// Progress of meshes that are encoded side by side, reported by one thread at a time.
class SharedProgress {
 public:
  SharedProgress(const Progress& progress, std::size_t meshes)
      : progress_(progress), done_(meshes, 0) {}

  /// False once the listener has said so to anybody.
  bool go_on(std::string_view stage, Index mesh, double done) {
    if (!progress_) return true;
    const std::lock_guard lock(mutex_);
    sum_ += done - std::exchange(done_[mesh], done);
    const double share = std::clamp(sum_ / static_cast<double>(done_.size()), 0.0, 1.0);
    stopped_ = stopped_ || !progress_(stage, share);  // for good
    return !stopped_;
  }

 private:
  const Progress& progress_;
  std::mutex mutex_;
  std::vector<double> done_;
  double sum_ = 0;
  bool stopped_ = false;
};

// A recording, and what its packets are made by.
struct Recorded {
  Recording recording;
  std::vector<ErrorBounds> bounds;  // by collapses done, which the vsplits undo from the last on
  std::vector<Index> batches;       // of vsplits, where these are in batches
};

tl::unexpected<Error> interrupted() { return fail(ErrorCode::interrupted, "interrupted"); }

class Encoder {
 public:
  Encoder(const Model& model, const EncodeOptions& options, const Progress& progress,
          std::vector<SimplifyReport>* reports = nullptr)
      : model_(model),
        options_(options),
        progress_(progress, model.meshes.size()),
        reports_(reports),
        keeps_order_(options.keep_order || has_rows_bound_to_order(model.scene)) {}

  Result<ProgressiveStrips> run(const std::vector<CollapseSequence>* given) {
    stripifier_ = find_stripifier(options_.stripifier);
    if (!stripifier_)
      return fail(ErrorCode::bad_argument, "unknown stripifier " + options_.stripifier);
    for (std::size_t m = 0; m < model_.meshes.size(); ++m) {
      const std::string wrong = find_inconsistency(model_.meshes[m]);
      if (!wrong.empty())
        return fail(ErrorCode::bad_argument, "mesh " + std::to_string(m) + ": " + wrong);
      const WorkSize size = work_size(model_.meshes[m]);
      if (auto ok = check_capacity(size, options_.memory_bytes); !ok)
        return fail(ErrorCode::over_limit, ok.error().message, kNoOffset,
                    "/meshes/" + std::to_string(m));
      bytes_.push_back(encoding_bytes(size));
    }
    if (const auto ok = choose_grid(); !ok) return tl::unexpected(ok.error());
    choose_share();
    std::vector<Result<Encoded>> results = encode_meshes(given);
    std::vector<Encoded> encoded;
    for (Result<Encoded>& result : results) {
      if (!result) return tl::unexpected(result.error());
      if (reports_ && result->report) reports_->push_back(*std::move(result->report));
      encoded.push_back(std::move(result).value());
    }
    return join(std::move(encoded));
  }

 private:
  bool is_compact() const { return options_.profile == Profile::compact; }
  bool maps_triangles() const {
    return is_compact() || options_.encoding == MapEncoding::triangles;
  }
  // Of the collapses that are chosen: middles are between vertices, whatever an edge's best place
  // is.
  Placement placement() const { return is_compact() ? Placement::subset : options_.placement; }
  bool chooses_batches() const { return maps_triangles() && placement() == Placement::subset; }
  // Of the compact profile, and nobody asked for another one.
  bool has_default_base() const {
    return is_compact() && !options_.base_share && !options_.base_triangles && !options_.base_error;
  }
  BatchOptions batch_options(bool given) const {
    constexpr double kPlainWindow = 2;  // for sequences that do not fall into batches
    BatchOptions out{.schedule = BatchSchedule::of(options_.order)};
    if (given || !chooses_batches()) out.window = kPlainWindow;
    if (has_default_base()) out.least_share = kLeastShareOfBatch;
    return out;
  }
  bool is_on_grid() const { return options_.position_bits > 0; }
  bool is_quantized() const { return is_on_grid() || options_.attribute_bits.any(); }

  Result<void> choose_grid() {
    if (is_on_grid() && (!is_compact() || options_.position_bits < kMinPositionBits ||
                         options_.position_bits > kMaxPositionBits))
      return fail(ErrorCode::bad_argument,
                  is_compact() ? "position bits are 8 to 24"
                               : "only the compact profile puts positions on a grid");
    const AttributeBits& bits = options_.attribute_bits;
    if (bits.any() && (!is_compact() || !bits.is_valid()))
      return fail(ErrorCode::bad_argument,
                  is_compact() ? "attribute bits are 4 to 23, of normals to 16"
                               : "only the compact profile puts attributes on a grid");
    if (!is_compact()) return {};
    attribute_grids_ = AttributeGrids(model_, bits);
    const auto grid = position_grid(model_, options_.position_bits);
    if (!grid) return tl::unexpected(grid.error());
    grid_ = *grid;
    return {};
  }

  // A total of triangles is shared out in proportion.
  void choose_share() {
    share_ = options_.base_share.value_or(is_compact() ? kCompactBaseShare : kBaseShare);
    if (!options_.base_triangles) return;
    std::uint64_t all = 0;
    for (const Mesh& mesh : model_.meshes) all += triangulate(mesh).face.size();
    share_ = all ? static_cast<double>(*options_.base_triangles) / static_cast<double>(all) : 0;
  }

  std::uint64_t base_triangles(std::uint64_t triangles) const {
    if (options_.base_error) return 0;
    const auto share = static_cast<std::uint64_t>(share_ * static_cast<double>(triangles));
    if (!has_default_base()) return share;
    return static_cast<std::uint64_t>(kTargetOfBase *
                                      static_cast<double>(std::min(share, kCompactBaseTriangles)));
  }

  // A base that nobody asked for can be drawn: of a small mesh every component is there.
  bool keeps_components(const Triangulation& triangles) const {
    constexpr std::size_t kSmall = 20'000;
    return !options_.base_share && !options_.base_triangles && !options_.base_error &&
           triangles.face.size() <= kSmall;
  }

  // The meshes side by side, the largest first so that none is left for the end; those of which not
  // as many as there are threads fit into the memory granted one after the other before. A mesh
  // that is more than one thread's share of the work may use all threads inside, others one.
  std::vector<Result<Encoded>> encode_meshes(const std::vector<CollapseSequence>* given) {
    const unsigned threads = thread_count(options_.threads);
    const std::uint64_t share =
        std::accumulate(bytes_.begin(), bytes_.end(), std::uint64_t{0}) / threads;
    std::vector<Result<Encoded>> out(bytes_.size());
    const auto encode_one = [&](Index m) {
      out[m] = encode_mesh(m, given ? &(*given)[m] : nullptr, bytes_[m] > share ? threads : 1);
    };
    std::vector<Index> by_size(bytes_.size());
    std::iota(by_size.begin(), by_size.end(), Index{0});
    std::ranges::stable_sort(by_size, std::ranges::greater{}, [&](Index m) { return bytes_[m]; });
    const auto fits = std::ranges::find_if(
        by_size, [&](Index m) { return bytes_[m] <= options_.memory_bytes / threads; });
    std::for_each(by_size.begin(), fits, encode_one);
    parallel_for(
        threads, static_cast<std::size_t>(by_size.end() - fits), 1,
        [&](std::size_t i, std::size_t) { encode_one(fits[static_cast<std::ptrdiff_t>(i)]); });
    return out;
  }

  Result<Encoded> encode_mesh(Index m, const CollapseSequence* given, unsigned threads) {
    Mesh on_grid;
    SimplifyReport report;
    if (is_quantized()) {
      on_grid = model_.meshes[m];
      if (is_on_grid()) report.moved = move_to_grid(on_grid, grid_);
      report.quantized = attribute_grids_.apply(on_grid);
    }
    const WeldedMesh welded(is_quantized() ? on_grid : model_.meshes[m], model_.meshes[m],
                            given ? std::nullopt : options_.weld);
    const Mesh& mesh = welded.mesh();
    const Triangulation triangles = triangulate(mesh);
    if (!progress_.go_on("simplify", m, 0)) return interrupted();
    CollapseSequence sequence;
    std::vector<ErrorBounds> bounds;
    if (given) {
      sequence = *given;
      if (is_compact() && !sequence.placements.empty())
        place_in_the_middle(mesh, grid_of(mesh), sequence);
    } else {
      sequence = choose(m, mesh, triangles, threads);
      if (sequence.stop == SimplifyStop::interrupted) return interrupted();
      if (options_.base_error) {
        bounds = level_bounds(mesh, triangles, sequence, *options_.base_error);
        cut_back(mesh, triangles, *options_.base_error, sequence, bounds);
      }
    }
    if (!progress_.go_on("bounds", m, 0.5)) return interrupted();
    Result<Recorded> recorded =
        maps_triangles()
            ? record_triangles(m, welded, triangles, batch_options(given), sequence)
            : record_strips(m, welded, triangles, sequence, std::move(bounds), threads);
    if (!recorded) return tl::unexpected(recorded.error());
    Encoded out = packed(m, std::move(recorded).value());
    if (given) return out;
    report.mesh = mesh.name;
    report.triangles = triangles.face.size();
    report.base_triangles = out.base.triangles;
    report.stop = sequence.stop;
    report.refused = sequence.refused;
    report.forced = sequence.forced;
    out.report = std::move(report);
    return out;
  }

  CollapseSequence choose(Index m, const Mesh& mesh, const Triangulation& triangles,
                          unsigned threads) {
    CollapseSequence out = choose_collapses(
        mesh, triangles, options_,
        {.target_triangles = base_triangles(triangles.face.size()),
         .component_triangles = keeps_components(triangles) ? kMostOfComponents : 0,
         .placement = placement(),
         .metric = options_.metric,
         .in_batches = chooses_batches(),
         .order = is_compact() ? options_.order : CollapseOrder::error,
         .threads = threads},
        [&](std::string_view stage, double done) { return progress_.go_on(stage, m, 0.5 * done); });
    if (is_compact() && options_.placement == Placement::optimal)
      place_in_the_middle(mesh, grid_of(mesh), out);
    return out;
  }

  Encoded packed(Index m, Recorded recorded) const {
    const PositionGrid& grid = recorded.recording.mesh.grid;
    Encoded out;
    out.packets = packets_of(recorded.recording, recorded.bounds, m,
                             {.batches = recorded.batches,
                              .growth = options_.packet_growth,
                              .least = options_.packet_min,
                              .blur = grid.exact ? 0 : kBlur * double{grid.step}});
    out.base = out.packets.front();
    out.packets.erase(out.packets.begin());
    out.mesh = std::move(recorded.recording.mesh);
    return out;
  }

  // bounds  of the sequence, unless empty
  Result<Recorded> record_strips(Index m, const WeldedMesh& welded, const Triangulation& triangles,
                                 const CollapseSequence& sequence, std::vector<ErrorBounds> bounds,
                                 unsigned threads) {
    // Of large meshes one after the other: both together take more memory than all else.
    constexpr std::uint64_t kLargeBytes = 1 << 27;
    Result<Recording> recorded = interrupted();
    parallel_invoke(
        bytes_[m] <= kLargeBytes ? threads : 1,
        [&] {
          if (bounds.empty()) bounds = level_bounds(welded.mesh(), triangles, sequence);
        },
        [&] { recorded = record_mesh(m, welded, triangles, sequence, threads); });
    if (!recorded) return tl::unexpected(recorded.error());
    return Recorded{std::move(recorded).value(), std::move(bounds), {}};
  }

  // Batches put the collapses into another order, whose bounds may be larger: then it takes fewer.
  Result<Recorded> record_triangles(Index m, const WeldedMesh& welded,
                                    const Triangulation& triangles, const BatchOptions& batches,
                                    CollapseSequence& sequence) {
    if (triangles.corners.size() > kMaxCount)
      return fail(ErrorCode::over_limit, "more index-map entries than a mesh can have");
    const Mesh& mesh = welded.mesh();
    constexpr double kStricter = 0.98;  // from time to time, so that it ends soon
    double most = options_.base_error.value_or(std::numeric_limits<double>::infinity());
    while (true) {
      BatchRecording made = record_batches(mesh, triangles, sequence, batches);
      if (!progress_.go_on("record", m, 0.75)) return interrupted();
      std::vector<ErrorBounds> bounds = level_bounds(mesh, triangles, made.collapses);
      if (options_.base_error && bounds.back().two_sided > *options_.base_error) {
        cut_back(mesh, triangles, most, made.collapses, bounds);
        sequence.collapses = std::move(made.collapses.collapses);
        sequence.placements = std::move(made.collapses.placements);
        sequence.stop = SimplifyStop::max_error;
        most *= kStricter;
        continue;
      }
      if (is_compact()) made.recording.mesh.grid = grid_of(mesh);
      if (is_compact()) made.recording.mesh.effort = options_.effort;
      welded.complete(triangles, made.map, keeps_order_, made.recording);
      return Recorded{std::move(made.recording), std::move(bounds), std::move(made.batches)};
    }
  }

  PositionGrid grid_of(const Mesh& mesh) const {
    const ComponentType type = mesh.position.type;
    return type == ComponentType::f32 || type == ComponentType::f64 ? grid_
                                                                    : integer_grid(mesh.position);
  }

  Result<Recording> record_mesh(Index m, const WeldedMesh& welded, const Triangulation& triangles,
                                const CollapseSequence& sequence, unsigned threads) {
    if (!progress_.go_on("stripify", m, 0.65)) return interrupted();
    const Mesh& mesh = welded.mesh();
    const StripMap strips = strip_mesh(mesh, triangles, *stripifier_, options_.strip_options,
                                       step_cost_of(mesh, triangles, sequence, threads));
    if (strips.entries.size() > kMaxCount)
      return fail(ErrorCode::over_limit, "more index-map entries than a mesh can have");
    if (!progress_.go_on("record", m, 0.85)) return interrupted();
    Recording recording = record(mesh, strips, sequence, options_.encoding);
    welded.complete(triangles, strips, keeps_order_, recording);
    return recording;
  }

  std::vector<std::uint8_t> step_cost_of(const Mesh& mesh, const Triangulation& triangles,
                                         const CollapseSequence& sequence, unsigned threads) const {
    if (options_.level_cost == 0) return {};
    std::vector<Index> vertices;
    vertices.reserve(triangles.corners.size());
    for (const Index wedge : triangles.corners) vertices.push_back(mesh.vertex_of(wedge));
    return level_step_cost(vertices, mesh.vertex_count(), sequence.collapses,
                           static_cast<std::uint8_t>(std::min(options_.level_cost, kMaxLevelCost)),
                           threads);
  }

  Result<ProgressiveStrips> join(std::vector<Encoded> encoded) const {
    ProgressiveStrips out;
    out.generator = "pstrips";
    out.profile = options_.profile;
    out.scene = model_.scene;
    for (Index m = 0; m < encoded.size(); ++m) {
      out.bases.push_back(encoded[m].base);
      out.meshes.push_back(std::move(encoded[m].mesh));
    }
    FirstFault faults;
    if (!check_scene(out, faults)) {
      Error error = error_of(*faults.first());
      error.code = ErrorCode::bad_argument;
      return tl::unexpected<Error>(std::move(error));
    }
    // The mesh whose error is largest where it stands gets the next packet.
    const std::vector<double> scale = instance_scales(out.scene, encoded.size());
    struct Next {
      double error;
      Index mesh;
      bool operator<(const Next& other) const {
        return error != other.error ? error < other.error : mesh > other.mesh;
      }
    };
    std::priority_queue<Next> queue;
    std::vector<std::size_t> taken(encoded.size(), 0);
    for (Index m = 0; m < encoded.size(); ++m) {
      if (!encoded[m].packets.empty())
        queue.push({SceneLevel::scaled_error(out.bases[m], scale[m]), m});
    }
    while (!queue.empty()) {
      const Index m = queue.top().mesh;
      queue.pop();
      out.packets.push_back(encoded[m].packets[taken[m]++]);
      if (taken[m] < encoded[m].packets.size())
        queue.push({SceneLevel::scaled_error(out.packets.back(), scale[m]), m});
    }
    return out;
  }

  const Model& model_;
  const EncodeOptions& options_;
  SharedProgress progress_;
  std::vector<SimplifyReport>* reports_;
  std::vector<std::uint64_t> bytes_;  // that each mesh takes to encode
  const NamedStripifier* stripifier_ = nullptr;
  double share_ = 0;
  const bool keeps_order_;
  AttributeGrids attribute_grids_;
  PositionGrid grid_;  // of positions that are floats, in the compact profile
};

struct JoinedWedges {
  std::vector<Index> kept;  ///< the first wedge of each set of equal ones, ascending
  std::vector<Index> to;    ///< for each wedge, where its set stands in `kept`
};

// Wedges are equal that stand at one vertex with the same bytes in every attribute.
JoinedWedges join_equal_wedges(const Mesh& mesh) {
  std::size_t row_bytes = sizeof(Index);
  for (const Attribute& a : mesh.wedge_attributes) row_bytes += a.element_bytes();
  Bytes rows;
  rows.reserve(row_bytes * mesh.wedge_count());
  const auto append = [&](ByteView bytes) { rows.insert(rows.end(), bytes.begin(), bytes.end()); };
  for (Index w = 0; w < mesh.wedge_count(); ++w) {
    const Index vertex = mesh.vertex_of(w);
    append(std::as_bytes(std::span(&vertex, 1)));
    for (const Attribute& a : mesh.wedge_attributes) append(a.element(w));
  }
  const std::vector<Index> first = first_equals(rows, row_bytes, 1);  // of each wedge's set
  JoinedWedges out;
  out.to.resize(first.size());
  for (Index w = 0; w < first.size(); ++w) {
    if (first[w] == w) out.kept.push_back(w);
    out.to[w] = first[w] == w ? static_cast<Index>(out.kept.size() - 1) : out.to[first[w]];
  }
  return out;
}

}  // namespace

Result<ProgressiveStrips> encode(const Model& model, const EncodeOptions& options,
                                 const Progress& progress, std::vector<SimplifyReport>* reports) {
  return Encoder(model, options, progress, reports).run(nullptr);
}

Result<ProgressiveStrips> encode_with(const Model& model,
                                      const std::vector<CollapseSequence>& collapses,
                                      const EncodeOptions& options, const Progress& progress) {
  if (collapses.size() != model.meshes.size())
    return fail(ErrorCode::bad_argument, "not one collapse sequence a mesh");
  return Encoder(model, options, progress).run(&collapses);
}

void keep_attributes(Model& model, const std::vector<std::string>& semantics) {
  for (Mesh& mesh : model.meshes) {
    std::erase_if(mesh.wedge_attributes, [&](const Attribute& a) {
      return std::ranges::find(semantics, a.semantic) == semantics.end();
    });
    std::erase_if(mesh.face_attributes, [&](const Attribute& a) {
      return std::ranges::find(semantics, a.semantic) == semantics.end();
    });
    const auto [kept, to] = join_equal_wedges(mesh);
    std::vector<Index> wedge_vertex(kept.size());
    for (std::size_t i = 0; i < kept.size(); ++i) wedge_vertex[i] = mesh.vertex_of(kept[i]);
    for (Attribute& a : mesh.wedge_attributes) a = gather(a, kept);
    mesh.wedge_vertex = std::move(wedge_vertex);
    for (Index& w : mesh.corners) w = to[w];
    // Wedges of a vertex need not be in vertex order; with none but positions they can be.
    if (mesh.wedge_attributes.empty()) {
      for (Index& w : mesh.corners) w = mesh.wedge_vertex[w];
      mesh.wedge_vertex.clear();
    }
    canonicalize(mesh);
  }
}

}  // namespace pstrips::inline converters
