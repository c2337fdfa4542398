#pragma once

#include "cli/image.h"
#include "core/scene.h"

namespace pstrips::cli {

/// How a picture looks at a model, whose y axis points up.
struct View {
  double turn = 30;          ///< degrees around the y axis; 0 looks along -z, 90 along -x
  double tilt = 20;          ///< degrees from above, -90 to 90
  std::uint32_t size = 512;  ///< width and height in pixels
};

/// Draws a model where its nodes put it, with the colours of its materials and their embedded
/// textures and a light where the viewer is, on a transparent ground. Lines and points are left
/// out.
///
/// box_of  the model whose box fills the picture, so that levels of one model fit onto each other
/// limits  what textures and instances may take
/// errors  as place_meshes(); unsupported when nothing is there to be drawn
/// cost    O(triangles + pixels covered by them), and the textures; deterministic
Result<RgbaImage> draw(const Model& model, const Model& box_of, const View& view,
                       const Limits& limits);

}  // namespace pstrips::cli
