#pragma once

// The binary variant, read and written whole.

#include "formats/pstrip/container/binary.h"
