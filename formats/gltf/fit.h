#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/mesh.h"
#include "core/notes.h"
#include "core/point.h"

namespace pstrips::inline formats::gltf {

/// A wedge attribute in a form that glTF takes.
struct Fitted {
  std::string name;       ///< within its morph target, where it has one
  Index target = kNone;   ///< morph target
  std::string_view type;  ///< "SCALAR" … "MAT4"
  std::uint8_t rows = 0;  ///< of a matrix, else 0
  const Attribute* source = nullptr;
  std::optional<Attribute> converted;

  const Attribute& attribute() const { return converted ? *converted : *source; }
  bool needs_quantization() const;  ///< KHR_mesh_quantization
  bool needs_bounds() const { return name == "POSITION"; }
};

struct FitOptions {
  bool from_gltf = false;                          ///< names and types are glTF's already
  Index targets = 0;                               ///< morph targets, when from glTF
  const std::vector<std::string>* mat2 = nullptr;  ///< attributes of four components that are MAT2
  Point origin{};                                  ///< positions are counted from here
  bool turns_texcoords = false;                    ///< they are from the lower left
};

/// POSITION, one element a wedge, and the wedge attributes; they refer to `mesh` where nothing had
/// to be converted. `notes` receives what changed. cost O(size)
std::vector<Fitted> fit_attributes(const Mesh& mesh, const FitOptions& options, Notes& notes);

}  // namespace pstrips::inline formats::gltf
