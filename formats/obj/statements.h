#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "core/file.h"
#include "formats/obj/geometry.h"

namespace pstrips::inline formats::obj {

/// Strings by number, in order of their first use.
class Names {
 public:
  Names() = default;
  Names(const Names&) = delete;
  Names& operator=(const Names&) = delete;
  Names(Names&&) = default;
  Names& operator=(Names&&) = default;

  Index id(std::string name) {
    const auto [at, is_new] = ids_.emplace(std::move(name), static_cast<Index>(names_.size()));
    if (is_new) names_.push_back(&at->first);
    return at->second;
  }
  const std::string& operator[](Index id) const { return *names_[id]; }
  std::size_t size() const { return names_.size(); }

 private:
  std::map<std::string, Index> ids_;
  std::vector<const std::string*> names_;  // map nodes stay where they are
};

/// What faces of a group have in common, by number of name: object, group, material; and the kind.
using GroupKey = std::tuple<Index, Index, Index, FaceKind>;
inline constexpr Index kEmptyName = 0;

/// All that a file says, in flat arrays.
struct Statements {
  Geometry geometry;
  std::vector<Index> face_group;
  std::vector<std::uint32_t> face_smoothing;  ///< empty without has_smoothing
  bool has_smoothing = false;
  Names names;
  std::vector<GroupKey> groups;              ///< in order of use
  Index object = kEmptyName;                 ///< the last that was named
  std::string header, notes;                 ///< lines, as obj.h says
  std::string libraries, missing_libraries;  ///< text and names, as obj.h says
};

/// Reads a file statement by statement. References are in range.
Result<Statements> read_statements(ByteView file, const ReadFile& read_file, const Limits& limits,
                                   std::size_t run_bytes);

}  // namespace pstrips::inline formats::obj
