#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/mesh.h"
#include "core/result.h"

namespace pstrips::test {

// Models by a path: "shipped/x" is tests/data/models/x, which is always there; any other path is in
// the folder of real models, which may not be there.

/// Whether tests of that model run.
bool is_here(const std::string& path);

/// Those of the paths whose files are there.
std::vector<std::string> those_here(std::vector<std::string> paths);

/// The first mesh of a .ply or .obj file; nothing when the folder of real models or the file in it
/// is not there or cannot be read. Materials are not looked up. A shipped model that cannot be read
/// is a broken test: it throws.
std::optional<Mesh> model_mesh(const std::string& path);

/// What a reader is to say of that model: the code of an error, as "corrupt", or "read".
/// [tests/data/models_refused.tsv]
std::string expected_outcome(const std::string& path);
/// What it said.
std::string outcome_of(const std::optional<Error>& error);

template <class T>
std::string outcome_of(const Result<T>& result) {
  return outcome_of(result ? std::nullopt : std::optional(result.error()));
}

}  // namespace pstrips::test
