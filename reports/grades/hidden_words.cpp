#include "reports/grades/hidden_words.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <string_view>
#include <utility>

namespace photonproof::reports::inline reports_grades {
namespace {

using Words = std::pair<std::string_view, std::string_view>;

// The end of a run, without the program's output about it.
constexpr std::array<Words, 9> ends{{{"crash", "the program crashes"},
                                     {"timeout", "the program is not done in time"},
                                     {"memory", "the program needs more memory than there is"},
                                     {"disk", "the program fills its disk"},
                                     {"log", "the program prints too much"},
                                     {"file size", "the program writes too large a file"},
                                     {"not started", "the program cannot be started"},
                                     {"no image", "the program leaves no image"},
                                     {"bad image", "the program's image cannot be used"}}};

// Sentences for the flags that make a scene wrong.
constexpr std::array<Words, 4> flagged{
    {{"copy-of-given", "the image that was handed out, whatever the seed"},
     {"copy-of-reference", "a copy of the reference: it has the reference's own noise"},
     {"keeps-results", "an earlier run's image comes back, whatever the seed: results are kept in files"},
     {"copies-found", "an earlier run's image comes back, whatever the seed: images that are found are copied"}}};

// Kinds of findings (harness/diagnosis) that reveal nothing about a scene's contents: any scene has pixels, and light
// that comes from lights directly or after bounces.
struct Mistake {
  std::string_view kind, sentence, cause;
};
constexpr Mistake mistakes[] = {
    {"wrong-size", "the image has another size than was asked for", "the size asked for is ignored"},
    {"not-finite", "pixels are not a number", "a division by zero or the square root of a negative number"},
    {"unrendered", "parts of the image are black",
     "they were never rendered: work was divided wrongly, or threads ended too early"},
    {"black-lines", "rows or columns are black",
     "seams between tiles: their last row or column is left out or done twice"},
    {"seams", "rows or columns are off from their neighbours",
     "seams between tiles: their last row or column is left out or done twice"},
    {"slanted", "the image is slanted: rows lie further and further aside",
     "rows are stored with another length than they are read with: width, or padding to 4 bytes"},
    {"coarse", "the resolution is too low", "rendered smaller and enlarged, or not every pixel is computed"},
    {"blurred", "the image is blurred", "filtered too widely, or rendered smaller and enlarged"},
    {"shifted", "the image is shifted", "pixels' middles are taken half a pixel off, or the camera points elsewhere"},
    {"field-of-view", "the field of view is wrong",
     "its angle is taken along the other side, as half or whole, or the camera stands elsewhere"},
    {"upside-down", "the image is upside down",
     "rows are written from the bottom up, or y is not turned from world to image"},
    {"left-right", "the image is mirrored left to right", "the camera's x axis points the wrong way"},
    {"rotated-180", "the image is turned by 180 degrees", "both image axes point the wrong way"},
    {"rotated-90", "the image is turned by 90 degrees", "rows and columns are exchanged, and one turned over"},
    {"rotated-270", "the image is turned by 90 degrees", "rows and columns are exchanged, and one turned over"},
    {"transposed", "rows and columns are exchanged", "pixels are stored by x where they are read by y"},
    {"anti-transposed", "rows and columns are exchanged", "pixels are stored by x where they are read by y"},
    {"channels-swapped", "colour channels are exchanged", "channels are stored in another order"},
    {"grey", "the image has no colours", "one value is computed for all channels"},
    {"channel-missing", "a channel is black", "a channel is never written"},
    {"gamma-applied", "gamma applied where linear values are expected", "values are encoded before they are written"},
    {"gamma-twice", "gamma applied twice", "values are encoded by the program and again by its image writer"},
    {"gamma-missing", "gamma missing", "linear values are written where encoded ones are expected"},
    {"square-root", "the square root of the light is shown", "gamma 2 applied where linear values are expected"},
    {"tone-mapped", "the image is tone-mapped", "values are compressed where they should be clamped"},
    {"wrap-around", "bright places wrap around to dark", "values above white are cut to 8 bits, not clamped"},
    {"negative", "the image is a negative", "white minus the value is written"},
    {"exposure", "the whole image is too bright or too dark",
     "light is counted twice or halved, a factor of pi is missing, or a number of samples enters wrongly"},
    {"ambient", "everything is brighter by the same amount", "a constant ambient term is added"},
    {"other-scene", "the same image as of another scene",
     "the scene asked for is ignored, or an image left from another run was taken"},
    {"direct-missing", "direct light missing", "lamps are not sampled, or every shadow ray is blocked"},
    {"direct-twice", "direct light counted twice", "lamps are added by sampling and by photons, too"},
    {"direct-energy", "direct light too bright or too dark", "the lamp's power, area or sampling density is wrong"},
    {"indirect-missing", "indirect light missing", "no global photons are shot or gathered"},
    {"indirect-twice", "indirect light counted twice", "direct light's photons are gathered, too"},
    {"indirect-energy", "indirect light too bright or too dark",
     "photons' power, their number or the gather's weight is wrong"},
    {"falloff-missing", "light does not fall off with distance",
     "direct light is not divided by the square of the distance"},
    {"falloff-linear", "light falls off too slowly with distance",
     "direct light is divided by the distance, not its square"},
    {"falloff-twice", "light falls off too fast with distance",
     "direct light is divided by the square of the distance twice"},
    {"cosine-missing", "direct light is too bright where it comes in flat, as if the surface's angle did not matter",
     "the cosine at the surface is missing (N dot L)"},
    {"cosine-twice", "direct light depends too strongly on the surface's angle",
     "the cosine at the surface is taken twice"},
    {"lamp-part", "light comes from a part of the lamp only",
     "places on it are drawn from 0 to 1 where its sides reach from -1 to 1"},
    {"lamp-cosine-missing", "the lamp shines as brightly to the side as ahead", "the cosine at the lamp is missing"},
};
// For all other kinds.
constexpr Mistake of_content{"", "something that the scene holds is not rendered as it should be",
                             "try objects, materials and lamps of every kind, in scenes of your own"};

const Mistake& listed_mistake(const GradedFinding& finding) {
  const auto* const found = std::ranges::find(mistakes, std::string_view(finding.kind), &Mistake::kind);
  return found == std::end(mistakes) ? of_content : *found;
}

void add_once(std::vector<std::string>& texts, std::string_view text) {
  if (!text.empty() && std::ranges::find(texts, text) == texts.end()) texts.emplace_back(text);
}

const GradedScene* scene_named(const Grades& grades, const std::string& name) {
  const auto found = std::ranges::find(grades.scenes, name, &GradedScene::name);
  return found == grades.scenes.end() ? nullptr : &*found;
}

/// The sentence that the image is no rendering of the scene; empty if there is no such flag.
std::string copy_words(const Grades& grades, const SubmissionGrade& submission, const std::string& scene) {
  for (const GradeFlag& flag : submission.flags) {
    if (flag.scene != scene) continue;
    for (const auto& [kind, words] : flagged)
      if (flag.kind == kind) return std::string(words);
    if (flag.kind != "same-image") continue;
    const GradedScene* other = scene_named(grades, flag.other);
    return other != nullptr && !other->hidden ? "the same image as of scene " + other->name
                                              : "the same image as of another scene";
  }
  return {};
}

std::string end_words(const SceneGrade& grade) {
  for (const GradedRun& run : grade.runs)
    for (const auto& [end, words] : ends)
      if (run.end == end) return std::string(words);
  return "no image came of it";
}

HiddenWords words_of_wrong(const SceneGrade& grade) {
  std::vector<std::string> sentences, causes;
  for (const GradedFinding& finding : grade.findings) {
    const bool is_vague = finding.kind == "differs";  // and its place is not shown
    if (is_vague) continue;
    add_once(sentences, listed_mistake(finding).sentence);
    add_once(causes, listed_mistake(finding).cause);
  }
  if (sentences.empty()) return {"differs from the reference by more than noise explains", {}};
  std::string joined;
  for (const std::string& sentence : sentences) joined += (joined.empty() ? "" : "; ") + sentence;
  return {joined, causes};
}

bool is_part_of_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-'; }

void replace_name(std::string& text, const std::string& title) {
  constexpr std::string_view instead = "a hidden scene";
  for (std::size_t at = text.find(title); at != std::string::npos; at = text.find(title, at + 1)) {
    const std::size_t end = at + title.size();
    if (end < text.size() && is_part_of_name(text[end])) continue;
    text.replace(at, title.size(), instead);
  }
}

}  // namespace

HiddenWords hidden_words(const Grades& grades, const SubmissionGrade& submission, const SceneGrade& grade) {
  switch (grade.verdict) {
    case SceneVerdict::failed:
      return {end_words(grade), {}};
    case SceneVerdict::borderline:
      return {"noise leaves it open, which counts as right", {}};
    case SceneVerdict::unused:
      return {"nobody is graded on it", {}};
    case SceneVerdict::skipped:
      return {"not graded in this run", {}};
    case SceneVerdict::right:
      return {};
    case SceneVerdict::wrong:
      break;
  }
  if (std::string copy = copy_words(grades, submission, grade.scene); !copy.empty()) return {std::move(copy), {}};
  return words_of_wrong(grade);
}

std::string without_hidden_names(const Grades& grades, const std::string& text) {
  std::vector<std::string> names;
  for (const GradedScene& scene : grades.scenes)
    if (scene.hidden && !scene.name.empty()) names.push_back(scene.name);
  std::ranges::sort(names, std::ranges::greater{}, &std::string::size);
  std::string told = text;
  for (const std::string& name : names) {
    replace_name(told, "hidden scene " + name);
    replace_name(told, "hidden scene '" + name + "'");
    replace_name(told, "scene " + name);
    replace_name(told, "scene '" + name + "'");
  }
  return told;
}

SubmissionGrade as_students_read(const Grades& grades, SubmissionGrade submission) {
  const auto redact = [&](std::string& text) { text = without_hidden_names(grades, text); };
  redact(submission.speed.sentence);
  for (SceneGrade& scene : submission.scenes) {
    redact(scene.sentence);
    for (GradedFinding& finding : scene.findings) {
      redact(finding.sentence);
      redact(finding.cause);
    }
    for (GradedCheck& check : scene.checks) redact(check.sentence);
  }
  return submission;
}

}  // namespace photonproof::reports::inline reports_grades
