// What staff hand to `photonproof grade`: how a submission is built and run, on which scenes, what is right, what speed
// earns. The file is TOML; harness/grading/FORMAT.md has its keys.
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

/// Of a build or of a run.
struct AssignmentLimits {
  double seconds = 60;
  std::uint64_t memory_mb = 2048, file_mb = 64, disk_mb = 256, log_mb = 4;
  int processes = 64;
};

/// How the numbers in a submission's image file are meant.
struct AssignmentImage {
  std::string format = "png";         ///< exr pfm hdr png bmp tga ppm
  std::optional<double> gamma = 1.0;  ///< what decodes them, 1 linear; empty: sRGB
  bool bottom_up = false;             ///< the first row is the lowest
  double scale = 1;                   ///< they were multiplied by it
  bool is_clamped() const { return format != "exr" && format != "pfm" && format != "hdr"; }
};

/// A scene that submissions render. Of a variant the description follows from another scene's (harness/variants).
struct AssignmentScene {
  std::string name;
  bool hidden = false;
  std::string of, variant;  ///< name of the public scene and kind of the variant; empty: a scene of its own
  std::uint64_t variant_seed = 1;
  std::filesystem::path path;                     ///< our description, empty where there is none
  std::filesystem::path params, params_template;  ///< the course's own scene file, or what makes it of our description
  std::string params_place;                       ///< where it is put, in the run's folder; empty: nowhere
  std::vector<std::string> option;                ///< arguments that say which scene it is
  int width = 0, height = 0;                      ///< before the variant changes them
  double weight = 1;                              ///< its share of the points for correctness
  std::filesystem::path reference;                ///< an image with its variance, where references are files
  std::filesystem::path given;                    ///< an image that students have; empty: none
};

/// What scenes' references are made of.
struct ReferenceSource {
  enum class Kind { baseline, engine, files } kind = Kind::baseline;
  std::string engine;  ///< a row of engines.toml
  Budget budget;
  int seeds = 8;  ///< independent images, whose mean it is; 1: the baseline has no randomness
};

struct BlockBound {
  double relative = 0;  ///< of the reference's block, or of its channel's mean where the block is darker
  double alpha = 0;     ///< the chance that a right image fails
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
  int runs = 4;  ///< images of a scene, at most, while noise leaves it open
};

struct PerformanceRule {
  std::vector<std::string> timed;  ///< names of public scenes
  bool needs_all = true;           ///< who is wrong on any scene is not timed; false: on any timed one
  std::vector<SpeedTier> tiers;    ///< ascending; empty where there is a curve
  std::optional<SpeedTier> curve;  ///< no points at 1, its points at its ratio, in between by the logarithm
  /// Relative width of the interval that is asked for; empty: rounds end where the points are certain, with tiers.
  std::optional<double> precision;
  int rounds = 12;       ///< most rounds
  double seconds = 600;  ///< for all rounds, of all submissions
  double points() const { return curve ? curve->points : tiers.empty() ? 0 : tiers.back().points; }
};

struct Assignment {
  std::filesystem::path file, folder;
  std::string text;  ///< as read
  std::string name, title;
  std::vector<std::string> build_command;  ///< empty: nothing is built
  std::filesystem::path overwrite;         ///< a folder whose tree is copied over a submission; empty: none
  AssignmentLimits build_limits, limits;
  std::vector<std::string> run_command;
  bool seeds = false;  ///< the program heeds {seed}
  AssignmentImage image;
  std::filesystem::path baseline;
  ReferenceSource reference;
  CorrectnessRule correctness;
  std::optional<PerformanceRule> performance;
  double correctness_points = 100;
  std::vector<AssignmentScene> scenes;  ///< public ones first
  double max_points() const { return correctness_points + (performance ? performance->points() : 0); }
  bool is_timed(const std::string& scene) const;
};

/// Throws InputError with the place for everything that cannot be used, files that are missing among it. Paths are
/// relative to the file.
Assignment read_assignment(const std::filesystem::path& file);

}  // namespace photonproof::inline harness_grading
