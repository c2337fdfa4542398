#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/bytes.h"
#include "formats/pstrip/numbers.h"

namespace pstrips::inline formats {

// Strings and binary data inside XML. [spec/xml.md §4]

/// Bytes of the XML character that `text` starts with; 0 when it starts with a byte that no XML
/// document may hold: a control character but tab, line feed and carriage return, broken UTF-8,
/// a surrogate, U+FFFE or U+FFFF.
std::size_t character_bytes(std::string_view text);

/// `text` could go on to be a whole character if bytes were added to it.
bool is_cut_character(std::string_view text);

/// Appends a string as an attribute value: markup as entities, `\` as `\\`, bytes that XML
/// forbids or changes as `\x` and two hexadecimal digits.
void write_string(TextWriter& out, std::string_view text);

/// Undoes the backslashes; entities are undone before. Nothing when one is malformed.
std::optional<std::string> unescape(std::string_view text);

/// The bytes come back from element content as they are: valid characters, no carriage return,
/// and not white space alone.
bool fits_content(ByteView bytes);
/// Appends element content. Precondition: fits_content(bytes).
void write_content(TextWriter& out, ByteView bytes);

/// Base64 [RFC4648 §4] with padding, in lines of 76 characters.
void write_base64_lines(TextWriter& out, ByteView bytes);
/// White space is skipped. Nothing when it is not what write_base64 could have written otherwise.
std::optional<Bytes> parse_base64_lines(std::string_view text);

}  // namespace pstrips::inline formats
