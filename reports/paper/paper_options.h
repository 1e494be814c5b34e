// Options of the formats for papers.
#pragma once

#include <string>
#include <vector>

namespace photonproof::inline reports_paper {

/// Side of a table that has the methods. With `columns`, each quantity is a table of scenes against methods.
enum class MethodsSide { rows, columns };

/// A crop: top left pixel and size, in pixels of the image; row 0 is on top.
struct Inset {
  int x = 0, y = 0, width = 0, height = 0;
};

struct PaperOptions {
  MethodsSide methods = MethodsSide::rows;
  std::vector<std::string> tables{};  ///< Names of the LaTeX tables to write (table_names). Empty: all.
  std::string scene{};                ///< The only scene to draw. Empty: all in plots, the only one in a figure.
  std::vector<Inset> insets{};        ///< Crops of a figure.
};

}  // namespace photonproof::inline reports_paper
