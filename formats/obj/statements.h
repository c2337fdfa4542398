#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "core/file.h"
#include "formats/obj/geometry.h"
#include "formats/obj/obj.h"

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

/// One object of a file; several may have one name.
struct NamedObject {
  Index name = 0;
  Index instance = 1;  ///< among those of the name that have a face, from 1
};

/// What faces of a group have in common: the number of its object, those of the names of group and
/// material, and the kind.
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
  std::vector<NamedObject> objects{{}};      ///< number 0 stands for none
  Index object = kEmptyName;                 ///< name of the last, with faces or without
  std::string header, notes;                 ///< lines, as obj.h says
  std::string libraries, missing_libraries;  ///< text and names, as obj.h says
};

/// Reads a file statement by statement. References are in range; what a corner says of a vt or vn
/// line that is not there counts as nothing said.
Result<Statements> read_statements(ByteView file, const ReadFile& read_file, const Limits& limits,
                                   const ObjReadOptions& options, std::size_t run_bytes);

}  // namespace pstrips::inline formats::obj
