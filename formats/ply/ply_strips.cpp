#include "formats/ply/ply_strips.h"

#include <algorithm>

#include "formats/ply/ply_numbers.h"

namespace pstrips::inline formats::ply {

std::optional<Error> StripExpander::add(const ListColumn& strips, ComponentType type,
                                        std::uint64_t offset) {
  return visit_type(type, [&](auto zero) -> std::optional<Error> {
    using T = decltype(zero);
    const std::byte* at = strips.values.data();
    for (const std::uint32_t size : strips.sizes) {
      length_ = 0;
      for (std::uint32_t i = 0; i < size; ++i, at += sizeof(T)) {
        const auto index = static_cast<std::int64_t>(load<T>(at));
        if (index == -1) {
          length_ = 0;
        } else if (index < 0 || static_cast<std::uint64_t>(index) >= vertices_) {
          return Error{ErrorCode::corrupt, "index of a vertex that is not there", offset,
                       "element tristrips"};
        } else if (!step(static_cast<Index>(index))) {
          return Error{ErrorCode::over_limit, "more face corners than the limit", offset,
                       "element tristrips"};
        }
      }
    }
    return std::nullopt;
  });
}

bool StripExpander::step(Index c) {
  const Index a = older_, b = newer_;
  older_ = b;
  newer_ = c;
  if (++length_ < 3 || a == b || b == c || a == c) return true;
  if (faces_.corners.size() + 3 > max_corners_) return false;
  const bool turned = length_ % 2 == 0;
  faces_.corners.insert(faces_.corners.end(), {turned ? b : a, turned ? a : b, c});
  if (!faces_.first.empty()) faces_.first.push_back(static_cast<Index>(faces_.corners.size()));
  return true;
}

void turn_strips_into_faces(Header& header) {
  auto& elements = header.elements;
  Element* face = header.find("face");
  if (face == nullptr) {
    face = header.find("tristrips");
    face->name = "face";
    face->properties.clear();
  } else {
    const auto strips = std::ranges::find(elements, "tristrips", &Element::name);
    std::vector<std::string> remarks = std::move(strips->remarks);
    for (auto& more : strips->properties)
      remarks.insert(remarks.end(), more.remarks.begin(), more.remarks.end());
    const auto next = elements.erase(strips);
    auto& later = next == elements.end() ? header.last_remarks : next->remarks;
    later.insert(later.begin(), remarks.begin(), remarks.end());
    face = header.find("face");
  }
  if (face->properties.empty())
    face->properties.push_back(
        list_property("vertex_indices", ComponentType::u8, ComponentType::i32));
}

}  // namespace pstrips::inline formats::ply
