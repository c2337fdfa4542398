#pragma once

#include <string>
#include <vector>

#include "core/bytes.h"
#include "core/limits.h"
#include "validators/report.h"

namespace pstrips::inline validators {

struct ValidateOptions {
  Limits limits;
  std::size_t max_findings = 100;   ///< kept in the report; further ones are counted
  std::vector<std::string> ignore;  ///< codes of rules that are not run
  bool warnings_as_errors = false;
};

/// Judges a file of progressive strips, binary or XML, by all rules of validators/rules.h.
///
/// Any bytes will do: what is broken becomes findings. Rules whose ground is broken are not
/// run, so that one fault makes few findings. Deterministic.
///
/// cost  O(file) time and memory; checks of one packet cost what it changes
Report validate(ByteView file, const ValidateOptions& options = {});

}  // namespace pstrips::inline validators
