#include "reference/mitsuba/mitsuba_export.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <thread>

#include "mitsuba_plugins_text.h"
#include "mitsuba_render_text.h"
#include "reference/mitsuba/mitsuba_lowering.h"
#include "scenes/files/atomic_file.h"
#include "scenes/meshes/ply.h"
#include "scenes/xml/writer.h"

namespace photonproof::inline reference_mitsuba {
namespace {

/// The text with Mitsuba's own names, where the description has no place for them. Our writer's lines are known: an
/// element begins a line, and quotes in values are escaped.
std::string with_other_names(std::string text, const std::vector<std::string>& plugins) {
  const auto replace = [&](const std::string& old, const std::string& by) {
    for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + by.size()))
      text.replace(at, old.size(), by);
  };
  // Mitsuba's thin lens has no such parameters.
  for (const std::string axis : {"x", "y"}) {
    const std::string line = "    <float name=\"principal_point_offset_" + axis + "\" value=\"0\"/>\n";
    replace(line, "");
  }
  if (std::find(plugins.begin(), plugins.end(), "mixture") != plugins.end())
    replace("<bsdf type=\"blendbsdf\"", "<bsdf type=\"mixture\"");
  return text;
}

/// The text after a comment of the explanations.
std::string with_comment(const std::string& text, const std::vector<std::string>& explanations) {
  if (explanations.empty()) return text;
  std::string comment = "<!--\n";
  for (const std::string& line : explanations) comment += "  " + line + "\n";
  return comment + "-->\n" + text;
}

}  // namespace

MitsubaExport export_mitsuba(const SceneDescription& scene, const MitsubaOptions& options) {
  MitsubaLowering lowering(scene, options.stem);
  SceneDescription& lowered = lowering.lowered();
  MitsubaExport result;
  BatchedPicture& picture = result.picture;
  picture.width = options.width > 0 ? options.width : scene.sensor.film.width;
  picture.height = options.height > 0 ? options.height : scene.sensor.film.height;
  picture.film = scene.sensor.film;
  picture.film.resize(picture.width, picture.height);
  lowered.sensor.film = picture.film;
  result.samples = options.samples > 0 ? options.samples : scene.sensor.sample_count;
  lowered.sensor.sample_count = result.samples;
  picture.batches = engine_batches(result.samples, options.seed);
  result.threads =
      options.threads > 0 ? options.threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  result.variant = options.variant;

  lower_view(lowering);
  lower_textures(lowering);
  lower_bsdfs(lowering);
  lower_media(lowering);
  lower_shapes(lowering);
  lower_lights(lowering);

  result.text = with_comment(with_other_names(write_scene(lowered), lowering.plugins()), lowering.explanations());
  result.files = lowering.files();
  result.explanations = lowering.explanations();
  result.plugins = lowering.plugins();
  return result;
}

void write_mitsuba(const MitsubaExport& scene, const std::filesystem::path& target) {
  for (const MitsubaFile& file : scene.files) {
    const std::filesystem::path path = target.parent_path() / file.name;
    if (file.image)
      write_exr(path.string(), Rendering{*file.image, {}, {}});
    else
      write_ply(path, *file.mesh);
  }
  write_file_atomically(target, scene.text);
}

std::string mitsuba_script() { return std::string(mitsuba_plugins_text) + "\n\n" + mitsuba_render_text; }

std::string mitsuba_job(const MitsubaExport& scene) {
  nlohmann::ordered_json batches = nlohmann::ordered_json::array();
  for (const EngineBatch& batch : scene.picture.batches) batches.push_back({batch.samples, batch.seed});
  const nlohmann::ordered_json job = {
      {"variant", scene.variant}, {"threads", scene.threads}, {"plugins", scene.plugins}, {"batches", batches}};
  return job.dump() + "\n";
}

}  // namespace photonproof::inline reference_mitsuba
