#include "reports/paper/inset_figure.h"

#include <gtest/gtest.h>

#include <fstream>

#include "reports/paper/paper_formats.h"
#include "reports/paper/test_figure_results.h"
#include "reports/record/heatmap_magma.h"
#include "scenes/base/input_error.h"
#include "scenes/files/file_checksum.h"

namespace photonproof::inline reports_paper {
namespace {

using namespace reports;

std::string complaint(const Results& results, const TemporaryFolder& folder, const PaperOptions& options,
                      const char* name = "out.pdf") {
  try {
    write_inset_figure(results, folder.path(), folder.path() / name, options);
  } catch (const InputError& error) {
    EXPECT_FALSE(std::filesystem::exists(folder.path() / name));
    return error.summary();
  }
  return "";
}

// The reference is 1 and 0.5; (1.5 - 1)^2 / (1 + 0.01) on one of four pixels, in all channels, else 0.
TEST(InsetFigure, error_of_a_crop_is_the_metric_of_its_pixels) {
  Image reference = even_image(4, 4, 1, 1, 1), image = reference;
  for (int c = 0; c < 3; ++c) image.pixel(2, 1)[c] = 1.5f;
  image.pixel(0, 0)[0] = 100;  // outside of the crop
  EXPECT_NEAR(crop_relmse(image, reference, {1, 1, 2, 2}), 0.25 / 1.01 / 4, 1e-12);
  image.pixel(1, 2)[1] = 0;  // one channel of three: 1 / 1.01 / 3
  EXPECT_NEAR(crop_relmse(image, reference, {1, 1, 2, 2}), (0.25 / 1.01 + 1 / 1.01 / 3) / 4, 1e-12);
}

// Linear 0.5 is 188 in 8-bit sRGB, and 0.25 is 137. Values above 1 are white.
TEST(InsetFigure, crop_is_the_exposed_part_in_srgb) {
  Image image = even_image(3, 2, 0, 0, 0);
  image.pixel(2, 1)[0] = 0.5f;
  image.pixel(2, 1)[1] = 7;
  const Pixels plain = crop_pixels(image, {1, 1, 2, 1}, 0);
  EXPECT_EQ(plain.width, 2);
  EXPECT_EQ(plain.rgb, (std::vector<std::uint8_t>{0, 0, 0, 188, 255, 0}));
  EXPECT_EQ(crop_pixels(image, {2, 1, 1, 1}, -1).rgb[0], 137);
}

TEST(InsetFigure, false_colour_goes_from_1e_minus_4_to_1) {
  const Image reference = even_image(3, 1, 0, 0, 0);  // the error is x^2 / 0.01
  Image image = reference;
  for (int c = 0; c < 3; ++c) {
    image.pixel(1, 0)[c] = 0.01f;  // 0.01, half way
    image.pixel(2, 0)[c] = 0.1f;   // 1
  }
  const Pixels pixels = error_pixels(image, reference, {0, 0, 3, 1});
  const auto color = [&](std::size_t i) {
    return static_cast<std::uint32_t>(pixels.rgb[3 * i] << 16 | pixels.rgb[3 * i + 1] << 8 | pixels.rgb[3 * i + 2]);
  };
  EXPECT_EQ(color(0), magma_colours[0]);
  EXPECT_TRUE(color(1) == magma_colours[127] || color(1) == magma_colours[128]);
  EXPECT_EQ(color(2), magma_colours[255]);
}

TEST(InsetFigure, columns_are_the_engines_and_the_reference_last) {
  const TemporaryFolder folder;
  const Results results = figure_results(folder.path());
  const View view = arrange(results);
  const auto columns = figure_columns(view, view.scenes[0], folder.path(), {{0, 0, 4, 4}});
  ASSERT_EQ(columns.size(), 3u);
  EXPECT_EQ(columns[0].title, "Photon mapper");
  EXPECT_EQ(columns[0].budget, "20\u202F000 photons, 4.50 s wall");
  EXPECT_EQ(columns[0].relmse, "relMSE 0.0125");
  EXPECT_NEAR(columns[0].crop_relmse.at(0), 0.25 / 1.01, 1e-9);
  EXPECT_EQ(columns[2].title, "Reference");
  EXPECT_EQ(columns[2].image.pixel(0, 0)[0], 1);
}

TEST(InsetFigure, what_cannot_be_shown_is_one_error_and_no_file) {
  const TemporaryFolder folder;
  const Results good = figure_results(folder.path());
  const PaperOptions box{.scene = "box"};
  EXPECT_EQ(complaint(good, folder, {}), "--scene: error: a figure shows one scene, and the record has 2");
  EXPECT_EQ(complaint(good, folder, box, "out.gif"),
            (folder.path() / "out.gif").string() + ": error: a figure is a file .pdf, .svg or .png");
  for (const Inset& inset : {Inset{5, 0, 4, 4}, Inset{-1, 0, 4, 4}, Inset{0, 0, 0, 4}, Inset{0, 2147483647, 4, 4}})
    EXPECT_NE(complaint(good, folder, {.scene = "box", .insets = {inset}}).find("is not inside the image of 8x8"),
              std::string::npos);
  Results results = good;
  results.results[1].image = "../photon.exr";
  EXPECT_NE(complaint(results, folder, box).find("box/photon/photons=20000/seed=1: error: "), std::string::npos);
  results.results[1].image.clear();
  EXPECT_EQ(complaint(results, folder, box), "box/photon/photons=20000/seed=1: error: the record has no image of it");
  results = good;
  results.results[1].image_checksum = "of another";
  EXPECT_EQ(complaint(results, folder, box),
            "box/photon/photons=20000/seed=1: error: its image photon.exr is not the one that was measured");
  results = good;
  write_exr((folder.path() / "photon.exr").string(), {even_image(4, 8, 1, 1, 1), {}, {}});
  EXPECT_EQ(complaint(results, folder, box),
            "box/photon/photons=20000/seed=1: error: has another size than the reference");
  EXPECT_EQ(complaint(good, folder, {.scene = "hole"}),
            "hole: error: has no reference, so a figure has no last column");
}

}  // namespace
}  // namespace photonproof::inline reports_paper
