#pragma once

// The streaming decoder: bytes in, levels and display strips out. All of it is in pstrips::decoder.

#include "converters/stream_decoder.h"
