// Drawings as files: fonts, sizes, colours, and the same bytes each time.
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <sstream>

#include "reports/paper/canvas.h"
#include "reports/paper/paper_formats.h"
#include "reports/paper/test_figure_results.h"
#include "scenes/base/input_error.h"
#include "scenes/base/process.h"

namespace photonproof::inline reports_paper {
namespace {

using namespace reports;

class Drawings : public testing::Test {
 protected:
  void SetUp() override {
    if (!can_draw()) GTEST_SKIP() << "built without Cairo (Debian: libcairo2-dev)";
  }
  std::filesystem::path file(const char* name) const { return folder_.path() / name; }
  TemporaryFolder folder_;
};

/// Fonts of a PDF by the program pdffonts: whether each is embedded.
std::map<std::string, bool> fonts_of(const std::filesystem::path& pdf) {
  std::map<std::string, bool> fonts;
  std::istringstream lines(run_process({"pdffonts", pdf.string()}).standard_output);
  const std::regex row(R"((\S+) +.* (yes|no) +(yes|no) +(yes|no) +\d+ +\d+)");
  std::smatch match;
  for (std::string line; std::getline(lines, line);)
    if (std::regex_match(line, match, row)) fonts[match[1]] = match[2] == "yes";
  return fonts;
}

TEST_F(Drawings, fonts_of_pdf_are_embedded) {
  if (!run_process({"pdffonts", "-v"}).ok()) GTEST_SKIP() << "no pdffonts here (Debian: poppler-utils)";
  write_pdf_report(sample_conclusions(), folder_.path(), file("plot.pdf"), {});
  write_inset_figure(figure_results(folder_.path()), folder_.path(), file("figure.pdf"), {.scene = "box"});
  for (const char* name : {"plot.pdf", "figure.pdf"}) {
    const auto fonts = fonts_of(file(name));
    EXPECT_GE(fonts.size(), 2u) << name;
    for (const auto& [font, embedded] : fonts) EXPECT_TRUE(embedded) << name << ": " << font;
    EXPECT_LT(std::filesystem::file_size(file(name)), 40'000u) << name;
  }
}

TEST_F(Drawings, svg_needs_no_font_and_no_other_file) {
  write_svg_report(sample_conclusions(), folder_.path(), file("plot.svg"), {});
  const std::string svg = file_text(file("plot.svg"));
  EXPECT_EQ(count(svg, "<text"), 0u);
  EXPECT_EQ(count(svg, "font-family"), 0u);
  EXPECT_EQ(count(svg, "<script"), 0u);
  for (std::size_t at = svg.find("href=\""); at != std::string::npos; at = svg.find("href=\"", at + 1))
    EXPECT_TRUE(svg.substr(at + 6, 1) == "#" || svg.substr(at + 6, 5) == "data:") << svg.substr(at, 60);
  EXPECT_LT(svg.size(), 120'000u);
}

TEST_F(Drawings, are_the_same_bytes_each_time) {
  for (const char* kind : {"svg", "pdf"}) {
    const auto write = std::string(kind) == "svg" ? write_svg_report : write_pdf_report;
    write(sample_conclusions(), folder_.path(), file("a"), {});
    write(sample_conclusions(), folder_.path(), file("b"), {});
    // Cairo numbers the surfaces of a process in SVG.
    const std::regex number("surface[0-9]+");
    EXPECT_TRUE(std::regex_replace(file_text(file("a")), number, "") ==
                std::regex_replace(file_text(file("b")), number, ""))
        << kind;
  }
}

// 300 pixels an inch of 72 points. Half of 1 is 188 in sRGB; povray's image is red, the reference white.
TEST_F(Drawings, png_of_a_figure_has_the_images_colours_side_by_side) {
  write_inset_figure(figure_results(folder_.path()), folder_.path(), file("figure.png"), {.scene = "box"});
  const Image image = read_image(file("figure.png").string());
  // Three columns of 90 pt and two gaps of 4 pt, and the last frame's half width.
  EXPECT_NEAR(image.width, (3 * 90 + 2 * 4 + 1) * 300.0 / 72, 1);
  const auto at = [&](double x_pt, double y_pt) {
    return image.pixel(static_cast<int>(x_pt * 300 / 72), static_cast<int>(y_pt * 300 / 72));
  };
  EXPECT_NEAR(at(45, 75)[0], 0.5, 0.005);
  EXPECT_NEAR(at(45, 75)[1], 0.5, 0.005);
  EXPECT_EQ(at(139, 75)[0], 1);
  EXPECT_EQ(at(139, 75)[1], 0);
  EXPECT_EQ(at(233, 75)[1], 1);
}

TEST_F(Drawings, unwritable_place_is_an_input_error) {
  EXPECT_THROW(write_svg_report(sample_conclusions(), folder_.path(), file("none") / "plot.svg", {}), InputError);
}

TEST_F(Drawings, record_without_errors_is_refused_and_nothing_is_written) {
  EXPECT_THROW(write_pdf_report(Results{}, folder_.path(), file("plot.pdf"), {}), InputError);
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

}  // namespace
}  // namespace photonproof::inline reports_paper
