// Every fault that a failing gate names is planted in images with noise. The name must be right, and a healthy image or
// a fault elsewhere must not get one.
#include "harness/gates/named_fault.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <regex>
#include <string>
#include <vector>

#include "harness/pixels/display.h"

namespace photonproof::inline harness_gates {
namespace {

constexpr int width = 48, height = 40;

/// A picture that no turn, shift or exchange of channels leaves as it is.
double light(int x, int y, int c) {
  const double disc = std::hypot(x - 14.0, y - 22.0) < 9 ? 0.5 - 0.15 * c : 0;
  const double square = x > 30 && x < 41 && y > 8 && y < 17 ? 0.1 + 0.3 * c : 0;
  return 0.08 + 0.02 * c + 0.004 * y + 0.001 * x + disc + square;
}

using Pixels = std::function<double(int x, int y, int c)>;

std::string name_of(const Pixels& pixels, bool is_display_file = false) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(1, 0.03);
  Rendering reference{Image(width, height), Image(width, height), {}};
  std::vector<Image> images(8, Image(width, height));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) {
        const double error = 0.002 * light(x, y, c);
        reference.mean.pixel(x, y)[c] =
            static_cast<float>(light(x, y, c) + error * std::normal_distribution<double>()(random));
        reference.variance->pixel(x, y)[c] = static_cast<float>(error * error);
        for (Image& image : images) image.pixel(x, y)[c] = static_cast<float>(pixels(x, y, c) * noise(random));
      }
  std::vector<const Image*> pointers;
  for (const Image& image : images) pointers.push_back(&image);
  const auto fault = named_fault(reference, pointers, is_display_file);
  return fault ? fault->sentence : "";
}

TEST(NamedFault, healthy_images_have_none) { EXPECT_EQ(name_of(light), ""); }

TEST(NamedFault, turns_are_named) {
  EXPECT_EQ(name_of([](int x, int y, int c) { return light(width - 1 - x, y, c); }),
            "the image is mirrored left to right");
  EXPECT_EQ(name_of([](int x, int y, int c) { return light(x, height - 1 - y, c); }), "the image is upside down");
  EXPECT_EQ(name_of([](int x, int y, int c) { return light(width - 1 - x, height - 1 - y, c); }),
            "the image is turned by 180 degrees");
}

TEST(NamedFault, shifts_are_named_with_their_direction) {
  EXPECT_EQ(name_of([](int x, int y, int c) { return light(x - 1, y, c); }), "the image is shifted by 1 pixel right");
  EXPECT_EQ(name_of([](int x, int y, int c) { return light(x, y + 2, c); }), "the image is shifted by 2 pixels up");
  EXPECT_EQ(name_of([](int x, int y, int c) { return light(x + 1, y - 1, c); }),
            "the image is shifted by 1 pixel left and 1 pixel down");
}

TEST(NamedFault, exchanged_and_missing_channels_are_named) {
  EXPECT_EQ(name_of([](int x, int y, int c) { return light(x, y, 2 - c); }), "red and blue are exchanged");
  EXPECT_EQ(name_of([](int x, int y, int c) { return c == 1 ? 0 : light(x, y, c); }), "the green channel is black");
  EXPECT_EQ(name_of([](int, int, int) { return 0.0; }), "the image is black");
}

TEST(NamedFault, encodings_are_named_by_the_kind_of_file) {
  const auto encoded = [](int x, int y, int c) { return encode_srgb(light(x, y, c)); };
  EXPECT_EQ(name_of(encoded), "gamma is applied where linear values are expected");
  EXPECT_EQ(name_of(encoded, true), "gamma is applied twice");
  EXPECT_EQ(name_of([](int x, int y, int c) { return std::pow(light(x, y, c), 2.2); }, true),
            "gamma is missing: values are written linear");
}

// The dark rows 21 to 39 lie in three of five rows of blocks, the bright columns 0 to 15 in two of six columns.
TEST(NamedFault, one_factor_is_no_missing_light) {
  EXPECT_EQ(name_of([](int x, int y, int c) { return 0.98 * light(x, y, c); }),
            "the image is darker by 2 %, everywhere by the same factor");
  EXPECT_EQ(name_of([](int x, int y, int c) { return light(x, y, c) * (y > 20 ? 0.6 : 1); }),
            "light is missing: 60 % of all blocks are darker, none is brighter");
  EXPECT_EQ(name_of([](int x, int y, int c) { return light(x, y, c) * (x < 16 ? 1.3 : 1); }),
            "there is light too much: 33 % of all blocks are brighter, none is darker");
}

// A bluish light of a part of the picture: red loses a third of what blue loses.
TEST(NamedFault, a_light_with_a_colour_that_is_missing_is_named) {
  const auto without = [](double red, double green, double blue) {
    return name_of([=](int x, int y, int c) {
      const double share = c == 0 ? red : c == 1 ? green : blue;
      return light(x, y, c) * (x < 20 ? 1 - share : 1);
    });
  };
  EXPECT_EQ(without(0.3, 0.6, 0.9), "light is missing: 50 % of all blocks are darker, none is brighter");
  EXPECT_EQ(without(0, 0, 0.9), "") << "a channel that is wrong alone";
  EXPECT_EQ(without(0.1, 0.9, 0.9), "") << "red loses less than a quarter of what blue loses";
}

TEST(NamedFault, channels_that_are_scaled_apart_are_named_with_their_gains) {
  const std::string name = name_of([](int x, int y, int c) { return light(x, y, c) * (c == 0 ? 0.55 : 1.1); });
  EXPECT_TRUE(std::regex_match(
      name, std::regex(R"(the channels are scaled apart: R -(45\.0|44\.9|45\.1) %, G \+(9\.9|10\.[01]) %, )"
                       R"(B \+(9\.9|10\.[01]) %, everywhere by the same factor)")))
      << name;
}

// Half of the blocks are brighter and half darker, as by no change that has a name.
TEST(NamedFault, a_difference_without_a_name_gets_none) {
  EXPECT_EQ(name_of([](int x, int y, int c) { return light(x, y, c) * (x % 16 < 8 ? 0.7 : 1.3); }), "");
}

}  // namespace
}  // namespace photonproof::inline harness_gates
