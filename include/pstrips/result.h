#pragma once

// Errors and limits: what every function that takes untrusted input speaks of.

#include "core/limits.h"
#include "core/result.h"
