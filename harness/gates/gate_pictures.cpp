#include "harness/gates/gate_pictures.h"

#include <algorithm>
#include <cctype>

#include "harness/metrics/heatmap.h"

namespace photonproof::inline harness_gates {
namespace {

namespace fs = std::filesystem;

/// The name of a gate or scene, changed to a valid folder name.
std::string folder_name(std::string name) {
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '_' && c != '.' && c != '/') c = '_';
  std::replace(name.begin(), name.end(), '/', '-');
  return name.front() == '.' ? "_" + name : name;
}

}  // namespace

void store_pictures(const Image& mean, const StoredReference& reference, double exposure, const ParameterValues& judged,
                    const fs::path& folder, GateRecord& record) {
  const std::string place = "gates/" + folder_name(record.name);
  fs::create_directories(folder / place);
  record.image = place + "/mean.exr";
  Rendering rendering;
  rendering.mean = mean;
  rendering.place = reference.rendering.place;
  write_exr((folder / record.image).string(), rendering);
  record.pictures["image"] = place + "/mean.png";
  write_png((folder / record.pictures["image"]).string(), mean, exposure);
  HeatmapWriter maps(mean.width, mean.height, folder / place, "map");
  ImageRowSource reference_rows(reference.rendering.mean), mean_rows(mean);
  measure_pair(reference_rows, mean_rows, {.parameters = judged}, &maps);
  const HeatmapFiles files = maps.finish();
  record.pictures["flip"] = place + "/" + files.flip.filename().string();
  record.pictures["error"] = place + "/" + files.error.filename().string();
}

void remove_reference(const std::string& scene, const fs::path& folder) {
  std::error_code ignored;
  for (const char* extension : {".exr", ".png"}) fs::remove(folder / "references" / (scene + extension), ignored);
}

ReferenceRecord store_reference(const StoredReference& reference, const std::string& scene, double exposure,
                                const fs::path& folder) {
  fs::create_directories(folder / "references");
  ReferenceRecord record;
  record.file = reference.file.string();
  record.image = "references/" + scene + ".exr";
  record.picture = "references/" + scene + ".png";
  record.provenance = facts(reference.provenance);
  write_exr((folder / record.image).string(), reference.rendering);
  write_png((folder / record.picture).string(), reference.rendering.mean, exposure);
  return record;
}

}  // namespace photonproof::inline harness_gates
