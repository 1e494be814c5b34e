// Plots of error against time for \input, by the LaTeX package pgfplots: a tikzpicture for each scene.
#include <fmt/format.h>

#include "reports/paper/paper_formats.h"
#include "reports/paper/paper_plot.h"
#include "reports/paper/paper_words.h"
#include "reports/plots/log_axis.h"
#include "reports/view/numbers.h"
#include "reports/view/text.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline reports_paper {
using namespace reports;

namespace {

std::string color_name(std::size_t engine) { return fmt::format("photonproof{}", engine); }

/// Options of the lines and marks of a method.
std::string style_of(std::size_t engine, bool line, bool mark) {
  static constexpr const char* marks[] = {"*", "square*", "triangle*", "diamond*", "triangle*"};
  const MethodStyle style = method_style(engine);
  std::string text = color_name(engine);
  if (line) {
    text += ", line width=0.9pt";
    for (std::size_t i = 0; i < style.dash.size(); ++i)
      text += fmt::format("{}{} {:g}pt", i == 0 ? ", dash pattern=" : " ", i % 2 == 0 ? "on" : "off", style.dash[i]);
  }
  if (!mark) return text + ", no marks";
  return text + fmt::format(", mark={}, mark size={}pt, mark options={{solid{}}}", marks[style.mark],
                            style.mark == 3 ? "2.6" : "1.9", style.mark == 4 ? ", rotate=180" : "");
}

std::string coordinates(const std::vector<std::array<double, 2>>& points) {
  std::string text;
  for (const auto& [x, y] : points) text += fmt::format(" ({:.6g},{:.6g})", x, y);
  return text;
}

std::string series_text(const PlotSeries& series) {
  std::string text;
  const std::string color = color_name(series.engine);
  for (const auto& band : interval_bands(series))
    text += "  \\addplot[" +
            (band.size() > 2 ? "draw=none, fill=" + color + ", fill opacity=0.2" : color + ", no marks") +
            ", forget plot] coordinates {" + coordinates(band) + " }" + (band.size() > 2 ? " -- cycle" : "") + ";\n";
  std::vector<std::array<double, 2>> points;
  for (const PlotPoint& point : series.points) points.push_back({point.seconds, point.relmse});
  const auto fit = fitted_line(series);
  if (fit)
    text += "  \\addplot[" + style_of(series.engine, true, false) + ", forget plot] coordinates {" +
            coordinates({{fit->seconds[0], fit->relmse[0]}, {fit->seconds[1], fit->relmse[1]}}) + " };\n";
  return text + "  \\addplot[" + style_of(series.engine, !fit, true) + (fit ? ", only marks" : "") +
         ", forget plot] coordinates {" + coordinates(points) + " };\n";
}

std::string picture(const PaperPlot& plot, const View& view, const std::vector<std::string>& titles) {
  std::string text = "\n\\begin{tikzpicture}\n";
  for (const std::size_t engine : plotted_engines({plot}))
    text += "  \\definecolor{" + color_name(engine) + "}{HTML}{" + method_style(engine).color + "}\n";
  text +=
      "  \\begin{axis}[xmode=log, ymode=log, scale only axis, width=0.77\\columnwidth, height=0.52\\columnwidth,\n"
      "    title={" +
      latex_text(plot.scene) + "}, xlabel={" + time_axis_title(plot.plot.clock) +
      "}, ylabel={relMSE},\n"
      "    font=\\footnotesize, grid=major, grid style={black!12}, legend cell align=left,\n"
      "    legend style={font=\\scriptsize, draw=none, fill opacity=0.8, text opacity=1}]\n";
  for (const double target : plot.plot.targets) {
    ValueRange seconds;
    for (const PlotSeries& series : plot.plot.series)
      for (const PlotPoint& point : series.points) seconds.hold(point.seconds);
    text += "  \\addplot[black!55, densely dotted, no marks, forget plot] coordinates {" +
            coordinates({{seconds.low, target}, {seconds.high, target}}) +
            " } node[pos=0, above right, font=\\scriptsize] {target " + latex_text(significant(target)) + "};\n";
  }
  for (const PlotSeries& series : plot.plot.series) text += series_text(series);
  for (const std::size_t engine : plotted_engines({plot}))
    text += "  \\addlegendimage{" + style_of(engine, true, true) + "}\n  \\addlegendentry{" +
            latex_text(engine < view.engines.size() ? titles[engine] : "") + "}\n";
  return text + "  \\end{axis}\n\\end{tikzpicture}\n";
}

}  // namespace

void write_pgfplots_report(const Results& results, const std::filesystem::path&, const std::filesystem::path& out,
                           const PaperOptions& options) {
  const View view = arrange(results);
  const std::vector<std::string> titles = method_titles(view);
  std::string text = "% Made by photonproof from results.json of the suite " + ascii_text(results.suite) + ", " +
                     ascii_text(time_text(results.created)) + ".\n% Repeat with: " + ascii_text(results.command) +
                     "\n% Needs \\usepackage{pgfplots} and \\pgfplotsset{compat=1.16}. Bands are 95 % intervals over "
                     "seeds, lines least squares fits.\n";
  for (const PaperPlot& plot : paper_plots(view, options)) text += picture(plot, view, titles);
  write_file_atomically(out, text);
}

}  // namespace photonproof::inline reports_paper
