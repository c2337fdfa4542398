#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh.h"
#include "core/text.h"

namespace pstrips::inline formats::obj {

/// Whether a statement of OBJ begins with the word, of all parts of the format.
bool is_statement(std::string_view word);

/// The next word of `text`, which is shortened by it; empty at the end.
std::string_view next_word(std::string_view& text);

/// A name as the model keeps it: UTF-8 (other bytes are taken for Latin-1), control characters
/// become spaces, none at the ends.
std::string clean_name(std::string_view text);

/// The words of a `g` line, cleaned, with one space between them.
std::string clean_group(std::string_view text);

/// The path of a companion file below the model's folder, '/' between its parts; nothing when the
/// name is absolute, names a drive or a scheme, climbs with ".." (unless it may), or is empty.
std::optional<std::string> companion_path(std::string_view written, bool may_climb = false);

/// The names on an `mtllib` line: a name ends with a word in ".mtl" or with the line, so that
/// names with spaces work. As written, "\ " for an escaped space included.
std::vector<std::string_view> split_mtllib(std::string_view text);

struct GroupName {
  std::string object, group;
  Index instance = 1;
};
/// The inverse of obj_group_name.
GroupName split_group_name(std::string_view name);

}  // namespace pstrips::inline formats::obj
