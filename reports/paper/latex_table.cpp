// Widths are estimated from the metrics of Computer Modern, the widest of the three classes' fonts, so that the layout
// is decided without LaTeX. A test compiles tables in all three classes.
#include "reports/paper/latex_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/view/text.h"

namespace photonproof::inline reports_paper {
using namespace reports;

namespace {

constexpr double column_width = 214;       // pt; 221 pt is the narrowest, of article on A4
constexpr double column_gap = 6;           // pt, twice \tabcolsep
constexpr double widest_stub = 92;         // pt; longer texts are wrapped
constexpr double widest_cell = 104;        // pt, likewise
constexpr double bold_stretch = 1.16;      // bold digits are 0.575 em wide, medium ones 0.531
constexpr std::size_t lines_a_float = 19;  // with the caption: a slide has room for these

/// Widths of the characters 32 to 126 in thousandths of 8 pt: cmr8.tfm, rounded up, and for those that other fonts have
/// (\ { } _ ^ ~ < > |) the widest of these fonts.
constexpr int character_widths[] = {
    354, 296, 550, 886, 532, 886, 827, 296, 414, 414, 532, 827, 296, 355, 296, 532, 532, 532,  532,
    532, 532, 532, 532, 532, 532, 532, 296, 296, 826, 827, 826, 502, 827, 796, 753, 768, 812,  723,
    694, 834, 796, 383, 546, 826, 664, 973, 796, 827, 723, 827, 782, 591, 768, 796, 796, 1091, 796,
    796, 650, 296, 600, 296, 600, 600, 296, 532, 591, 473, 591, 473, 325, 532, 591, 296, 325,  561,
    296, 886, 591, 532, 591, 561, 415, 420, 414, 591, 561, 768, 561, 561, 473, 550, 600, 550,  600,
};

/// Escaped. A word of more than 16 bytes may break after each sixth plain character.
std::string breakable_word(const std::string& word) {
  if (word.size() <= 16) return latex_text(word);
  const auto is_plain = [&](std::size_t i) { return static_cast<unsigned char>(word[i]) < 0x80; };
  std::string out;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const bool last = i + 1 == word.size();
    if (!last && (i + 1 - begin < 6 || !is_plain(i) || !is_plain(i + 1))) continue;
    out += latex_text(word.substr(begin, i + 1 - begin)) + (last ? "" : "\\allowbreak{}");
    begin = i + 1;
  }
  return out;
}

std::string breakable(const std::string& text) {
  std::string out;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    out += (begin > 0 ? " " : "") + breakable_word(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return out;
}

std::string wrapped(const std::string& text, double most) {
  if (latex_width(text) <= most) return latex_text(text);
  return fmt::format("\\parbox[t]{{{:.0f}pt}}{{\\raggedright\\hspace{{0pt}}{}\\strut}}", most, breakable(text));
}

/// Lines that a text takes when it is wrapped.
std::size_t lines_of(const std::string& text, double most) {
  const double width = latex_width(text);
  return width <= most ? 1 : 1 + static_cast<std::size_t>(1.2 * width / most);
}

std::string letter(std::size_t index) {
  std::string text(1, static_cast<char>('a' + index % 26));
  return index < 26 ? text : letter(index / 26 - 1) + text;
}

/// Columns [begin, end) of a table beside its first.
struct Part {
  std::size_t begin, end;
};

double stub_width(const LatexTable& table) {
  double width = latex_width(table.stub);
  for (const LatexRow& row : table.rows) width = std::max(width, latex_width(row.stub));
  return std::min(width, widest_stub);
}

double cell_width(const LatexCell& cell) {
  const double note = cell.note.empty() ? 0 : 6;
  return std::min(latex_width(cell.text) * (cell.best ? bold_stretch : 1), widest_cell) + note;
}

std::vector<Part> parts_of(const LatexTable& table) {
  const double first = stub_width(table);
  std::vector<Part> parts{{0, 0}};
  double used = first;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    double width = std::min(latex_width(table.columns[c].title), widest_cell);
    for (const LatexRow& row : table.rows) width = std::max(width, cell_width(row.cells[c]));
    if (used + column_gap + width > column_width && parts.back().end > parts.back().begin) {
      parts.push_back({c, c});
      used = first;
    }
    used += column_gap + width;
    parts.back().end = c + 1;
  }
  return parts;
}

/// Protects a first cell that begins with a bracket or a star: the command that ends the row above would read it as its
/// argument.
std::string protected_first(std::string text) {
  if (!text.empty() && (text[0] == '[' || text[0] == '*')) text = std::string("{") + text[0] + "}" + text.substr(1);
  return text;
}

std::string cell_text(const LatexCell& cell, std::vector<std::string>& notes) {
  std::string text = wrapped(cell.text, widest_cell);
  if (cell.best) text = "\\textbf{" + text + "}";
  if (cell.note.empty()) return text;
  const auto found = std::ranges::find(notes, cell.note);
  const auto index = static_cast<std::size_t>(found - notes.begin());
  if (found == notes.end()) notes.push_back(cell.note);
  return text + "$^{\\mathrm{" + letter(index) + "}}$";
}

std::string tabular(const LatexTable& table, Part part, std::size_t begin, std::size_t end) {
  std::string columns = "@{}l", head = wrapped(table.stub, widest_stub);
  for (std::size_t c = part.begin; c < part.end; ++c) {
    columns += table.columns[c].is_text ? 'l' : 'r';
    head += " & " + wrapped(table.columns[c].title, widest_cell);
  }
  std::string text =
      "  \\begin{tabular}{" + columns + "@{}}\n  \\toprule\n  " + protected_first(head) + " \\\\\n  \\midrule\n";
  std::vector<std::string> notes;
  for (std::size_t r = begin; r < end; ++r) {
    const LatexRow& row = table.rows[r];
    if (!row.group.empty() && (r == begin || row.group != table.rows[r - 1].group)) {
      if (r > begin) text += "  \\addlinespace\n";
      text += fmt::format("  \\multicolumn{{{}}}{{@{{}}l@{{}}}}{{\\itshape {}}} \\\\\n", part.end - part.begin + 1,
                          wrapped(row.group, column_width - 10));
    }
    text += "  " + protected_first(wrapped(row.stub, widest_stub));
    for (std::size_t c = part.begin; c < part.end; ++c) text += " & " + cell_text(row.cells[c], notes);
    text += " \\\\\n";
  }
  text += "  \\bottomrule\n  \\end{tabular}\\par\n";
  if (notes.empty()) return text;
  text += fmt::format("  \\parbox{{{:.0f}pt}}{{\\raggedright\\scriptsize ", column_width);
  for (std::size_t n = 0; n < notes.size(); ++n)
    text += (n > 0 ? "; " : "") + ("$^{\\mathrm{" + letter(n) + "}}$") + breakable(notes[n]);
  text += "}\\par\n";
  return text;
}

/// Lines of rows [begin, end), with their headings.
std::size_t lines_of(const LatexTable& table, Part part, std::size_t begin, std::size_t end) {
  std::size_t lines = 2;
  std::vector<std::string> notes;
  double notes_width = 0;
  for (std::size_t r = begin; r < end; ++r) {
    const LatexRow& row = table.rows[r];
    if (!row.group.empty() && (r == begin || row.group != table.rows[r - 1].group)) ++lines;
    std::size_t most = lines_of(row.stub, widest_stub);
    for (std::size_t c = part.begin; c < part.end; ++c) {
      const LatexCell& cell = row.cells[c];
      most = std::max(most, lines_of(cell.text, widest_cell));
      if (cell.note.empty() || std::ranges::find(notes, cell.note) != notes.end()) continue;
      notes.push_back(cell.note);
      notes_width += latex_width(cell.note) + 8;
    }
    lines += most;
  }
  return lines + static_cast<std::size_t>(std::ceil(1.1 * notes_width / column_width));
}

std::string label_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
    out += plain ? c : '-';
  }
  return out;
}

