#include "harness/grading/scene_grading.h"

#include "harness/metrics/heatmap.h"
#include "scenes/base/process.h"
#include "scenes/base/utf8.h"

namespace photonproof::inline harness_grading {
namespace {

namespace fs = std::filesystem;

// "crashed: killed by SIGSEGV: its last line"
std::string failure_sentence(const GradedRun& run) {
  std::string words = printable(last_line(run.log_tail));
  if (words.size() > 200) words = printable(words.substr(0, 197)) + "...";
  return run.sentence + (run.end == "crash" && !words.empty() ? ": " + words : "");
}

}  // namespace

std::optional<SceneWorkGrade> grade_scene(const Assignment& assignment, const PreparedSubmission& submission,
                                          const WorkScene& scene, const SceneReference& reference, GradeRuns& runs,
                                          const SceneGradingOptions& options) {
  SceneWorkGrade work;
  work.grade.scene = scene.row.name;
  const auto most = std::max(options.least_images, static_cast<std::size_t>(assignment.correctness.runs));
  for (std::size_t number = 0; number < most; ++number) {
    std::optional<DrawnRun> cell = runs.run(submission, scene, "correctness", number, options.reuse);
    if (!cell) return std::nullopt;
    work.grade.runs.push_back(cell->run);
    if (!cell->image) {
      work.grade.verdict = SceneVerdict::failed;
      work.grade.sentence = failure_sentence(cell->run);
      return work;
    }
    work.images.push_back(std::move(*cell->image));
    if (work.images.size() < options.least_images) continue;
    std::vector<const Image*> images;
    for (const Image& image : work.images) images.push_back(&image);
    SceneJudgement judgement = judge_scene(assignment.correctness, reference, images, number + 1 < most);
    work.grade.verdict = judgement.verdict;
    work.grade.sentence = judgement.sentence;
    work.grade.checks = std::move(judgement.checks);
    if (judgement.decided) {
      work.grade.partial = partial_share(assignment.correctness, reference, images);
      break;
    }
  }
  if (options.in_used_place) {
    for (const bool littered : {true, false}) {
      std::optional<DrawnRun> cell = runs.run_in_used_place(submission, scene, 1, littered, options.reuse);
      if (!cell) return std::nullopt;
      (littered ? work.in_littered_place : work.in_used_place) = std::move(cell->image);
      const bool is_new = !work.in_littered_place || work.in_littered_place->rgb != work.images.front().rgb;
      if (is_new || !work.seed_shows()) break;
    }
  }
  return work;
}

void store_scene_pictures(const fs::path& folder, const std::string& place, const SceneReference& reference,
                          SceneWorkGrade& work) {
  if (work.images.empty()) return;
  fs::create_directories(folder / place);
  const Image& image = work.images.front();
  const std::string picture = place + "/" + work.grade.scene + ".png";
  write_png((folder / picture).string(), image);
  work.grade.pictures["image"] = picture;
  HeatmapWriter maps(image.width, image.height, folder / place, work.grade.scene);
  ImageRowSource expected(reference.rendering.mean), submitted(image);
  measure_pair(expected, submitted, {}, &maps);
  const HeatmapFiles files = maps.finish();
  work.grade.pictures["flip"] = place + "/" + files.flip.filename().string();
  work.grade.pictures["error"] = place + "/" + files.error.filename().string();
}

}  // namespace photonproof::inline harness_grading
