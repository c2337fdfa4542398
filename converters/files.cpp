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

// Images that are to stand beside the output and are not there yet.
void add_textures(const Model& model, const std::string& path, FileSet& set) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  for (const Image& image : model.scene.images) {
    if (image.data.empty() || image.uri.empty()) continue;
    const std::filesystem::path place = folder / image.uri;
    std::error_code none;
    const auto there =
        std::filesystem::is_regular_file(place, none) ? read_file(place) : Result<FileBytes>();
    if (there && std::ranges::equal(there->view(), image.data)) continue;
    set.files.push_back({place.string(), image.data});
  }
}

// Makes the folders that files are to stand in, and takes those away again that stay empty.
class Folders {
 public:
  Folders() = default;
  Folders(const Folders&) = delete;
  Folders& operator=(const Folders&) = delete;
  ~Folders() {
    std::error_code is_in_use;
    for (auto made = made_.rbegin(); made != made_.rend(); ++made)
      std::filesystem::remove(*made, is_in_use);
  }
  Result<void> make_for(const std::string& path) {
    std::error_code error;
    std::vector<std::filesystem::path> missing;
    for (auto folder = std::filesystem::path(path).parent_path();
         !folder.empty() && !std::filesystem::exists(folder, error); folder = folder.parent_path())
      missing.push_back(folder);
    for (auto folder = missing.rbegin(); folder != missing.rend(); ++folder) {
      std::filesystem::create_directory(*folder, error);
      if (error)
        return fail(ErrorCode::io, "cannot make the folder: " + error.message(), kNoOffset,
                    folder->string());
      made_.push_back(*folder);
    }
    return {};
  }

 private:
  std::vector<std::filesystem::path> made_;
};

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
  Folders folders;
  for (std::size_t i = 1; i < set->files.size(); ++i)
    if (const auto made = folders.make_for(set->files[i].path); !made)
      return tl::unexpected(made.error());
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
  if (options.textures == Textures::copy && path != "-") add_textures(model, path, *set);
  return write(std::move(set), options);
}

Result<SavedFiles> save(const ProgressiveStrips& strips, const std::string& path, FileFormat format,
                        const SaveOptions& options) {
  const FileFormatRow& row = row_of(format);
  if (!row.write_strips) return not_written(format, "progressive strips");
  return write(row.write_strips(strips, output_name(path, format)), options);
}

}  // namespace pstrips::inline converters
