// An engine with a mistake, for tests: planted_engine FAULT PROGRAM ARGUMENTS... runs `photonproof render` or `povray`
// on a scene with the mistake, or changes its picture. The scene is the argument that ends in .xml, and the picture
// follows -o.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "scenes/base/process.h"
#include "scenes/description/file_names.h"
#include "scenes/files/atomic_file.h"
#include "scenes/images/image.h"
#include "scenes/parser/parser.h"
#include "scenes/xml/writer.h"

namespace photonproof::inline harness_verify {
namespace {

using Words = std::vector<std::string>;

std::string after(const Words& words, const std::string& option) {
  const auto at = std::find(words.begin(), words.end(), option);
  return at == words.end() || at + 1 == words.end() ? "" : *(at + 1);
}

/// Brightens only point and spot lights, since a shape's own brightness is visible.
void brighten(SceneDescription& scene) {
  for (EmitterDescription& emitter : scene.emitters) {
    if (auto* point = std::get_if<PointLightDescription>(&emitter.light)) point->intensity = point->intensity * 1.02;
    if (auto* spot = std::get_if<SpotLightDescription>(&emitter.light)) spot->intensity = spot->intensity * 1.02;
  }
}

void change_materials(SceneDescription& scene, const std::string& fault) {
  for (BsdfDescription& bsdf : scene.bsdfs) {
    auto* glass = std::get_if<DielectricDescription>(&bsdf.model);
    if (fault == "ior" && glass != nullptr) glass->int_ior *= 1.52 / 1.5;
    auto* metal = std::get_if<RoughConductorDescription>(&bsdf.model);
    if (fault != "alpha" || metal == nullptr) continue;
    for (Scalar* alpha : {&metal->alpha_u, &metal->alpha_v}) *alpha = std::pow(std::get<double>(*alpha), 2);
  }
}

void mirror_textures(SceneDescription& scene) {
  for (TextureDescription& texture : scene.textures)
    if (auto* board = std::get_if<CheckerboardDescription>(&texture.pattern))
      board->to_uv = Transform::scale({-1, 1, 1}) * board->to_uv;
}

void plant(SceneDescription& scene, const std::string& fault, const Words& words) {
  if (fault == "brighter-light") brighten(scene);
  if (fault == "flipped-normal") scene.shapes.at(1).flip_normals = !scene.shapes.at(1).flip_normals;
  if (fault == "shifted-camera")
    std::get<PerspectiveDescription>(scene.sensor.camera).principal_x += 0.5 / std::stod(after(words, "--size"));
  if (fault == "mirrored-texture") mirror_textures(scene);
  if (fault == "half-absorption")
    for (MediumDescription& medium : scene.media) std::visit([](auto& model) { model.scale *= 0.5; }, medium.model);
  change_materials(scene, fault);
}

int run_words(const Words& words) {
  const ProcessOutcome outcome = run_process(words);
  std::fprintf(stderr, "%s", outcome.standard_error.c_str());
  return outcome.end == ProcessOutcome::End::exited ? outcome.exit_code : 1;
}

/// Encodes with a gamma of 2.2 where linear values are expected.
void encode(const std::string& file) {
  Rendering rendering = read_rendering(file);
  for (std::size_t i = 0; i < rendering.mean.rgb.size(); ++i) {
    const float linear = std::max(1e-6f, rendering.mean.rgb[i]), shown = std::pow(linear, 1 / 2.2f);
    rendering.mean.rgb[i] = shown;
    if (rendering.variance) rendering.variance->rgb[i] *= std::pow(shown / linear / 2.2f, 2.0f);
  }
  write_exr(file, rendering);
}

/// Subtracts half of the caustic map's light, which a view of it shows alone.
int halve_caustics(Words words, const std::string& file) {
  const std::string view = file + ".caustics.exr";
  *(std::find(words.begin(), words.end(), "-o") + 1) = view;
  words.insert(words.end(), {"--view", "caustics"});
  if (const auto stats = std::find(words.begin(), words.end(), "--stats"); stats != words.end())
    words.erase(stats, stats + 2);
  if (const int code = run_words(words); code != 0) return code;
  Rendering rendering = read_rendering(file);
  const Rendering caustics = read_rendering(view);
  for (std::size_t i = 0; i < rendering.mean.rgb.size(); ++i) rendering.mean.rgb[i] -= caustics.mean.rgb[i] / 2;
  write_exr(file, rendering);
  return 0;
}

int planted(const std::string& fault, Words words) {
  const std::string file = after(words, "-o");
  const auto scene_word = std::find_if(words.begin(), words.end(), [](const auto& w) { return w.ends_with(".xml"); });
  ParseOptions anywhere;
  anywhere.allow_outside = true;
  SceneDescription scene = parse_scene_file(*scene_word, anywhere);
  plant(scene, fault, words);
  *scene_word = file + ".xml";
  write_file_atomically(*scene_word, write_scene(with_absolute_files(scene)));
  if (const int code = run_words(words); code != 0) return code;
  if (fault == "gamma") encode(file);
  return fault == "half-caustic" ? halve_caustics(words, file) : 0;
}

}  // namespace
}  // namespace photonproof::inline harness_verify

int main(int argc, char** argv) try {
  if (argc < 3) return 2;
  return photonproof::planted(argv[1], {argv + 2, argv + argc});
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
