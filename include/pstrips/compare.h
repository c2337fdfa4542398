#pragma once

// How far apart two models are.

#include "converters/compare.h"
