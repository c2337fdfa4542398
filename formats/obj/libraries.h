#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "core/file.h"
#include "core/limits.h"
#include "formats/obj/obj.h"

namespace pstrips::inline formats::obj {

/// The material libraries that a file names, each read once.
class MaterialLibraries {
 public:
  /// All must outlive this. `read_file` may be empty: then no library is found.
  MaterialLibraries(const ReadFile& read_file, const Limits& limits, const ObjReadOptions& options)
      : read_file_(read_file), limits_(limits), options_(options) {}

  /// Reads those of an `mtllib` line, which is one name, or several with spaces between them.
  ///
  /// errors  over_limit; what `read_file` answers but io, which means that there is no such file
  Result<void> read(std::string_view line);

  const std::string& text() const { return text_; }  ///< of all libraries
  const std::string& missing() const {
    return missing_;
  }  ///< names of those not found, a line each

 private:
  /// Whether there is such a file.
  Result<bool> read_library(std::string_view written);
  void note_missing(std::string_view name) const;
  Result<bool> read_words(std::string_view words);

  const ReadFile& read_file_;
  const Limits& limits_;
  const ObjReadOptions& options_;
  std::string text_, missing_;
  std::set<std::string> missing_names_;
  std::map<std::string, bool> seen_;  ///< by path; whether it could be read
};

}  // namespace pstrips::inline formats::obj
