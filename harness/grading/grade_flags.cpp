#include "harness/grading/grade_flags.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "harness/pixels/likeness.h"

namespace photonproof::inline harness_grading {
namespace {

// One step of an 8-bit file, in linear values; 0 where values are stored as they are.
double step_of(const AssignmentImage& image) { return image.is_clamped() ? 1 / (255 * image.scale) : 0; }

std::string scene_title(const WorkScene& scene) {
  return (scene.row.hidden ? "hidden scene " : "scene ") + scene.row.name;
}

void make_wrong(SceneGrade& grade, const std::string& sentence) {
  grade.verdict = SceneVerdict::wrong;
  grade.sentence = sentence;
  grade.partial = 0;  // it is no render of its own
}

class SubmissionFlags {
 public:
  SubmissionFlags(const FlagContext& context, SubmissionWork& work) : context_(context), work_(work) {}

  void of_images() {
    for (std::size_t s = 0; s < context_.scenes.size(); ++s) {
      if (!has_image(s)) continue;
      seed_ignored(s);
      comes_back(s);
      if (!is_copy_of_given(s) && !is_copy_of_reference(s)) image_of_other_scene(s);
    }
  }

  void of_verdicts() {
    for (std::size_t s = 0; s < context_.scenes.size(); ++s)
      if (has_image(s)) runs_differ(s);
    public_only();
  }

 private:
  void public_only() {
    std::size_t hidden = 0, hidden_wrong = 0, last_wrong = 0;
    for (std::size_t s = 0; s < context_.scenes.size(); ++s) {
      if (!work_.scenes[s]) continue;
      const bool is_right = grade(s).counts_as_right();
      if (!context_.scenes[s].row.hidden && !is_right) return;
      if (!context_.scenes[s].row.hidden) continue;
      ++hidden;
      if (is_right) continue;
      ++hidden_wrong;
      last_wrong = s;
    }
    if (hidden_wrong == 0) return;
    flag("right-on-public-only",
         fmt::format("right on the public scenes only: {} of {} hidden ones {} not", hidden_wrong, hidden,
                     hidden_wrong == 1 ? "is" : "are"),
         last_wrong);
  }

  bool has_image(std::size_t s) const { return work_.scenes[s] && !work_.scenes[s]->images.empty(); }
  const Image& image(std::size_t s) const { return work_.scenes[s]->images.front(); }
  SceneGrade& grade(std::size_t s) { return work_.scenes[s]->grade; }

  void flag(const char* kind, std::string sentence, std::size_t s, std::string other = {}) {
    work_.grade.flags.push_back({kind, std::move(sentence), context_.scenes[s].row.name, std::move(other)});
  }

  // A program that uses its seed cannot hit an image made with another one.
  bool is_copy_of_given(std::size_t s) {
    const WorkScene& scene = context_.scenes[s];
    if (!scene.given || !context_.assignment.seeds || !context_.references[s]) return false;
    const Image& given = *scene.given;
    const bool is_same = given.rgb == image(s).rgb;
    const bool is_alike =
        has_noise_of(image(s), given, variance_of_one(*context_.references[s]), step_of(context_.assignment.image));
    if (!is_same && !is_alike) return false;
    const std::string sentence = is_same ? "the image that was handed out, bit for bit, whatever the seed"
                                         : "the image that was handed out: it has the same noise, whatever the seed";
    make_wrong(grade(s), sentence);
    flag("copy-of-given", scene_title(scene) + ": " + sentence, s);
    return true;
  }

  bool is_copy_of_reference(std::size_t s) {
    if (!context_.references[s] || !context_.assignment.seeds) return false;
    const Rendering& reference = context_.references[s]->rendering;
    if (!has_noise_of(image(s), reference.mean, *reference.variance, step_of(context_.assignment.image))) return false;
    const std::string sentence = "a copy of the reference: it has the reference's own noise";
    make_wrong(grade(s), sentence);
    flag("copy-of-reference", scene_title(context_.scenes[s]) + ": " + sentence, s);
    return true;
  }

  void seed_ignored(std::size_t s) {
    const std::vector<Image>& images = work_.scenes[s]->images;
    if (!context_.assignment.seeds || images.size() < 2 || images[0].rgb != images[1].rgb) return;
    const auto& baseline = context_.baseline.scenes[s];
    if (!baseline || baseline->images.size() < 2 || baseline->images[0].rgb == baseline->images[1].rgb) return;
    flag("seed-ignored", scene_title(context_.scenes[s]) + ": the same image for two seeds", s);
  }

