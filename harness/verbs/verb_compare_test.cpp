#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "harness/metrics/metric_rows.h"
#include "harness/metrics/test_images.h"
#include "harness/verbs/verbs.h"
#include "scenes/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_verbs {
namespace {

class CompareVerb : public FolderTest {
 protected:
  std::string write(const std::string& name, const Image& image) {
    write_exr((folder_ / name).string(), {image, std::nullopt, {}});
    return (folder_ / name).string();
  }

  /// A reference of all ones and a test a quarter darker: mse 0.0625, bias -0.25.
  std::string reference() { return write("reference.exr", constant_image(12, 14, 1, 1, 1)); }
  std::string darker() { return write("darker.exr", constant_image(12, 14, 0.75f, 0.75f, 0.75f)); }

  struct Run {
    int exit_code;
    std::string out, err;
  };
  /// `compare` with these arguments; what it throws (wrong usage) passes through.
  Run compare(std::vector<std::string> arguments) {
    CLI::App program;
    Run run{-1, {}, {}};
    add_compare_verb(program, run.exit_code);
    arguments.insert(arguments.begin(), "compare");
    std::reverse(arguments.begin(), arguments.end());  // CLI11 takes a vector last argument first
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    try {
      program.parse(arguments);
    } catch (...) {
      testing::internal::GetCapturedStdout();
      testing::internal::GetCapturedStderr();
      throw;
    }
    run.out = testing::internal::GetCapturedStdout();
    run.err = testing::internal::GetCapturedStderr();
    return run;
  }
};

TEST_F(CompareVerb, prints_a_metric_a_line_with_its_parameters) {
  const Run run = compare({reference(), darker(), "--exposure", "-1"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_NE(run.out.find("darker.exr, 12 x 14 pixels\n"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("\nmse                     0.0625          \n"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("\nbias                    -0.25           \n"), std::string::npos) << run.out;
  // 0.25^2/(1 + 0.01)
  EXPECT_NE(run.out.find("\nrelmse                  0.061881188     epsilon=0.01\n"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("exposure=-1, pixels_per_degree=67.0206\n"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("\nverdict: ok\n"), std::string::npos) << run.out;
}

// 188 of 255 is 0.502886 as linear light: ((188/255 + 0.055) / 1.055)^2.4. Its squared distance from 1 is 0.247122;
// that of the encoded value, 0.737255, would be 0.069035.
TEST_F(CompareVerb, says_that_eight_bits_are_made_linear) {
  const std::string png = (folder_ / "test.png").string();
  {
    PngRows rows(png, 12, 14);
    rows.add(14, std::vector<std::uint8_t>(3 * 12 * 14, 188).data());
    rows.finish();
  }
  const Run run = compare({reference(), png, "--metrics", "mse"});
  EXPECT_NE(run.out.find("\ntest read as: 8-bit, made linear from sRGB\n"), std::string::npos) << run.out;
  EXPECT_EQ(run.out.find("reference read as"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("\nmse                     0.24712"), std::string::npos) << run.out;
  const Run json = compare({reference(), png, "--metrics", "mse", "--json"});
  const auto record = nlohmann::json::parse(json.out);
  EXPECT_EQ(record.at("test_read_as"), nlohmann::json({"8-bit, made linear from sRGB"}));
  EXPECT_EQ(record.at("reference_read_as"), nlohmann::json::array());
}

TEST_F(CompareVerb, layer_of_images_without_any_is_an_error) {
  const Run run = compare({reference(), darker(), "--layer", "Combined"});
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_EQ(run.err, "--layer: error: both images are plain R, G, B and have no layers\n");
}

TEST_F(CompareVerb, exit_code_is_that_of_the_worst_broken_bound) {
  const std::string ref = reference();
  const std::string test = darker();
  EXPECT_EQ(compare({ref, test, "--warn", "mse=0.1", "--fail", "mse=0.1"}).exit_code, 0);
  EXPECT_EQ(compare({"--warn", "mse=0.01", ref, test, "--fail", "mse=0.1"}).exit_code, 1);
  const Run run = compare({ref, test, "--fail", "mse=0.01", "--warn", "mse=0.001", "--warn", "bias=0.1"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.out.find("\nwarn: mse 0.0625 is over its maximum 0.001\n"
                         "warn: bias -0.25 is in absolute value over its maximum 0.1\n"
                         "fail: mse 0.0625 is over its maximum 0.01\nverdict: fail\n"),
            std::string::npos)
      << run.out;
}

TEST_F(CompareVerb, value_that_is_not_finite_fails_with_its_place) {
  Image image = constant_image(12, 14, 1, 1, 1);
  image.pixel(3, 7)[2] = std::numeric_limits<float>::quiet_NaN();
  const Run run = compare({reference(), write("nan.exr", image)});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.out.find("\nfail: pixel (3, 7) of the test image is NaN in B; 1 non-finite in all\n"),
            std::string::npos)
      << run.out;
  EXPECT_EQ(run.out.find("mse"), std::string::npos) << "no metric may run";
}

TEST_F(CompareVerb, parts_of_images_are_compared_where_both_store_pixels) {
  // Each is a part of 12 x 14 pixels; the test's are all 1.5, the reference's 1: mse .25. Were they compared as
  // displayed, the black around them would count, too, and mse be .25 / 168 for each of the part's pixels.
  const auto part = [&](const std::string& name, float value, const std::optional<ImagePlace>& place, int width) {
    Rendering rendering;
    rendering.mean = constant_image(width, 3, value, value, value);
    rendering.variance = constant_image(width, 3, 0.01f, 0.01f, 0.01f);
    rendering.place = place;
    write_exr((folder_ / name).string(), rendering);
    return (folder_ / name).string();
  };
  const ImagePlace place{5, 8, 12, 14};
  const std::string ref = part("ref.exr", 1, place, 4), test = part("test.exr", 1.5f, place, 4);
  auto record = nlohmann::json::parse(compare({ref, test, "--json"}).out);
  EXPECT_EQ(record.at("metrics").at(0).at("value"), 0.25);
  EXPECT_EQ(record.at("region"), (std::vector<int>{5, 8, 4, 3}));
  EXPECT_EQ(record.at("note"), nullptr);
  EXPECT_EQ(compare({ref, ref, "--agreement"}).exit_code, 0);

  // An engine that writes the part as an image of its own.
  record = nlohmann::json::parse(compare({ref, part("plain.exr", 1.5f, {}, 4), "--json"}).out);
  EXPECT_EQ(record.at("metrics").at(0).at("value"), 0.25);

  // Against the whole image, where a part is black elsewhere: the note says how to leave that out.
  Run run = compare({reference(), test});
  EXPECT_NE(run.out.find("note: the reference stores the pixels 0 0 12 14 (x y width height), the test image 5 8 4 3; "
                         "others count as black; --region 5 8 4 3 compares the part that both store\n"),
            std::string::npos)
      << run.out;
  record = nlohmann::json::parse(compare({reference(), test, "--json"}).out);
  EXPECT_NEAR(record.at("metrics").at(0).at("value").get<double>(), (156 * 1 + 12 * 0.25) / 168, 1e-7);
  record = nlohmann::json::parse(compare({reference(), test, "--region", "5", "8", "4", "3", "--json"}).out);
  EXPECT_EQ(record.at("metrics").at(0).at("value"), 0.25);
  EXPECT_EQ(compare({ref, part("wide.exr", 1, {}, 5)}).exit_code, 3);
}

TEST_F(CompareVerb, sizes_that_differ_give_three) {
  const Run run = compare({reference(), write("wide.exr", constant_image(14, 12, 1, 1, 1)), "--fail", "mse=1"});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_NE(run.out.find("size_mismatch: the test image is 14x12 pixels, the reference image 12x14\n"),
            std::string::npos)
      << run.out;
}

TEST_F(CompareVerb, missing_or_damaged_file_gives_four) {
  const std::string missing = (folder_ / "missing.exr").string();
  const Run run = compare({reference(), missing});
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_EQ(run.err, missing + ": error: no such file\n");

  const std::string whole = read_file(reference());
  write_file_atomically(folder_ / "cut.exr", whole.substr(0, whole.size() / 2));
  EXPECT_EQ(compare({reference(), (folder_ / "cut.exr").string()}).exit_code, 4);
  write_file_atomically(folder_ / "text.exr", "no image");
  EXPECT_EQ(compare({(folder_ / "text.exr").string(), reference()}).exit_code, 4);
}

TEST_F(CompareVerb, heatmaps_that_cannot_be_written_give_four) {
  write_file_atomically(folder_ / "file", "");
  EXPECT_EQ(compare({reference(), darker(), "--heatmaps", (folder_ / "file").string()}).exit_code, 4);
}

TEST_F(CompareVerb, writes_heatmaps_named_after_the_test_image) {
  EXPECT_EQ(compare({reference(), darker(), "--heatmaps", (folder_ / "maps").string()}).exit_code, 0);
  EXPECT_EQ(read_image((folder_ / "maps" / "darker-flip.png").string()).width, 12);
  EXPECT_EQ(read_image((folder_ / "maps" / "darker-error.png").string()).height, 14);
}

TEST_F(CompareVerb, region_and_mask_choose_pixels_and_are_printed) {
  // Right of column 8 the test image is 2, elsewhere it equals the reference: mse 4/12 overall.
  Image image = constant_image(12, 14, 1, 1, 1), mask = constant_image(12, 14, 0, 0, 0);
  for (int y = 0; y < 14; ++y)
    for (int x = 8; x < 12; ++x)
      for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = 2;
  for (int y = 0; y < 14; ++y) mask.pixel(7, y)[1] = mask.pixel(8, y)[2] = 1;
  const std::string ref = reference(), test = write("step.exr", image), chosen = write("mask.exr", mask);
  Run run = compare({ref, test, "--region", "8", "0", "4", "5", "--json"});
  auto record = nlohmann::json::parse(run.out);
  EXPECT_EQ(record.at("region"), (std::vector<int>{8, 0, 4, 5}));
  EXPECT_EQ(record.at("width"), 4);
  EXPECT_EQ(record.at("metrics").at(0).at("value"), 1);
  run = compare({ref, test, "--mask", chosen, "--json"});
  record = nlohmann::json::parse(run.out);
  EXPECT_EQ(record.at("mask"), chosen);
  EXPECT_EQ(record.at("metrics").at(0).at("value"), 0.5);
  EXPECT_EQ(record.at("metrics").at(0).at("parameters"), "mask=" + chosen);
  run = compare({ref, test, "--mask", chosen, "--region", "8", "2", "4", "5"});
  EXPECT_NE(run.out.find("\nmse                     1               region=8 2 4 5, mask=" + chosen + "\n"),
            std::string::npos)
      << run.out;
}

TEST_F(CompareVerb, region_or_mask_that_cannot_be_is_one_error) {
  Run run = compare({reference(), darker(), "--region", "8", "0", "5", "5"});
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_EQ(run.err, "--region: error: 8 0 5 5 is no part of the image of 12x14 pixels\n");
  const std::string black = write("black.exr", constant_image(12, 14, 0, 0, 0));
  run = compare({reference(), darker(), "--mask", black});
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_EQ(run.err, black + ": error: mask chooses no pixel: all of them are 0\n");
  const std::string small = write("small.exr", constant_image(2, 2, 1, 1, 1));
  run = compare({reference(), darker(), "--mask", small});
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_EQ(run.err, small + ": error: mask is 2x2 pixels, what it should choose from 12x14\n");
}

TEST_F(CompareVerb, metrics_that_are_named_are_computed_alone_with_those_that_have_a_bound) {
  const std::string ref = reference(), test = darker();
  const auto names = [](const Run& run) {
    std::vector<std::string> found;
    const auto record = nlohmann::json::parse(run.out);
    for (const auto& metric : record.at("metrics")) found.push_back(metric.at("name"));
    return found;
  };
  EXPECT_EQ(names(compare({ref, test, "--json", "--metrics", "ssim,mse"})), (std::vector<std::string>{"mse", "ssim"}));
  EXPECT_EQ(names(compare({ref, test, "--json", "--metrics", "mse", "--warn", "flip=0.1"})),
            (std::vector<std::string>{"mse", "flip"}));
  EXPECT_THROW(compare({ref, test, "--metrics", "mse,ssmi"}), InputError);
  // Heat maps show the same whatever is printed.
  compare({ref, test, "--heatmaps", (folder_ / "all").string()});
  compare({ref, test, "--metrics", "mse", "--heatmaps", (folder_ / "few").string()});
  for (const std::string name : {"darker-flip.png", "darker-error.png"})
    EXPECT_EQ(read_file(folder_ / "all" / name), read_file(folder_ / "few" / name));
}

TEST_F(CompareVerb, hdr_flip_is_computed_for_a_bound_or_by_name) {
  const std::string ref = reference(), test = darker();
  EXPECT_EQ(compare({ref, test}).out.find("\nhdr_flip"), std::string::npos);
  EXPECT_NE(compare({ref, test, "--hdr-flip"}).out.find("\nhdr_flip "), std::string::npos);
  EXPECT_NE(compare({ref, test, "--metrics", "hdr_flip"}).out.find("\nhdr_flip "), std::string::npos);
  EXPECT_NE(compare({ref, test, "--metrics", "mse", "--hdr-flip"}).out.find("\nhdr_flip "), std::string::npos);
  const Run run = compare({ref, test, "--fail", "hdr_flip=0.001", "--exposures", "-2", "1", "4"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.out.find("tone_mapper=ACES, exposures=-2 1 4, pixels_per_degree=67.0206\n"), std::string::npos)
      << run.out;
  EXPECT_THROW(compare({ref, test, "--hdr-flip", "--exposures", "1", "-2", "4"}), InputError);
  EXPECT_THROW(compare({ref, test, "--hdr-flip", "--exposures", "1", "2", "0"}), InputError);
  EXPECT_THROW(compare({ref, test, "--hdr-flip", "--exposures", "1", "2", "x"}), InputError);
}

TEST_F(CompareVerb, every_parameter_of_a_metric_is_an_option_and_printed_with_its_value) {
  const std::string ref = reference(), test = darker();
  for (const MetricParameter& parameter : metric_parameters) {
    std::vector<std::string> arguments = {ref, test, "--json", "--" + std::string(parameter.name)};
    std::ranges::replace(arguments.back(), '_', '-');
    std::string value;
    for (const double number : example_of(parameter)) {
      arguments.push_back(format_number(number));
      value += (value.empty() ? "" : " ") + arguments.back();
    }
    for (const MetricRow& row : metric_rows())
      if (has_parameter(row, parameter)) arguments.insert(arguments.end(), {"--metrics", row.name});
    const auto record = nlohmann::json::parse(compare(arguments).out);
    EXPECT_GT(record.at("metrics").size(), 0u);
    for (const auto& metric : record.at("metrics"))
      EXPECT_NE(metric.at("parameters").get<std::string>().find(parameter.name + ("=" + value)), std::string::npos)
          << metric;
  }
}

TEST_F(CompareVerb, json_holds_every_metric_and_says_which_have_no_number) {
  const std::string ref = write("small.exr", constant_image(8, 8, 1, 1, 1));
  const Run run = compare({ref, ref, "--json", "--fail", "ssim=0.9"});
  EXPECT_EQ(run.exit_code, 2);
  const auto record = nlohmann::json::parse(run.out);
  EXPECT_EQ(record.at("verdict"), "fail");
  EXPECT_EQ(record.at("width"), 8);
  EXPECT_EQ(
      record.at("findings").at(0).at("sentence"),
      "ssim has no value here (a side is under 11 pixels, or the mask has no whole window), so its bound is not kept");
  std::map<std::string, nlohmann::json> metrics;
  for (const auto& metric : record.at("metrics")) metrics[metric.at("name")] = metric;
  EXPECT_EQ(metrics.at("mse").at("value"), 0);
  EXPECT_TRUE(metrics.at("psnr").at("value").is_null());
  EXPECT_EQ(metrics.at("psnr").at("undefined"), "infinite: the images are equal once encoded");
  EXPECT_TRUE(metrics.at("ssim").at("value").is_null());
  EXPECT_EQ(metrics.at("ssim").at("undefined"), "a side is under 11 pixels, or the mask has no whole window");
}

TEST_F(CompareVerb, json_reports_file_errors_too) {
  const Run run = compare({reference(), (folder_ / "missing.exr").string(), "--json"});
  EXPECT_EQ(run.exit_code, 4);
  const auto record = nlohmann::json::parse(run.out);
  EXPECT_EQ(record.at("verdict"), "file_error");
  EXPECT_EQ(record.at("metrics").size(), 0u);
}

// A block's mean is off by 0.05 of 0.1 sqrt(2) / 8, which independent pixels do not allow.
TEST_F(CompareVerb, agreement_of_shared_noise_warns_that_it_is_inconclusive) {
  const auto write_noisy = [&](const std::string& name, float value) {
    write_exr((folder_ / name).string(),
              {constant_image(16, 16, value, value, value), constant_image(16, 16, 0.01f, 0.01f, 0.01f), {}});
    return (folder_ / name).string();
  };
  const std::string ref = write_noisy("a.exr", 1), test = write_noisy("b.exr", 1.05f);
  EXPECT_EQ(compare({ref, test, "--agreement"}).exit_code, 2);
  const Run run = compare({ref, test, "--agreement", "--shared-noise"});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.out.find("agreement: inconclusive; "), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("warn: agreement is inconclusive: pixels share noise"), std::string::npos) << run.out;
  const auto record = nlohmann::json::parse(compare({ref, test, "--agreement", "--shared-noise", "--json"}).out);
  EXPECT_EQ(record.at("agreement").at("pass"), false);
  EXPECT_EQ(record.at("agreement").at("inconclusive"), true);
}

TEST_F(CompareVerb, agreement_fails_beyond_the_noise_and_needs_variances) {
  const auto write_noisy = [&](const std::string& name, float value) {
    write_exr((folder_ / name).string(),
              {constant_image(16, 16, value, value, value), constant_image(16, 16, 0.01f, 0.01f, 0.01f), {}});
    return (folder_ / name).string();
  };
  // Deviations of 0.1 a side: 0.05 is 0.35 of a pixel's difference, but 2.8 of a block's mean: chi^2 of 4 blocks 32.
  const std::string ref = write_noisy("a.exr", 1);
  const Run pass = compare({ref, write_noisy("b.exr", 1.01f), "--agreement"});
  EXPECT_EQ(pass.exit_code, 0);
  // Each channel's mean is tested at 1 - 0.99^(1/9) = 0.00111608, whose two-sided quantile is 3.2595. The quantile of
  // 0.99 is 2.3263. The sum is 5.5858 deviations: d = 5.5858 sqrt((1 + (1 + d)^2) 0.01/256).
  EXPECT_NE(pass.out.find("agreement: pass; an error of 5.1 % of the whole image would have been seen (probability "
                          "0.99)\n"),
            std::string::npos)
      << pass.out;
  const Run json = compare({ref, write_noisy("b.exr", 1.01f), "--agreement", "--json"});
  const auto passed = nlohmann::json::parse(json.out).at("agreement");
  EXPECT_NEAR(passed.at("would_see"), 0.050638, 1e-5);
  EXPECT_EQ(passed.at("power"), 0.99);
  EXPECT_EQ(passed.at("whole").at("pass"), true);
  const Run run = compare({ref, write_noisy("c.exr", 1.05f), "--agreement", "--json"});
  EXPECT_EQ(run.exit_code, 2);
  const auto record = nlohmann::json::parse(run.out).at("agreement");
  EXPECT_EQ(record.at("pass"), false);
  EXPECT_EQ(record.at("pixels").at("pass"), true);
  EXPECT_NEAR(record.at("blocks").at("observed"), 32, 0.1);
  // The means over 256 pixels differ by 5.657 of their deviations, sqrt(2 0.01/256) = 0.008839.
  EXPECT_NEAR(record.at("whole").at("observed"), 5.657, 0.01);
  EXPECT_EQ(compare({ref, darker(), "--agreement"}).exit_code, 3) << "sizes differ";
  EXPECT_EQ(compare({reference(), darker(), "--agreement"}).exit_code, 4) << "no variances";
}

TEST_F(CompareVerb, wrong_usage_is_refused_before_any_file_is_read) {
  EXPECT_THROW(compare({"missing.exr", "missing.exr", "--fail", "ssmi=1"}), InputError);
  EXPECT_THROW(compare({"missing.exr"}), CLI::ParseError);
  EXPECT_THROW(compare({"missing.exr", "missing.exr", "--exposure", "nan"}), CLI::ParseError);
  EXPECT_THROW(compare({"missing.exr", "missing.exr", "--exposure", "65"}), CLI::ParseError);
}

TEST_F(CompareVerb, heat_map_never_replaces_an_image_that_is_read) {
  const std::string reference = (folder_ / "darker-flip.png").string();
  write_png(reference, constant_image(12, 14, 1, 1, 1));
  const std::string before = read_file(reference);
  const Run run = compare({reference, darker(), "--heatmaps", folder_.string()});
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_EQ(run.err, reference + ": error: is an image that is read, which it would replace\n");
  EXPECT_EQ(read_file(reference), before);
}

}  // namespace
}  // namespace photonproof::inline harness_verbs
