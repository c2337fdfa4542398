#pragma once

// Meshes to progressive strips.

#include "converters/encode.h"