  // Flags a program that uses the seed in a new folder but returns an earlier run's image where that run or image was.
  void comes_back(std::size_t s) {
    const SceneWorkGrade& work = *work_.scenes[s];
    const auto is_first = [&work](const std::optional<Image>& image) {
      return image && work.seed_shows() && image->rgb == work.images[0].rgb;
    };
    if (!is_first(work.in_littered_place)) return;
    const bool is_kept = is_first(work.in_used_place);
    const std::string sentence =
        std::string("an earlier run's image comes back, whatever the seed: ") +
        (is_kept ? "results are kept in files" : "images that lie in the folder for temporary files are copied");
    make_wrong(grade(s), sentence);
    flag(is_kept ? "keeps-results" : "copies-found", scene_title(context_.scenes[s]) + ": " + sentence, s);
  }

  // A hint for a wrong image; right programs may vary between runs.
  void runs_differ(std::size_t s) {
    const auto is_undetermined = [s](const SubmissionWork& work) {
      const std::optional<SceneWorkGrade>& scene = work.scenes[s];
      return scene && scene->seed_shows() && scene->in_littered_place &&
             scene->in_littered_place->rgb != scene->images[0].rgb &&
             scene->in_littered_place->rgb != scene->images[1].rgb;
    };
    if (grade(s).counts_as_right() || !is_undetermined(work_) || is_undetermined(context_.baseline)) return;
    flag("runs-differ",
         scene_title(context_.scenes[s]) +
             ": the same seed gives another image every time: it goes by the clock, or threads race",
         s);
  }

  // True for scenes that rightly look alike, such as one moved together with its camera.
  bool look_alike_by_right(std::size_t s, std::size_t other) const {
    const auto& baseline = context_.baseline.scenes[s];
    if (!baseline || baseline->images.empty() || !context_.references[other]) return false;
    const Image* const right = &baseline->images.front();
    return judge_scene(context_.assignment.correctness, *context_.references[other], {&right, 1}, false).verdict !=
           SceneVerdict::wrong;
  }

  // A wrong image that equals another scene's is no chance.
  void image_of_other_scene(std::size_t s) {
    if (grade(s).verdict != SceneVerdict::wrong) return;
    for (std::size_t other = 0; other < context_.scenes.size(); ++other) {
      if (other == s || !has_image(other) || image(other).width != image(s).width ||
          image(other).height != image(s).height || look_alike_by_right(s, other))
        continue;
      const std::vector<Image>& images = work_.scenes[other]->images;
      if (std::ranges::none_of(images, [&](const Image& one) { return one.rgb == image(s).rgb; })) continue;
      const std::string sentence = "same image as " + scene_title(context_.scenes[other]) + "'s";
      make_wrong(grade(s), sentence);
      flag("same-image", scene_title(context_.scenes[s]) + ": " + sentence, s, context_.scenes[other].row.name);
      return;
    }
  }

  const FlagContext& context_;
  SubmissionWork& work_;
};

const Image* first_image(const SubmissionWork& work, std::size_t s) {
  return work.scenes[s] && !work.scenes[s]->images.empty() ? &work.scenes[s]->images.front() : nullptr;
}

// Scenes on which two submissions share their noise. Without seeds, or with the baseline's random numbers, right
// programs may share it.
std::vector<std::string> shared_noise(const FlagContext& context, const SubmissionWork& a, const SubmissionWork& b) {
  std::vector<std::string> names;
  const double step = step_of(context.assignment.image);
  for (std::size_t s = 0; s < context.scenes.size(); ++s) {
    const Image *of_a = first_image(a, s), *of_b = first_image(b, s), *usual = first_image(context.baseline, s);
    if (of_a == nullptr || of_b == nullptr || usual == nullptr || !context.references[s]) continue;
    const Image variance = variance_of_one(*context.references[s]);
    if (has_noise_of(*of_a, *usual, variance, step) || !has_noise_of(*of_a, *of_b, variance, step)) continue;
    names.push_back(context.scenes[s].row.name);
  }
  return names;
}

}  // namespace

void flag_images(const FlagContext& context, SubmissionWork& work) { SubmissionFlags(context, work).of_images(); }

void flag_verdicts(const FlagContext& context, SubmissionWork& work) { SubmissionFlags(context, work).of_verdicts(); }

void flag_likenesses(const FlagContext& context, std::vector<SubmissionWork>& works) {
  for (std::size_t a = 0; a < works.size(); ++a)
    for (std::size_t b = a + 1; b < works.size(); ++b) {
      const std::vector<std::string> scenes = shared_noise(context, works[a], works[b]);
      if (scenes.empty()) continue;
      const std::string where = fmt::format("{} scene{}", scenes.size(), scenes.size() == 1 ? "" : "s");
      const auto tell = [&](SubmissionWork& work, const std::string& other) {
        work.grade.flags.push_back(
            {"same-as-other", "the same noise as " + other + "'s images, on " + where, scenes.front(), other});
      };
      tell(works[a], works[b].grade.name);
      tell(works[b], works[a].grade.name);
    }
}

}  // namespace photonproof::inline harness_grading
