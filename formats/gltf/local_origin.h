#pragma once

#include <optional>

#include "core/point.h"
#include "core/scene.h"

namespace pstrips::inline formats::gltf {

/// Where the positions of a model should be counted from, so that f32 holds them: the middle of its
/// box, rounded to whole numbers that f32 holds exactly. Nothing when f32 takes positions as they
/// are, or an origin would not make them at least four times as accurate, as is so for a model that
/// stands near its origin.
///
/// One origin for all meshes: vertices at one place stay at one place. Cost O(vertices)
std::optional<Point> find_local_origin(const Model& model);

/// The largest distance along an axis between a position and what f32 makes of it, counted from an
/// origin.
double rounding_of(const Mesh& mesh, const Point& origin);

}  // namespace pstrips::inline formats::gltf
