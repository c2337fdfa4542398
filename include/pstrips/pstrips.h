#pragma once

// All of the library.

#include "pstrips/binary.h"
#include "pstrips/compare.h"
#include "pstrips/decoder.h"
#include "pstrips/encoder.h"
#include "pstrips/files.h"
#include "pstrips/levels.h"
#include "pstrips/mesh.h"
#include "pstrips/result.h"
#include "pstrips/stripify.h"
#include "pstrips/strips.h"
#include "pstrips/validate.h"
#include "pstrips/version.h"
