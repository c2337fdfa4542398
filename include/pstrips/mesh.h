#pragma once

// Models in memory: meshes, attributes as data, scenes.

#include "core/mesh.h"
#include "core/scene.h"
