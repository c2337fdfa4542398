#pragma once

#include <ostream>

#include "validators/report.h"

namespace pstrips {

/// How gtest shows a finding.
inline void PrintTo(const Finding& finding, std::ostream* out) {
  *out << finding.code << " at " << finding.offset << " (" << finding.path
       << "): " << finding.message;
}

}  // namespace pstrips
