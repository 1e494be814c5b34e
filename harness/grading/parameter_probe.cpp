#include "harness/grading/parameter_probe.h"

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string_view>

namespace photonproof::inline harness_grading {
namespace {

// True for findings about the amount of light, its detail, or paths that end too soon.
bool may_come_of_parameters(std::string_view kind) {
  constexpr std::array<std::string_view, 5> kinds{"fireflies", "coarse", "blurred", "differs", "exposure"};
  constexpr std::array<std::string_view, 4> ends{"-energy", "-missing", "brightness", "-black"};
  return std::ranges::find(kinds, kind) != kinds.end() ||
         std::ranges::any_of(ends, [kind](std::string_view end) { return kind.ends_with(end); });
}

}  // namespace

ParameterProbe::ParameterProbe(const FlagContext& context, const SubmissionRunner& runner, GradeRuns& runs,
                               const PreparedSubmission& baseline, bool reuse)
    : context_(context),
      runner_(runner),
      runs_(runs),
      reuse_(reuse),
      baseline_draws_the_same_(
          std::function<bool()>([this, &baseline] { return draws_the_same(baseline, context_.baseline); })) {
  while (scene_ < context.scenes.size() && !context.references[scene_]) ++scene_;
}

bool ParameterProbe::draws_the_same(const PreparedSubmission& prepared, const SubmissionWork& work) const {
  const std::optional<SceneWorkGrade>& usual = work.scenes[scene_];
  if (!usual || usual->images.empty()) return false;
  const auto own = runner_.built_as_handed_in(prepared);
  if (!own) return false;
  const auto cell = runs_.run(*own, context_.scenes[scene_], "correctness", 0, reuse_);
  return cell && cell->image && cell->image->rgb == usual->images.front().rgb;
}

void ParameterProbe::flag(const PreparedSubmission& prepared, SubmissionWork& work) const {
  if (scene_ >= work.scenes.size() || !work.scenes[scene_] || !work.grade.flags.empty()) return;
  const SceneGrade& grade = work.scenes[scene_]->grade;
  if (grade.verdict != SceneVerdict::wrong || grade.findings.empty() ||
      !may_come_of_parameters(grade.findings.front().kind))
    return;
  const std::optional<Image>& again = work.scenes[scene_]->in_littered_place;
  if (again && again->rgb != work.scenes[scene_]->images[1].rgb) return;  // different bits every time
  if (!draws_the_same(prepared, work) || baseline_draws_the_same_.get()) return;
  work.grade.flags.push_back({"parameters-ignored",
                              "the same image with other parameters: files that the assignment puts in place of the "
                              "submission's own are ignored",
                              grade.scene,
                              {}});
}

}  // namespace photonproof::inline harness_grading
