#include "formats/obj/libraries.h"

#include "core/text.h"
#include "formats/obj/names.h"

namespace pstrips::inline formats::obj {

Result<void> MaterialLibraries::read(std::string_view line) {
  const std::string_view whole = trimmed(line);
  if (whole.empty()) return {};
  const auto read_whole = read_library(whole);
  if (!read_whole) return tl::unexpected(read_whole.error());
  if (*read_whole) return {};
  for (const std::string_view name : split_mtllib(whole)) {
    auto found = read_library(name);
    if (found && !*found) found = read_words(name);
    if (!found) return tl::unexpected(found.error());
    if (*found || !missing_names_.emplace(name).second) continue;
    const std::string_view missing = trimmed(name);
    if (missing_.size() + missing.size() >= limits_.string_bytes)
      return fail(ErrorCode::over_limit, "more text beside the mesh than the limit allows");
    missing_.append(missing) += '\n';
    note_missing(missing);
  }
  return {};
}

void MaterialLibraries::note_missing(std::string_view name) const {
  if (!options_.notes || !read_file_) return;
  const bool is_outside = !companion_path(name, options_.allow_parent_paths);
  options_.notes->push_back(
      "material library " + clean_name(name) +
      (is_outside ? ", which is outside the model's folder" : ", which is not there"));
}

Result<bool> MaterialLibraries::read_words(std::string_view words) {
  bool any = false;
  for (auto word = next_word(words); !word.empty(); word = next_word(words)) {
    const auto found = read_library(word);
    if (!found) return found;
    any |= *found;
  }
  return any;
}

Result<bool> MaterialLibraries::read_library(std::string_view written) {
  const auto path = companion_path(written, options_.allow_parent_paths);
  if (!path || !read_file_) return false;
  if (const auto seen = seen_.find(*path); seen != seen_.end()) return seen->second;
  auto bytes = read_file_(*path);
  seen_.emplace(*path, bytes.has_value());
  if (!bytes && bytes.error().code == ErrorCode::io) return false;
  if (!bytes) return tl::unexpected(std::move(bytes).error());
  const std::string_view text = without_utf8_mark(as_text(*bytes));
  if (text_.size() + text.size() >= limits_.string_bytes)
    return fail(ErrorCode::over_limit, "more material text than the limit allows");
  text_ += text;
  if (!text_.empty() && !text_.ends_with('\n')) text_ += '\n';
  return true;
}

}  // namespace pstrips::inline formats::obj
