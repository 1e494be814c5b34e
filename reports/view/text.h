// Untrusted text (names, reasons, commands from results.json) made safe to show, and byte encodings a page needs.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace photonproof::reports::inline reports_view {

/// Valid UTF-8 on one line: a malformed byte and a bidirectional control become U+FFFD, any other control character
/// (line breaks and tabs among them) a space. Markup is not escaped: that is the template's part.
std::string printable(std::string_view text);

/// `printable` with every character escaped that Markdown (CommonMark and GitHub's tables, maths and raw HTML) would
/// read as markup inside a line or a table cell. Not safe as the first characters of a line.
std::string markdown_text(std::string_view text);

/// At most `most` bytes of valid UTF-8, cut between characters.
std::string shortened(const std::string& text, std::size_t most);

/// `printable` for LaTeX's text mode, in ASCII alone: its special characters are escaped, symbols and accents set by
/// commands of plain LaTeX, anything else as ascii_text has it. Nothing vanishes.
std::string latex_text(std::string_view text);

/// `printable` with every character that is not ASCII by its number: "[U+4E2D]".
std::string ascii_text(std::string_view text);

/// `printable` for a cell of CSV, quoted where RFC 4180 demands it. A spreadsheet takes what begins like a formula for
/// one: an apostrophe prevents it.
std::string csv_cell(const std::string& text);

/// JSON (or any text) inside a <script> element: "<" is written as the escape that JSON knows, so no "</script>" and no
/// "<!--" is left.
std::string json_in_html(const std::string& json);

/// A relative path as a URL: everything but RFC 3986's unreserved characters and '/' is percent-encoded.
std::string url_path(std::string_view path);

/// RFC 4648 base64 with padding.
std::string base64(std::string_view bytes);

}  // namespace photonproof::reports::inline reports_view
