#pragma once

// Files of every format, by name or by content.

#include "converters/files.h"
