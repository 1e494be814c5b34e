// Compiles tables by pdflatex in the three classes whose columns they must fit.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "reports/paper/paper_formats.h"
#include "reports/view/test_sample_results.h"
#include "scenes/base/process.h"

namespace photonproof::inline reports_paper {
namespace {

using namespace reports;

bool has_pdflatex() {
  return run_process({"pdflatex", "--version"}).ok() && run_process({"kpsewhich", "acmart.cls"}).ok() &&
         run_process({"kpsewhich", "hyperxmp.sty"}).ok() && run_process({"kpsewhich", "beamer.cls"}).ok();
}

constexpr const char* packages =
    "no pdflatex with acmart and beamer here (Debian: texlive-latex-recommended texlive-publishers texlive-latex-extra "
    "texlive-pictures)";

/// A document of each class that shows the tables; a slide has one float.
std::string document(const std::string& name, const std::string& tables) {
  if (name == "article")
    return "\\documentclass[a4paper,twocolumn]{article}\\usepackage{booktabs}\n\\begin{document}\n" + tables +
           "\\end{document}\n";
  // acmart balances the columns of the last page, and cannot do so with floats: text follows, as in a paper.
  if (name == "acmart")
    return "\\documentclass[sigconf,nonacm]{acmart}\n\\begin{document}\\title{T}\\author{A}\\maketitle Text.\n" +
           tables + "\\clearpage Text.\\end{document}\n";
  std::string slides;
  for (std::size_t at = tables.find("\\begin{table}"); at != std::string::npos;) {
    const std::size_t next = tables.find("\\begin{table}", at + 1);
    slides += "\\begin{frame}\n" + tables.substr(at, next == std::string::npos ? next : next - at) + "\\end{frame}\n";
    at = next;
  }
  return "\\documentclass{beamer}\\usepackage{booktabs}\n\\begin{document}\n" + slides + "\\end{document}\n";
}

/// Lines of TeX's log that tell of a box that is too wide or too high, a missing character or an error.
std::string problems_of(const std::string& text) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "main.tex") << text;
  ProcessOptions options;
  options.working_folder = folder.path();
  options.wall_limit_seconds = 120;
  const ProcessOutcome outcome = run_process({"pdflatex", "-interaction=nonstopmode", "main.tex"}, options);
  std::string problems = outcome.ok() ? "" : outcome.sentence() + "\n";
  std::istringstream log(file_text(folder.path() / "main.log"));
  for (std::string line; std::getline(log, line);)
    if (line.starts_with("Overfull") || line.starts_with("!") || line.starts_with("Missing character") ||
        line.find("Float too large") != std::string::npos)
      problems += line + "\n";
  return problems;
}

/// The sample with names, reasons and numbers as wide as records have.
Results wide_results() {
  Results results = sample_conclusions();
  results.title = "Path tracing, photon mapping & POV-Ray: 100 % of a_long_title_with_underscores_and_no_space";
  results.engines.push_back({"a-variant-of-an-engine-with-a-very-long-name", "", "1"});
  for (int i = 0; i < 12; ++i) {
    Result cell = finished("box", "a-variant-of-an-engine-with-a-very-long-name", {"photons", 1000000.0 * (1 << i)}, 1,
                           1.23456e-7 / (1 + i));
    results.results.push_back(cell);
    Convergence curve = sample_curve();
    curve.engine = i % 2 ? "path" : "a-variant-of-an-engine-with-a-very-long-name";
    curve.undefined["slope"] =
        "error grows from 0.0123 at spp=4 to 0.5 at spp=16: rare bright samples \u00b12 \u2264 3";
    if (i % 3 == 0) curve.slope.reset();
    results.convergence.push_back(curve);
  }
  results.races[0].times[1].engine = "a-variant-of-an-engine-with-a-very-long-name";
  return results;
}

TEST(LatexCompiled, tables_fit_a_column_of_three_classes) {
  if (!has_pdflatex()) GTEST_SKIP() << packages;
  const TemporaryFolder folder;
  for (const Results& results : {sample_conclusions(), wide_results()}) {
    for (const MethodsSide side : {MethodsSide::rows, MethodsSide::columns}) {
      write_latex_report(results, folder.path(), folder.path() / "out.tex", {.methods = side});
      const std::string tables = file_text(folder.path() / "out.tex");
      for (const char* name : {"article", "acmart", "beamer"})
        EXPECT_EQ(problems_of(document(name, tables)), "")
            << name << (side == MethodsSide::rows ? " rows" : " columns");
    }
  }
}

TEST(LatexCompiled, plots_fit_a_column_of_three_classes) {
  if (!has_pdflatex() || !run_process({"kpsewhich", "pgfplots.sty"}).ok()) GTEST_SKIP() << packages;
  const TemporaryFolder folder;
  write_pgfplots_report(wide_results(), folder.path(), folder.path() / "out.tex", {});
  const std::string plot = "\\usepackage{pgfplots}\\pgfplotsset{compat=1.16}\n";
  for (const char* name : {"article", "acmart", "beamer"}) {
    std::string text = document(name, "\\begin{table}\n" + file_text(folder.path() / "out.tex") + "\\end{table}\n");
    text.insert(text.find("\\begin{document}"), plot);
    EXPECT_EQ(problems_of(text), "") << name;
  }
}

TEST(LatexCompiled, too_wide_a_table_is_found) {
  if (!has_pdflatex()) GTEST_SKIP() << packages;
  const std::string wide = "\\begin{table}\\begin{tabular}{l}" + std::string(90, 'x') + "\\end{tabular}\\end{table}\n";
  for (const char* name : {"article", "acmart", "beamer"})
    EXPECT_EQ(problems_of(document(name, wide)).substr(0, 14), "Overfull \\hbox") << name;
}

}  // namespace
}  // namespace photonproof::inline reports_paper
