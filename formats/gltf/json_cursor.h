#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/limits.h"
#include "core/mesh.h"
#include "core/result.h"
#include "formats/gltf/json.h"

namespace pstrips::inline formats::gltf {

/// A JSON value, where it stands, and the first failure of all reads from the document. Reads
/// after a failure return defaults, so the code below reads in a straight line.
class Cursor {
 public:
  struct Shared {
    std::optional<Error> error;
    const Limits& limits;
  };
  Cursor(json& value, std::string path, Shared& shared)
      : value_(value), path_(std::move(path)), shared_(shared) {}

  void fail(ErrorCode code, std::string message) const {
    if (!shared_.error) shared_.error = Error{code, std::move(message), kNoOffset, path_};
  }
  bool failed() const { return shared_.error.has_value(); }
  json& value() const { return value_; }
  bool has(std::string_view key) const { return value_.contains(key); }
  Cursor operator[](std::string_view key) const {
    return {value_[key], std::string(path_).append("/").append(key), shared_};
  }

  /// Calls `visit(element, i)` for each object of an array member, which may be absent.
  template <class Visit>
  void each(const char* key, Visit&& visit) const {
    if (failed() || !has(key)) return;
    const Cursor list = (*this)[key];
    if (!list.value_.is_array()) return list.fail(ErrorCode::corrupt, "is not an array");
    for (std::size_t i = 0; i < list.value_.size() && !failed(); ++i) {
      const Cursor element(list.value_[i], list.path_ + '/' + std::to_string(i), shared_);
      if (!element.value_.is_object()) return element.fail(ErrorCode::corrupt, "is not an object");
      visit(element, i);
    }
  }
  std::size_t length(const char* key) const {
    return has(key) && value_[key].is_array() ? value_[key].size() : 0;
  }
  bool has_object(std::string_view key) const {
    if (!has(key)) return false;
    if (value_[key].is_object()) return true;
    (*this)[key].fail(ErrorCode::corrupt, "is not an object");
    return false;
  }

  std::uint64_t whole(const char* key, std::uint64_t absent = 0) const {
    return has(key) ? (*this)[key].as_whole() : absent;
  }
  std::uint64_t required_whole(const char* key) const {
    if (!has(key)) fail(ErrorCode::corrupt, std::string("misses member ") + key);
    return whole(key);
  }
  /// An index below `size`, kNone when absent.
  Index reference(const char* key, std::size_t size) const {
    return has(key) ? (*this)[key].as_reference(size) : kNone;
  }
  Index as_reference(std::size_t size) const {
    const std::uint64_t i = as_whole();
    if (!failed() && i >= size) fail(ErrorCode::corrupt, "refers to nothing");
    return failed() ? 0 : static_cast<Index>(i);
  }
  std::vector<Index> references(const char* key, std::size_t size) const {
    std::vector<Index> out;
    if (failed() || !has(key)) return out;
    const Cursor list = (*this)[key];
    if (!list.value_.is_array()) list.fail(ErrorCode::corrupt, "is not an array");
    for (std::size_t i = 0; !failed() && i < list.value_.size(); ++i)
      out.push_back(
          Cursor(list.value_[i], list.path_ + '/' + std::to_string(i), shared_).as_reference(size));
    return out;
  }
  bool flag(const char* key) const {
    if (!has(key)) return false;
    const Cursor member = (*this)[key];
    if (!member.value_.is_boolean()) member.fail(ErrorCode::corrupt, "is not a boolean");
    return !failed() && member.value_.get<bool>();
  }
  std::string text(const char* key) const { return has(key) ? (*this)[key].as_text() : ""; }
  std::string as_text() const {
    if (!value_.is_string()) {
      fail(ErrorCode::corrupt, "is not a string");
      return {};
    }
    const auto& string = value_.get_ref<const std::string&>();
    if (string.size() > shared_.limits.string_bytes) {
      fail(ErrorCode::over_limit, "string is too long");
      return {};
    }
    return string;
  }
  /// Takes a string out of the document, however long: it may be a data URI.
  std::string take_uri(const char* key) const {
    if (!has(key)) return {};
    if (!value_[key].is_string()) {
      (*this)[key].fail(ErrorCode::corrupt, "is not a string");
      return {};
    }
    return std::move(value_[key].get_ref<std::string&>());
  }
  void number(const char* key, double& out) const {
    if (!has(key)) return;
    const Cursor member = (*this)[key];
    if (!member.value_.is_number()) return member.fail(ErrorCode::corrupt, "is not a number");
    out = member.value_.get<double>();
  }
  template <std::size_t n>
  bool numbers(const char* key, std::array<double, n>& out) const {
    if (!has(key)) return false;
    const Cursor list = (*this)[key];
    const auto is_number = [](const json& x) { return x.is_number(); };
    if (!list.value_.is_array() || list.value_.size() != n ||
        !std::ranges::all_of(list.value_, is_number)) {
      list.fail(ErrorCode::corrupt, "is not " + std::to_string(n) + " numbers");
      return false;
    }
    for (std::size_t i = 0; i < n; ++i) out[i] = list.value_[i].template get<double>();
    return true;
  }

 private:
  std::uint64_t as_whole() const {
    if (value_.is_number_unsigned()) return value_.get<std::uint64_t>();
    // JSON knows one kind of number: 3.0 is as whole as 3.
    const double number = value_.is_number_float() ? value_.get<double>() : -1;
    if (number >= 0 && number < 9e15 &&
        number == static_cast<double>(static_cast<std::uint64_t>(number)))
      return static_cast<std::uint64_t>(number);
    fail(ErrorCode::corrupt, "is not a whole number");
    return 0;
  }

  json& value_;
  std::string path_;
  Shared& shared_;
};

}  // namespace pstrips::inline formats::gltf
