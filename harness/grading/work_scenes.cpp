#include "harness/grading/work_scenes.h"

#include "harness/suites/engine_command.h"
#include "harness/variants/scene_file.h"
#include "scenes/base/input_error.h"
#include "scenes/description/film_part.h"
#include "scenes/files/atomic_file.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline harness_grading {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_params_bytes = std::size_t{1} << 26;

void replace_all(std::string& text, const std::string& key, const std::string& value) {
  for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + value.size()))
    text.replace(at, key.size(), value);
}

// A template's language has no general boxes; programs that read our XML have them.
VariantOptions variant_options(const AssignmentScene& row) { return {.axis_aligned = !row.params_template.empty()}; }

void make_description(WorkScene& work, const OwnEngine& engine) {
  const AssignmentScene& row = work.row;
  const SceneDescription base = parse_scene_file(row.path.string());
  if (const auto crop = crop_of(base.sensor.film, row.width, row.height))
    throw InputError(row.path.string(), "renders " + crop->text() + ", and a program is asked for whole images: " +
                                            "leave out the film's crop_* parameters");
  if (row.variant.empty()) {
    work.description = base;
    return;
  }
  try {
    work.variant = make_variant(row.variant, row.variant_seed, base, row.width, row.height, variant_options(row));
  } catch (const InputError& error) {
    throw InputError("hidden scene '" + row.name + "'", error.summary());
  }
  work.width = work.variant->width;
  work.height = work.variant->height;
  work.says = work.variant->says;
  work.description = work.variant->scene;
  const std::string why = check_prediction(*work.variant, base, engine, variant_options(row));
  if (!why.empty()) work.unused = "our own engine does not confirm what follows from the variant: " + why;
}

void write_params(const Assignment& assignment, const fs::path& folder, WorkScene& work) {
  const AssignmentScene& row = work.row;
  work.params_place = row.params_place;
  if (!row.params_template.empty()) {
    const std::string text = read_file(row.params_template, max_params_bytes);
    work.params = scene_file_text(*work.description, work.width, work.height, text, row.params_template.string());
  } else if (!row.params.empty()) {
    work.params = read_file(row.params, max_params_bytes);
  } else if (mentions(assignment.run_command, "{scene}")) {
    work.folder = make_scene_folder(*work.description, folder / row.name);
  }
}

}  // namespace

std::vector<WorkScene> make_work_scenes(const Assignment& assignment, const SubmissionRunner& runner,
                                        const OwnEngine& engine, const fs::path& folder,
                                        const std::function<void(const std::string&)>& progress) {
  std::vector<WorkScene> scenes;
  for (const AssignmentScene& row : assignment.scenes) {
    WorkScene work;
    work.row = row;
    work.width = row.width;
    work.height = row.height;
    if (!row.path.empty()) {
      if (!row.variant.empty()) progress("scene " + row.name + ": checking what follows from '" + row.variant + "'");
      make_description(work, engine);
    }
    write_params(assignment, folder, work);
    if (!row.given.empty()) work.given = runner.read_given(row.given, work.width, work.height);
    scenes.push_back(std::move(work));
  }
  return scenes;
}

SubmissionRunRequest request_of(const Assignment& assignment, const WorkScene& scene, std::uint64_t seed, int threads) {
  SubmissionRunRequest request;
  for (const std::string& word : assignment.run_command) {
    if (word == "{scene_option}")
      request.recipe.command.insert(request.recipe.command.end(), scene.row.option.begin(), scene.row.option.end());
    else
      request.recipe.command.push_back(word);
  }
  for (std::string& word : request.recipe.command) {
    // A variant has the public scene's name, if any: a hidden scene's name would reveal it.
    replace_all(word, "{name}", scene.row.of.empty() ? scene.row.name : scene.row.of);
    replace_all(word, "{width}", std::to_string(scene.width));
    replace_all(word, "{height}", std::to_string(scene.height));
    replace_all(word, "{threads}", std::to_string(threads));
    replace_all(word, "{seed}", std::to_string(seed));
  }
  request.recipe.params = scene.params;
  request.recipe.params_place = scene.params_place;
  request.scene = scene.folder;
  request.width = scene.width;
  request.height = scene.height;
  return request;
}

}  // namespace photonproof::inline harness_grading
