#include "converters/files.h"

#include <algorithm>
#include <filesystem>

#include "converters/file_io.h"
#include "converters/placement.h"
#include "formats/medit/medit.h"

namespace pstrips::inline converters {
namespace {

// A companion that another file stands in the way of, unless it is the same file.
Result<void> check_companions(const FileSet& set) {
  for (std::size_t i = 1; i < set.files.size(); ++i) {
    const auto& [path, bytes, write] = set.files[i];
    if (!std::filesystem::exists(path)) continue;
    const bool is_file = std::filesystem::is_regular_file(path);
    const auto there = is_file ? read_file(path) : Result<FileBytes>();
    if (!there) return tl::unexpected(there.error());
    if (!is_file || !std::ranges::equal(there->view(), bytes))
      return fail(ErrorCode::io, "is there already and would be replaced", kNoOffset, path);
  }
  return {};
}

// Passes on what is written and counts it.
class CountingSink final : public ByteSink {
 public:
  CountingSink(ByteSink& out, std::uint64_t& bytes) : out_(out), bytes_(bytes) {}
  Result<void> write(ByteView bytes) override {
    bytes_ += bytes.size();
    return out_.write(bytes);
  }

 private:
  ByteSink& out_;
  std::uint64_t& bytes_;
};

WriteBytes counted(const WriteBytes& write, std::uint64_t& bytes) {
  return [&write, &bytes](ByteSink& out) {
    CountingSink counting(out, bytes);
    return write(counting);
  };
}

Result<SavedFiles> write(Result<FileSet> set, const SaveOptions& options) {
  if (!set) return tl::unexpected(set.error());
  SavedFiles out;
  out.notes = options.dropped_before;
  out.notes.insert(out.notes.end(), set->notes.begin(), set->notes.end());
  out.converted = std::move(set->converted);
  if (options.strict && !out.notes.empty()) return out;
  if (!options.replace_companions)
    if (const auto free = check_companions(*set); !free) return tl::unexpected(free.error());
  std::vector<OutputFile> views;
  for (const FileSet::File& file : set->files) out.files.push_back({file.path, file.bytes.size()});
  for (std::size_t i = 0; i < set->files.size(); ++i) {
    const FileSet::File& file = set->files[i];
    OutputFile& view = views.emplace_back(OutputFile{file.path, file.bytes});
    if (file.write) view.write = counted(file.write, out.files[i].bytes);
  }
  if (auto done = write_files(views); !done) return tl::unexpected(done.error());
  return out;
}

tl::unexpected<Error> not_written(FileFormat format, std::string_view what) {
  std::string message(row_of(format).title);
  return fail(ErrorCode::bad_argument, message.append(" is not written from ").append(what));
}

}  // namespace

Result<Model> LoadedFile::model(const LevelChoice& choice) && {
  if (auto* model = std::get_if<Model>(&content)) return std::move(*model);
  ProgressiveStrips strips = std::move(std::get<ProgressiveStrips>(content));
  content = Model{};
  const std::size_t packets = packets_for(strips, choice);
  return decode(std::move(strips), packets);
}

Result<LoadedFile> load(const FileBytes& file, const std::string& path,
                        const LoadOptions& options) {
  const auto format = detect_format(file.view(), path);
  if (!format)
    return fail(ErrorCode::unsupported, "is of no known format; known are " + readable_formats(),
                kNoOffset, path);
  const FileFormatRow& row = row_of(*format);
  if (!row.is_readable())
    return fail(ErrorCode::unsupported, "holds " + std::string(row.title) + ", not a model",
                kNoOffset, path);
  auto out = row.read(file, path, options);
  if (!out) return out;
  out->format = *format;
  out->bytes = file.view().size();
  return out;
}

Result<LoadedFile> load(const std::string& path, const LoadOptions& options) {
  const auto file = read_file(path, options.limits.memory_bytes);
  if (!file) return tl::unexpected(file.error());
  return load(*file, path, options);
}

Result<TetraMesh> load_tetra_mesh(const FileBytes& file, const Limits& limits) {
  return read_medit(file.view(), limits);
}

bool holds_tetra_mesh(const FileBytes& file, const std::string& path) {
  const auto format = detect_format(file.view(), path);
  return format && holds(*format, Feature::tetrahedra);
}

std::uint64_t SavedFiles::bytes() const {
  std::uint64_t sum = 0;
  for (const SavedFile& file : files) sum += file.bytes;
  return sum;
}

Result<SavedFiles> save(const Model& model, const std::string& path, FileFormat format,
                        const SaveOptions& options) {
  const FileFormatRow& row = row_of(format);
  if (!row.write_model) return not_written(format, "a model");
  std::vector<std::string> converted, dropped;
  std::optional<Model> placed;
  if (options.transforms && !row.holds.has(Feature::nodes)) {
    auto result = place_meshes(model, options.limits, converted, dropped);
    if (!result) return tl::unexpected(std::move(result).error());
    placed = std::move(*result);
  }
  auto set = row.write_model(placed ? *placed : model, output_name(path, format), options);
  if (!set) return tl::unexpected(std::move(set).error());
  set->converted.insert(set->converted.begin(), converted.begin(), converted.end());
  set->notes.insert(set->notes.begin(), dropped.begin(), dropped.end());
  return write(std::move(set), options);
}

Result<SavedFiles> save(const ProgressiveStrips& strips, const std::string& path, FileFormat format,
                        const SaveOptions& options) {
  const FileFormatRow& row = row_of(format);
  if (!row.write_strips) return not_written(format, "progressive strips");
  return write(row.write_strips(strips, output_name(path, format)), options);
}

}  // namespace pstrips::inline converters
