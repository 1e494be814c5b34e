#include "harness/grading/scene_findings.h"

#include <algorithm>
#include <vector>

#include "harness/diagnosis/knowledge.h"
#include "harness/statistics/deviations.h"
#include "scenes/base/input_error.h"

namespace photonproof::inline harness_grading {
namespace {

/// True for findings that a right program's picture never has.
bool is_mistake(const Finding& finding) { return finding.kind != "fireflies"; }

bool is_undecided(const GradedCheck& check) { return check.side == GradedCheck::Side::undecided; }
bool is_outside(const GradedCheck& check) { return check.side == GradedCheck::Side::outside; }

}  // namespace

const SceneKnowledge& SceneFindings::knowledge(std::size_t scene) {
  Known& known = known_[scene];
  std::call_once(known.once, [&] { known.knowledge = found_out(scene); });
  return known.knowledge;
}

SceneKnowledge SceneFindings::found_out(std::size_t scene) const {
  const WorkScene& work = scenes_[scene];
  const SceneReference& reference = *references_[scene];
  SceneKnowledge known;
  const std::optional<float> white =
      assignment_.image.is_clamped() ? std::optional(static_cast<float>(1 / assignment_.image.scale)) : std::nullopt;
  if (work.description) {
    progress_("scene " + work.row.name + ": what its light is made of");
    known = knowledge_of(*work.description, reference.rendering, engine_, {.white = white});
  }
  known.reference = reference.rendering.mean;
  known.variance = reference.rendering.variance;
  known.white = white;
  for (std::size_t other = 0; other < scenes_.size(); ++other)
    if (other != scene && references_[other])
      known.other_images.emplace_back("scene " + scenes_[other].row.name, references_[other]->rendering.mean);
  return known;
}

std::vector<Finding> SceneFindings::found_in(const Image& image, std::size_t scene, Find find) {
  const SceneKnowledge& known = knowledge(scene);
  try {
    return find(image, known);
  } catch (const InputError& error) {  // a render failed: sentences then do without the scene's light
    {
      const std::lock_guard lock(telling_);
      failures_.emplace(scene, error.what());
    }
    SceneKnowledge without = known;
    without.light = {};
    without.what_ifs.clear();
    return find(image, without);
  }
}

std::vector<std::string> SceneFindings::problems() const {
  const std::lock_guard lock(telling_);
  std::vector<std::string> all;
  for (const auto& [scene, error] : failures_)
    all.push_back("findings for scene '" + scenes_[scene].row.name + "' lack the parts of its light: " + error);
  return all;
}

std::vector<Finding> SceneFindings::mistakes_in(const SceneWorkGrade& work, std::size_t scene) {
  if (work.grade.verdict == SceneVerdict::wrong) return found_in(work.images.front(), scene, diagnose);
  std::vector<const Image*> images;
  for (const Image& image : work.images) images.push_back(&image);
  const bool by_noise = std::ranges::any_of(work.grade.checks, is_undecided);
  // The mean has less noise than each image.
  std::vector<Finding> findings = found_in(mean_of(images), scene, by_noise ? diagnose : find_hidden_mistake);
  std::erase_if(findings, [](const Finding& finding) { return !is_mistake(finding); });
  return findings;
}

void SceneFindings::add(std::size_t scene, SceneWorkGrade& work) {
  if (work.grade.verdict == SceneVerdict::failed || work.images.empty() || !references_[scene]) return;
  std::vector<Finding> findings = mistakes_in(work, scene);
  // The page then shows the picture of the differences without a cause. A scene that is wrong for another reason, such
  // as a copied image, has its own sentence.
  if (findings.empty() && std::ranges::any_of(work.grade.checks, is_outside))
    findings.push_back({"differs",
                        "differs here, not explained",
                        "",
                        {0, 0, work.images.front().width, work.images.front().height},
                        0});
  for (const Finding& finding : findings)
    work.grade.findings.push_back({finding.kind, finding.sentence, finding.cause, finding.where.x, finding.where.y,
                                   finding.where.width, finding.where.height, finding.explained});
  if (work.grade.verdict == SceneVerdict::wrong || work.grade.findings.empty()) return;
  work.grade.verdict = SceneVerdict::wrong;
  const GradedFinding& first = work.grade.findings.front();
  const std::string subject = first.kind == "differs" ? "it " : "";
  work.grade.sentence = "within the bounds, or hidden by noise, but " + subject + first.sentence;
}

}  // namespace photonproof::inline harness_grading
