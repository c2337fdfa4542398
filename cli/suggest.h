#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pstrips::cli {

/// How many letters must be inserted, removed, replaced or swapped with their neighbour to turn one
/// word into the other.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The word that was meant, or "": at most a third of its letters differ, and at least one may.
std::string nearest(std::string_view word, const std::vector<std::string>& words);

}  // namespace pstrips::cli
