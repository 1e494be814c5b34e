#include "scenes/description/spectrum.h"

#include <gtest/gtest.h>

#include "scenes/description/named_ior.h"

namespace photonproof::inline scenes_description {
namespace {

void expect_near(const RgbD& found, const RgbD& expected, double tolerance) {
  EXPECT_NEAR(found.x, expected.x, tolerance);
  EXPECT_NEAR(found.y, expected.y, tolerance);
  EXPECT_NEAR(found.z, expected.z, tolerance);
}

TEST(spectrum, of_a_constant_reflectance_is_grey) {
  // Under D65, the white of Rec. 709. The last of Mitsuba's 1000 steps is missing from its interval: 0.1 %.
  expect_near(rgb_of_spectrum({{360, 0.5}, {830, 0.5}}, SpectrumKind::reflectance), RgbD(0.5), 1e-3);
}

TEST(spectrum, of_an_emission_alike_at_all_wavelengths_is_the_equal_energy_white) {
  // XYZ = (1, 1, 1): the row sums of the matrix from XYZ to Rec. 709.
  const RgbD white(1.204794, 0.948291, 0.908916);
  expect_near(rgb_of_spectrum({{300, 2}, {900, 2}}, SpectrumKind::emission), 2 * white, 4e-3);
}

TEST(spectrum, of_the_cornell_boxs_light_is_orange) {
  // The light of Mitsuba's Cornell box; the numbers come from a second implementation of the rule (in Python, in double
  // precision, with the wavelengths found by bisection).
  expect_near(rgb_of_spectrum({{400, 0}, {500, 8}, {600, 15.6}, {700, 18.4}}, SpectrumKind::emission),
              RgbD(20.7108371793152, 10.854634321204234, 2.7711518204657413), 1e-9);
}

TEST(spectrum, outside_the_gamut_is_cut_at_zero) {
  // A laser line at 520 nm has negative red and blue in Rec. 709.
  const RgbD green = rgb_of_spectrum({{519, 0}, {520, 1}, {521, 0}}, SpectrumKind::emission);
  EXPECT_EQ(green.x, 0);
  EXPECT_GT(green.y, 0);
  EXPECT_EQ(green.z, 0);
}

TEST(spectrum, outside_the_visible_range_is_black) {
  EXPECT_EQ(rgb_of_spectrum({{100, 1}, {300, 1}}, SpectrumKind::emission), RgbD(0.0));
  EXPECT_EQ(rgb_of_spectrum({{900, 1}, {1000, 1}}, SpectrumKind::reflectance), RgbD(0.0));
}

TEST(conductors, have_the_reduction_of_their_measurements) {
  // The index of gold from luxpop.com, the source of the table's row.
  const std::vector<SpectrumSample> eta = {
      {354.240509, 1.74},  {359.374420, 1.727625}, {364.659332, 1.716}, {370.102020, 1.705875},
      {375.709625, 1.696}, {381.489777, 1.68475},  {387.450562, 1.674}, {393.600555, 1.666},
      {399.948975, 1.658}, {406.505493, 1.64725},  {413.280579, 1.636}, {420.285339, 1.628},
      {427.531647, 1.616}, {435.032196, 1.59625},  {442.800629, 1.562}, {450.851562, 1.502125},
      {459.200653, 1.426}, {467.864838, 1.345875}, {476.862213, 1.242}, {486.212463, 1.08675},
      {495.936707, 0.916}, {506.057861, 0.7545},   {516.600769, 0.608}, {527.592224, 0.49175},
      {539.061646, 0.402}, {551.040771, 0.3455},   {563.564453, 0.306}, {576.670593, 0.267625},
      {590.400818, 0.236}, {604.800842, 0.212375}, {619.920898, 0.194}, {635.816284, 0.17775},
      {652.548279, 0.166}, {670.184753, 0.161},    {688.800964, 0.16},  {708.481018, 0.160875},
      {729.318665, 0.164}, {751.419250, 0.1695},   {774.901123, 0.176}, {799.897949, 0.181375},
      {826.561157, 0.188}, {855.063293, 0.198125}};
  const RgbD found = rgb_of_spectrum(eta, SpectrumKind::emission), known = conductor_named("Au")->eta;
  // The table's author integrated with other steps, which shows in the fourth digit.
  expect_near(found, known, 1e-3 * known.z);
}

TEST(conductors, of_oxides_of_copper_have_the_reduction_of_their_measurements) {
  // The measurements of luxpop.com, after Palik, at the same wavelengths for both.
  const std::vector<double> wavelengths = {350.028015, 399.935028, 449.854980, 499.919006, 549.799988, 599.806030,
                                           649.789978, 700.056030, 750.029968, 799.871033, 849.759949};
  const auto reduced = [&](const std::vector<double>& values) {
    std::vector<SpectrumSample> samples;
    for (std::size_t i = 0; i < values.size(); ++i) samples.push_back({wavelengths[i], values[i]});
    return rgb_of_spectrum(samples, SpectrumKind::emission);
  };
  const ComplexIor black = *conductor_named("CuO"), red = *conductor_named("Cu2O");
  expect_near(reduced({2.24, 2.34, 2.45, 2.54, 2.58, 2.65, 2.72, 2.88, 2.97, 2.94, 2.81}), black.eta, 1e-4);
  expect_near(reduced({1.03, 0.87, 0.77, 0.68, 0.59, 0.5, 0.4, 0.31, 0.22, 0.11, 0.04}), black.k, 1e-4);
  expect_near(reduced({2.4, 2.8, 3.06, 3.12, 3.1, 3.02, 2.9, 2.83, 2.77, 2.7, 2.66}), red.eta, 1e-4);
  expect_near(reduced({1.44, 0.99, 0.6, 0.35, 0.19, 0.13, 0.1, 0.083, 0.07, 0.06, 0.053}), red.k, 1e-4);
  EXPECT_EQ(*conductor_named("CuO_palik"), black);
  EXPECT_EQ(*conductor_named("Cu2O_palik"), red);
}

TEST(conductors, are_known_by_mitsubas_names) {
  EXPECT_EQ(conductor_named("Cu")->k, RgbD(3.912949, 2.452848, 2.142188));
  EXPECT_EQ(conductor_named("Ir_palik")->eta, conductor_named("Ir")->eta);
  EXPECT_FALSE(conductor_named("copper").has_value());
  for (const std::string& name : conductor_names()) {
    const ComplexIor ior = *conductor_named(name);
    for (const double v : {ior.eta.x, ior.eta.y, ior.eta.z}) EXPECT_GT(v, 0) << name;
    for (const double v : {ior.k.x, ior.k.y, ior.k.z}) EXPECT_GE(v, 0) << name;
  }
}

}  // namespace
}  // namespace photonproof::inline scenes_description
