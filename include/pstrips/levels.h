#pragma once

// Meshes of a level, the choice of a level, shorter files.

#include "converters/decode.h"
