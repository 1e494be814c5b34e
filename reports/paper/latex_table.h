// A LaTeX table that fits one column of `article` with two columns (221 pt), of `acmart` (241 pt) and a slide of
// `beamer` (307 pt). It needs the package booktabs only.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace photonproof::inline reports_paper {

struct LatexCell {
  std::string text;
  bool best = false;   ///< in bold
  std::string note{};  ///< a reason, printed once below the table and named by a letter
};

struct LatexRow {
  std::string group;  ///< heading above the rows that share it; may be empty
  std::string stub;   ///< first cell
  std::vector<LatexCell> cells;
};

struct LatexColumn {
  std::string title;
  bool is_text = false;  ///< left-aligned
};

struct LatexTable {
  std::string caption;  ///< without its full stop
  std::string remarks;  ///< more sentences of the caption, from the space on
  std::string label;
  std::string stub;  ///< title of the first column
  std::vector<LatexColumn> columns;
  std::vector<LatexRow> rows;
};

/// Texts are the record's, not escaped. Columns that do not fit beside each other follow below. A table that
/// is higher than a slide continues in another float. Long texts are wrapped. Empty without rows.
std::string latex_table(const LatexTable& table);

/// Upper bound of the width in pt of a text in \footnotesize (8 pt) of Computer Modern.
double latex_width(std::string_view text);

/// "0.05 (a reason)" as a cell with a note.
LatexCell cell_with_note(const std::string& text);

}  // namespace photonproof::inline reports_paper
