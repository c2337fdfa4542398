#pragma once

// The one place that says the version; CMakeLists.txt reads it here.

#define PSTRIPS_VERSION_MAJOR 0
#define PSTRIPS_VERSION_MINOR 1
#define PSTRIPS_VERSION_PATCH 0
