// The input of `photonproof grade` from staff: build, run, scenes, correctness and points for speed. The file is TOML;
// docs/formats/assignment.md has its keys.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/metrics/metric_bounds.h"
#include "reports/grades/grade_record.h"
#include "reports/record/results.h"

namespace photonproof::inline harness_grading {

/// Limits of a build or of a run.
struct AssignmentLimits {
  double seconds = 60;
  std::uint64_t memory_mb = 2048, file_mb = 64, disk_mb = 256, log_mb = 4;
  int processes = 64;
};

/// The meaning of the numbers in a submission's image file.
struct AssignmentImage {
  std::string format = "png";         ///< One of exr, pfm, hdr, png, bmp, tga, ppm.
  std::optional<double> gamma = 1.0;  ///< The gamma that decodes them, 1 for linear; empty: sRGB.
  bool bottom_up = false;             ///< The first row is the lowest.
  double scale = 1;                   ///< The factor by which they were multiplied.
  bool is_clamped() const { return format != "exr" && format != "pfm" && format != "hdr"; }
};

/// A scene that submissions render. A variant's description is made from another scene's (harness/variants).
struct AssignmentScene {
  std::string name;
  bool hidden = false;
  std::string of, variant;  ///< Name of the public scene and kind of the variant; empty: a scene of its own.
  std::uint64_t variant_seed = 1;
  std::filesystem::path path;                     ///< Our description; empty where there is none.
  std::filesystem::path params, params_template;  ///< The course's own scene file, or the template that makes it from
                                                  ///< our description.
  std::string params_place;                       ///< Its place in the run's folder; empty: none.
  std::vector<std::string> option;                ///< Arguments that select the scene.
  int width = 0, height = 0;                      ///< Before the variant changes them.
  double weight = 1;                              ///< Its share of the points for correctness.
  std::filesystem::path reference;                ///< An image with its variance, where references are files.
  std::filesystem::path given;                    ///< An image that students have; empty: none.
};

/// The source of the scenes' references.
struct ReferenceSource {
  enum class Kind { baseline, engine, files } kind = Kind::baseline;
  std::string engine;  ///< A row of engines.toml.
  Budget budget;
  int seeds = 8;  ///< Independent images in the mean; 1: the baseline has no randomness.
};

struct BlockBound {
  double relative = 0;  ///< Relative to the reference's block, or to its channel's mean where the block is darker.
  double alpha = 0;     ///< The probability that a right image fails.
};

/// Points for a wrong image, by one metric: all of them at `full`, none at `none`, linear in between.
struct PartialCredit {
  const MetricRow* metric = nullptr;
  double full = 0, none = 0;
};

struct CorrectnessRule {
  std::vector<MetricBound> metrics;
  std::optional<BlockBound> blocks;
  std::optional<PartialCredit> partial;
  int runs = 4;  ///< The most images of a scene, drawn while noise leaves it undecided.
};

struct PerformanceRule {
  std::vector<std::string> timed;  ///< Names of public scenes.
  bool needs_all = true;           ///< A submission must be right on all scenes to be timed; false: on all timed ones.
  std::vector<SpeedTier> tiers;    ///< Ascending; empty where there is a curve.
  std::optional<SpeedTier> curve;  ///< No points at 1, its points at its ratio, in between by the logarithm.
  /// The required relative width of the interval. Empty: with tiers, rounds end once the points are certain.
  std::optional<double> precision;
  int rounds = 12;       ///< The most rounds.
  double seconds = 600;  ///< For all rounds of all submissions.
  double points() const { return curve ? curve->points : tiers.empty() ? 0 : tiers.back().points; }
};

struct Assignment {
  std::filesystem::path file, folder;
  std::string text;  ///< The text as read.
  std::string name, title;
  std::vector<std::string> build_command;  ///< Empty: nothing is built.
  std::filesystem::path overwrite;         ///< A folder whose tree is copied over a submission; empty: none.
  AssignmentLimits build_limits, limits;
  std::vector<std::string> run_command;
  bool seeds = false;  ///< The program uses {seed}.
  AssignmentImage image;
  std::filesystem::path baseline;
  ReferenceSource reference;
  CorrectnessRule correctness;
  std::optional<PerformanceRule> performance;
  double correctness_points = 100;
  std::vector<AssignmentScene> scenes;  ///< Public ones first.
  double max_points() const { return correctness_points + (performance ? performance->points() : 0); }
  bool is_timed(const std::string& scene) const;
};

/// Throws InputError with the place for everything that cannot be used, including missing files. Paths are relative to
/// the file.
Assignment read_assignment(const std::filesystem::path& file);

}  // namespace photonproof::inline harness_grading
