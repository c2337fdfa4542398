#pragma once

// Meshes to triangle strips of one level.

#include "codecs/stripify/stripify.h"