std::string float_of(const LatexTable& table, const std::string& tabulars, bool continued) {
  return "\n\\begin{table}[!htbp]\n  \\centering\\footnotesize\\setlength{\\tabcolsep}{3pt}\n  \\caption{" +
         breakable(table.caption + (continued ? " (continued)." : "." + table.remarks)) + "}\n" +
         (continued ? "" : "  \\label{tab:" + label_text(table.label) + "}\n") + "  \\smallskip\n" + tabulars +
         "\\end{table}\n";
}

}  // namespace

double latex_width(std::string_view text) {
  double em = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80 && byte < 0xC0) continue;  // continues a character
    em += byte >= 32 && byte < 127 ? character_widths[byte - 32] / 1000.0 : 0.85;
  }
  return 8 * em;
}

LatexCell cell_with_note(const std::string& text) {
  const std::size_t at = text.find(" (");
  if (at == std::string::npos || text.back() != ')') return {text};
  return {text.substr(0, at), false, text.substr(at + 2, text.size() - at - 3)};
}

std::string latex_table(const LatexTable& table) {
  std::string text, tabulars;
  bool continued = false;
  const std::size_t room = lines_a_float - std::min<std::size_t>(5, lines_of(table.caption + table.remarks, 250));
  std::size_t lines = 0;
  const auto flush = [&] {
    if (tabulars.empty()) return;
    text += float_of(table, tabulars, continued);
    continued = true;
    tabulars.clear();
    lines = 0;
  };
  for (const Part part : table.rows.empty() ? std::vector<Part>{} : parts_of(table)) {
    for (std::size_t begin = 0, end; begin < table.rows.size(); begin = end) {
      end = begin + 1;
      while (end < table.rows.size() && lines_of(table, part, begin, end + 1) <= room) ++end;
      const std::size_t needed = lines_of(table, part, begin, end);
      if (lines + needed > room) flush();
      if (!tabulars.empty()) tabulars += "  \\medskip\n";
      tabulars += tabular(table, part, begin, end);
      lines += needed;
    }
  }
  flush();
  return text;
}

}  // namespace photonproof::inline reports_paper
