#include "validators/report.h"

#include <algorithm>

namespace pstrips::inline validators {

std::string_view name_of(Severity severity) {
  constexpr std::string_view kNames[] = {"error", "warning", "info"};
  return kNames[static_cast<std::size_t>(severity)];
}

std::string_view name_of(Verdict verdict) {
  constexpr std::string_view kNames[] = {"valid", "truncated", "over the limit", "unsupported",
                                         "invalid"};
  return kNames[static_cast<std::size_t>(verdict)];
}

void Report::add(Finding finding, Verdict means) {
  if (finding.severity == Severity::error) {
    ++errors_;
    verdict_ = std::max(verdict_, means);
  }
  if (finding.severity == Severity::warning) ++warnings_;
  if (full())
    ++dropped_;
  else
    findings_.push_back(std::move(finding));
}

}  // namespace pstrips::inline validators
