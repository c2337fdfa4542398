#pragma once

#include <string>

#include "core/text.h"

namespace pstrips::inline formats::obj {

struct Number {
  double value = 0;
  /// The float nearest to `value` prints, with append_number, as a decimal of `value`: a float
  /// keeps all that the text said.
  bool fits_f32 = true;
};

/// Reads the number that starts at p and ends at white space or `end`; correctly rounded, any
/// notation of C, "inf", "nan" and MSVC's "1.#IND" and "1.#INF".
///
/// returns  one past the number, or null when there is none or no finite double comes near it
const char* parse_number(const char* p, const char* end, Number& out);

/// The meaning of Number::fits_f32, by trying.
bool fits_f32(double value);

/// Appends the shortest decimal that reads back to the same value.
void append_number(std::string& out, float value);
void append_number(std::string& out, double value);

/// Whether some float f is such that 1 - f, rounded, is the value.
bool turns_in_f32(float value);

/// Appends 1 - value, for texture coordinates from the other corner: of a float the shortest
/// decimal from which 1 - v is the float again. The decimal is read as a float if `in_f32`, which
/// must be true of all its kind, else as a double.
void append_turned(std::string& out, float value, bool in_f32);
void append_turned(std::string& out, double value);

}  // namespace pstrips::inline formats::obj
