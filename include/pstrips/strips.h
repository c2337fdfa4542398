#pragma once

// Progressive strips in memory, index maps and their triangles.

#include "core/progressive_strips.h"
#include "core/strips.h"
