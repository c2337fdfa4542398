#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace pstrips::inline validators {

enum class Severity : std::uint8_t {
  error,    ///< the file breaks a MUST of the specification
  warning,  ///< it breaks a SHOULD; every decoder still shows it
  info,     ///< worth knowing, nothing is broken
};
/// "error", "warning" or "info".
std::string_view name_of(Severity severity);

/// One place in a file where a rule does not hold.
struct Finding {
  std::string_view code;  ///< "PS4007"; static, as are the next two
  Severity severity = Severity::error;
  std::string_view clause;           ///< "S-012"; the page is that of the rule
  std::string message;               ///< what the rule demands, and what was found instead
  std::uint64_t offset = kNoOffset;  ///< byte of the file, where one is known
  std::string path;                  ///< "PCKT 3, vsplit 17" or "line 12 /pstrips/mesh[0]/base"
  friend bool operator==(const Finding&, const Finding&) = default;
};

/// What a whole validation says, in one word; the later ones win.
enum class Verdict : std::uint8_t {
  valid,        ///< no error; there may be warnings
  truncated,    ///< ends early; nothing wrong in what is there
  over_limit,   ///< refused by the limits given, not examined further
  unsupported,  ///< needs something that this version of the specification does not define
  invalid,      ///< corrupt: no further bytes will mend it
};
/// "valid", "truncated", "over the limit", "unsupported" or "invalid".
std::string_view name_of(Verdict verdict);

/// The findings of one file, in the order of the rules and then of the file.
class Report {
 public:
  /// max_findings  how many are kept; further ones are only counted
  explicit Report(std::size_t max_findings = 100) : max_findings_(max_findings) {}

  /// means  the verdict on a file with nothing worse; only of errors
  void add(Finding finding, Verdict means = Verdict::invalid);
  /// Nothing else is kept: a check over a long array may stop.
  bool full() const { return findings_.size() >= max_findings_; }

  const std::vector<Finding>& findings() const { return findings_; }
  std::size_t errors() const { return errors_; }
  std::size_t warnings() const { return warnings_; }
  /// Found beyond the limit of the constructor. A check that stopped early did not count further.
  std::size_t dropped() const { return dropped_; }
  Verdict verdict() const { return verdict_; }

 private:
  std::size_t max_findings_;
  std::vector<Finding> findings_;
  std::size_t errors_ = 0, warnings_ = 0, dropped_ = 0;
  Verdict verdict_ = Verdict::valid;
};

}  // namespace pstrips::inline validators
