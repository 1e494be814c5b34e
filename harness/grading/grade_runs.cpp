#include "harness/grading/grade_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <nlohmann/json.hpp>
#include <vector>

#include "harness/cells/cells.h"
#include "harness/cells/host.h"
#include "harness/cells/others_busy.h"
#include "harness/metrics/metrics.h"
#include "reports/grades/grades_json.h"
#include "scenes/base/json_text.h"
#include "scenes/base/size_text.h"
#include "scenes/base/splitmix.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/checksum.h"

namespace photonproof::inline harness_grading {
namespace {

// Increase it whenever this code changes, so that runs are made again.
constexpr const char* runs_version = "4";

std::string limits_text(const AssignmentLimits& limits) {
  return fmt::format("{} {} {} {} {} {}", limits.seconds, limits.memory_mb, limits.file_mb, limits.disk_mb,
                     limits.log_mb, limits.processes);
}

std::string image_text(const AssignmentImage& image) {
  return fmt::format("{} {} {} {}", image.format, image.gamma ? fmt::format("{}", *image.gamma) : "srgb",
                     image.bottom_up, image.scale);
}

// Refuses a picture for which no metric is defined.
void refuse_bad_image(const WorkScene& scene, DrawnRun& cell) {
  if (!cell.image) return;
  std::string problem;
  if (cell.image->width != scene.width || cell.image->height != scene.height) {
    problem = "wrote " + size_text(cell.image->width, cell.image->height) + " pixels instead of " +
              size_text(scene.width, scene.height);
  } else if (const auto defects = find_defects(Image(scene.width, scene.height), *cell.image); !defects.empty()) {
    problem = defects.front().sentence;
  }
  if (problem.empty()) return;
  cell.run.end = "bad image";
  cell.run.sentence = problem;
  cell.image.reset();
}

std::string values_checksum(const Image& image) {
  Checksum sum;
  sum.add(image.rgb.data(), image.rgb.size() * sizeof(float));
  return sum.hex();
}

}  // namespace

std::uint64_t GradeRuns::seed_of(const std::string& purpose, std::size_t number) const {
  constexpr std::uint64_t most = 999'999'999;
  constexpr std::uint64_t stream = std::uint64_t{1} << 32;
  const std::uint64_t start = splitmix64(options_.seed, purpose == "reference" ? stream : 0);
  return 1 + splitmix64(start, number) % most;
}

std::string GradeRuns::key_of(const PreparedSubmission& submission, const SubmissionRunRequest& request) const {
  return content_key(
      {{"version", runs_version},
       {"program", submission.checksum},
       {"before", length_prefixed(request.recipe.command_before)},
       {"littered", request.recipe.leaves_image_before ? "yes" : "no"},
       {"command", length_prefixed(request.recipe.command)},
       {"scene", length_prefixed({request.recipe.params_place, request.recipe.params, request.scene.checksum})},
       {"size", size_text(request.width, request.height)},
       {"image", image_text(assignment_.image)},
       {"limits", limits_text(assignment_.limits)},
       {"containment", runner_.containment()}});
}

std::optional<DrawnRun> GradeRuns::run_once(const PreparedSubmission& submission, const WorkScene& scene,
                                            const SubmissionRunRequest& request, std::uint64_t seed) const {
  DrawnRun cell = runner_.run(submission, request);
  if (cell.run.end == "interrupted" || is_interrupted()) return std::nullopt;
  cell.run.seed = seed;
  refuse_bad_image(scene, cell);
  return cell;
}

std::optional<DrawnRun> GradeRuns::run(const PreparedSubmission& submission, const WorkScene& scene,
                                       const std::string& purpose, std::size_t number, bool reuse) {
  const std::uint64_t seed = seed_of(purpose, number);
  return run_kept(submission, scene, request_of(assignment_, scene, seed, options_.threads), seed, reuse);
}

std::optional<DrawnRun> GradeRuns::run_in_used_place(const PreparedSubmission& submission, const WorkScene& scene,
                                                     std::size_t number, bool littered, bool reuse) {
  const std::uint64_t seed = seed_of("correctness", number);
  SubmissionRunRequest request = request_of(assignment_, scene, seed, options_.threads);
  request.recipe.command_before =
      request_of(assignment_, scene, seed_of("correctness", number - 1), options_.threads).recipe.command;
  request.recipe.leaves_image_before = littered;
  return run_kept(submission, scene, request, seed, reuse);
}

std::optional<DrawnRun> GradeRuns::run_kept(const PreparedSubmission& submission, const WorkScene& scene,
                                            const SubmissionRunRequest& request, std::uint64_t seed, bool reuse) {
  const std::string key = key_of(submission, request);
  if (reuse)
    if (std::optional<DrawnRun> found = find(key)) return found;
  std::optional<DrawnRun> cell;
  {
    const std::shared_lock beside_others(concurrent_runs_);
    if (!is_interrupted()) cell = run_once(submission, scene, request, seed);
  }
  if (cell && cell->run.end == "timeout") {
    const std::unique_lock alone(concurrent_runs_);
    cell = run_beside_others(submission, scene, request, seed);
  }
  if (cell) keep(key, *cell);
  return cell;
}

std::optional<DrawnRun> GradeRuns::find(const std::string& key) const {
  return store_.latest(key, [this](const std::string& name) -> std::optional<DrawnRun> {
    try {
      DrawnRun drawn{run_from_json(nlohmann::ordered_json::parse(read_file(store_.record_of(name)))), {}};
      if (drawn.run.image.empty()) return drawn;
      drawn.image = read_image((folder_ / drawn.run.image).string());
      return values_checksum(*drawn.image) == drawn.run.checksum ? std::optional(std::move(drawn)) : std::nullopt;
    } catch (const nlohmann::json::exception&) {  // a damaged record counts as none
      return std::nullopt;
    }
  });
}

void GradeRuns::keep(const std::string& key, DrawnRun& drawn) {
  const std::string name = store_.claim(key);
  if (drawn.image) {
    drawn.run.image = name + "/image.exr";
    drawn.run.checksum = values_checksum(*drawn.image);
    write_exr((folder_ / drawn.run.image).string(), {.mean = *drawn.image, .variance = {}, .metadata = {}});
  }
  write_file_atomically(store_.record_of(name), json_text(run_to_json(drawn.run)));
}

std::optional<DrawnRun> GradeRuns::run_beside_others(const PreparedSubmission& submission, const WorkScene& scene,
                                                     SubmissionRunRequest request, std::uint64_t seed) const {
  const OthersBusy busy;
  std::optional<DrawnRun> cell = run_once(submission, scene, request, seed);
  if (!cell || cell->run.end != "timeout") return cell;
  const double others = busy.cores();
  request.more_time = time_beside_others(busy, cell->run.cpu_seconds, cell->run.wall_seconds);
  if (request.more_time == 1) return cell;
  cell = run_once(submission, scene, request, seed);
  if (cell && cell->run.end == "timeout")
    cell->run.sentence += fmt::format(", while other work used {:.2g} of {} cores", others, describe_host().cores);
  return cell;
}

std::optional<DrawnRun> GradeRuns::run_timed(const PreparedSubmission& submission, const WorkScene& scene,
                                             std::size_t number) {
  const std::uint64_t seed = seed_of("correctness", number);
  return run_beside_others(submission, scene, request_of(assignment_, scene, seed, options_.threads), seed);
}

}  // namespace photonproof::inline harness_grading
