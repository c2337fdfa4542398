#pragma once

#include "core/result.h"

namespace pstrips::inline formats {

/// What kind of answer a fault of a document is.
constexpr ErrorCode code_of(Fault fault) {
  switch (fault) {
    case Fault::truncated:
      return ErrorCode::truncated;
    case Fault::over_limit:
      return ErrorCode::over_limit;
    case Fault::version_unknown:
    case Fault::profile_unknown:
    case Fault::digest_unknown:
    case Fault::critical_chunk_unknown:
    case Fault::xml_unsupported:
      return ErrorCode::unsupported;
    default:
      return ErrorCode::corrupt;
  }
}

}  // namespace pstrips::inline formats
