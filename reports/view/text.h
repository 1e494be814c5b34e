// Makes untrusted text (names, reasons, commands from results.json) safe to show, and encodes bytes for pages.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace photonproof::reports::inline reports_view {

/// Valid UTF-8 on one line. A malformed byte and a bidirectional control become U+FFFD, any other control character
/// (also line breaks and tabs) a space. Markup is not escaped: the template does that.
std::string printable(std::string_view text);

/// `printable` with every character escaped that Markdown (CommonMark and GitHub's tables, maths and raw HTML) would
/// read as markup inside a line or a table cell. Not safe as the first characters of a line.
std::string markdown_text(std::string_view text);

/// The text with a capital where it begins with one of a to z.
std::string capitalised(std::string text);

/// At most `most` bytes of valid UTF-8, cut between characters.
std::string shortened(const std::string& text, std::size_t most);

/// `printable` for LaTeX's text mode, in ASCII alone. Special characters are escaped, and symbols and accents become
/// commands of plain LaTeX. Other characters become those of ascii_text, so nothing vanishes.
std::string latex_text(std::string_view text);

/// `printable` with every character outside ASCII replaced by its number: "[U+4E2D]".
std::string ascii_text(std::string_view text);

/// `printable` for a cell of CSV, quoted where RFC 4180 demands it. A leading apostrophe keeps a spreadsheet from
/// reading the text as a formula.
std::string csv_cell(const std::string& text);

/// JSON (or any text) inside a <script> element: "<" becomes JSON's escape, so no "</script>" and no "<!--" is left.
std::string json_in_html(const std::string& json);

/// A relative path as a URL: percent-encodes everything except RFC 3986's unreserved characters and '/'.
std::string url_path(std::string_view path);

/// RFC 4648 base64 with padding.
std::string base64(std::string_view bytes);

}  // namespace photonproof::reports::inline reports_view
