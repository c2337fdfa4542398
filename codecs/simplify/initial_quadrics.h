#pragma once

#include <vector>

#include "codecs/simplify/complex.h"
#include "codecs/simplify/simplify.h"
#include "codecs/simplify/wedges.h"

namespace pstrip {

/// The error quadric of every vertex before the first collapse: planes of its faces by area, and
/// planes that hold its borders, seams and folds in place. [Garland97 §3.4, §6]
///
/// Sets the weight and `regular` of each vertex record, and the attribute terms of the wedges when
/// there are some (`wedges` may be null). Cost O(size).
std::vector<Quadric> initial_quadrics(Complex& complex, const SimplifyInput& input,
                                      WedgeTable* wedges);

}  // namespace pstrip
