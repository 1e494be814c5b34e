#include "harness/references/given_reference.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>

#include "harness/cells/host.h"
#include "harness/cells/side_by_side.h"
#include "harness/images/engine_version.h"
#include "harness/images/image_source.h"
#include "harness/pixels/display.h"
#include "harness/references/suite_scene.h"
#include "harness/statistics/batch_means.h"
#include "harness/suites/engine_command.h"
#include "scenes/base/input_error.h"
#include "scenes/base/size_text.h"
#include "scenes/files/file_checksum.h"
#include "scenes/files/scratch_folder.h"

namespace photonproof::inline harness_references {
namespace {

namespace fs = std::filesystem;

bool is_encoded(const fs::path& file) {
  const ImageRows rows(file.string());
  return std::ranges::any_of(rows.remarks(),
                             [](const std::string& remark) { return remark.find("sRGB") != std::string::npos; });
}

double decoded(double value, const std::string& transfer) {
  if (transfer == "linear" || value <= 0) return value;
  if (transfer == "gamma22") return std::pow(value, 2.2);
  return value <= 1 ? decode_srgb(value) : std::pow((value + 0.055) / 1.055, 2.4);
}

/// The file's linear image.
Rendering read_given(const fs::path& file, const std::string& transfer, const SuiteScene& scene) {
  const bool encoded = is_encoded(file);
  Rendering rendering;
  if (transfer.empty() || (encoded && transfer == "srgb")) {
    rendering = read_rendering(file.string());
  } else {
    rendering = encoded ? Rendering{read_texture_image(file.string(), true), {}, {}} : read_rendering(file.string());
    for (float& value : rendering.mean.rgb) value = static_cast<float>(decoded(double{value}, transfer));
    if (transfer != "linear") rendering.variance.reset();  // it is of the encoded values
  }
  if (rendering.mean.width != scene.width || rendering.mean.height != scene.height)
    throw InputError(file.string(), "is " + size_text(rendering.mean.width, rendering.mean.height) +
                                        " pixels, scene '" + scene.name + "' of the suite " +
                                        size_text(scene.width, scene.height) +
                                        ": write width = " + std::to_string(rendering.mean.width) +
                                        " and height = " + std::to_string(rendering.mean.height) + " in its [[scene]]");
  return rendering;
}

Provenance begun(const SuiteScene& scene, const std::string& estimator) {
  const SceneContent content = content_of(scene);
  if (content.crop) throw InputError(scene.path.string(), "has a crop; only our own integrators render its reference");
  Provenance provenance;
  provenance.scene_hash = content.hash;
  provenance.width = scene.width;
  provenance.height = scene.height;
  provenance.estimator = estimator;
  const Host host = describe_host();
  provenance.host = host.cpu + ", " + std::to_string(host.cores) + " cores, " + host.os;
  provenance.date = utc_now();
  provenance.given.emplace();
  return provenance;
}

/// Draws the images of all seeds; empty when interrupted.
std::optional<std::vector<Image>> draw_images(const SuiteCommon& suite, const SuiteScene& scene,
                                              const EngineImages& images, const EngineDraw& draw, Provenance& made) {
  const EngineVersion version = ask_version(images.engine, suite.folder, draw.program);
  if (version.problem) throw InputError(images.engine.name, *version.problem);
  if (!version.line.empty()) made.versions["engine"] = version.line;
  const ScratchFolder scratch("reference");
  SceneCopies copies(scratch.path());
  Limits limits = suite.limits;
  if (limits.threads == 0) limits.threads = 1;
  ImageSource source({.use = ImageUse::verdict,
                      .folder = scratch.path(),
                      .program = draw.program,
                      .suite_folder = suite.folder,
                      .limits = limits,
                      .interrupt = draw.interrupt});
  const ImageEngine engine{&images.engine, version.line};
  const ImageScene drawn{&scene, made.scene_hash, {}, &copies};
  std::vector<Image> all(made.seeds.size());
  std::atomic<bool> stopped = false;
  std::mutex reporting;
  std::size_t done = 0;
  side_by_side(all.size(), usual_executor().at_once(limits.threads), [&](std::size_t i) {
    if (stopped) return;
    const std::optional<KeptImage> image = source.draw(engine, drawn, images.budget, made.seeds[i]);
    if (!image) {
      stopped = true;
      return;
    }
    const Result& result = image->kept.result;
    if (result.status != Status::ok)
      throw InputError(images.engine.name, "made no image of scene '" + scene.name + "' with seed " +
                                               std::to_string(made.seeds[i]) + ": " + result.detail + " (" +
                                               to_string(result.status) + "); its command: " + result.command);
    all[i] = source.image_of(result).mean;
    const std::lock_guard lock(reporting);
    if (i == 0) made.given->command = result.command;
    if (draw.progress) draw.progress(++done, all.size());
  });
  if (stopped) return std::nullopt;
  return all;
}

/// Mean of the images, with the variance that their differences show; 0 of one image.
Rendering mean_rendering(const std::vector<Image>& images, const std::string& where) {
  if (images.size() == 1) return {images[0], Image(images[0].width, images[0].height), {}};
  BatchMeans means(images[0].width, images[0].height, 1);
  for (const Image& image : images) means.add(image, where);
  return means.rendering();
}

}  // namespace

MadeReference reference_from_files(const SuiteScene& scene, const GivenFiles& files) {
  MadeReference made{{}, begun(scene, files.images.size() == 1 ? "golden image" : "golden images")};
  GivenImages& given = *made.provenance.given;
  std::vector<Image> images;
  std::optional<Image> variance;
  for (const fs::path& file : files.images) {
    Rendering rendering = read_given(file, files.transfer, scene);
    images.push_back(std::move(rendering.mean));
    variance = std::move(rendering.variance);
    given.files.push_back(file.filename().string());
    given.checksums.push_back(file_checksum(file));
  }
  given.images = images.size();
  if (!files.transfer.empty() && files.transfer != "linear") given.transfer = files.transfer;
  if (files.transfer.empty() && is_encoded(files.images[0])) given.transfer = "srgb";
  made.rendering = mean_rendering(images, files.images[0].string());
  if (!files.variance.empty()) {
    variance = read_given(files.variance, "linear", scene).mean;
    given.files.push_back(files.variance.filename().string());
    given.checksums.push_back(file_checksum(files.variance));
  } else if (images.size() > 1) {
    variance.reset();  // that of one image alone
  }
  given.noise = variance ? stated_noise : images.size() > 1 ? noise_of_images : unknown_noise;
  if (variance) made.rendering.variance = std::move(*variance);
  return made;
}

std::optional<MadeReference> reference_by_engine(const SuiteCommon& suite, const SuiteScene& scene,
                                                 const EngineImages& images, const EngineDraw& draw) {
  if (images.engine.denoises)
    throw InputError(images.engine.name, "denoises its images, whose errors no number of them averages out");
  constexpr std::uint64_t first_seed = 2'000'000'001;  // fits 31 bits, for engines whose seeds are ints
  MadeReference made{{}, begun(scene, images.engine.name)};
  const bool takes_seed = mentions(images.engine.command, "{seed}");
  const int count = takes_seed ? images.count : 1;
  for (int i = 0; i < count; ++i) made.provenance.seeds.push_back(first_seed + static_cast<std::uint64_t>(i));
  const auto drawn = draw_images(suite, scene, images, draw, made.provenance);
  if (!drawn) return std::nullopt;
  if (count > 1 && images.engine.trust == Trust::unbiased &&
      std::ranges::all_of(*drawn, [&](const Image& image) { return image.rgb == drawn->front().rgb; }))
    throw InputError(images.engine.name,
                     "all " + std::to_string(count) + " images are identical; the command probably ignores {seed}");
  made.rendering = mean_rendering(*drawn, images.engine.name);
  GivenImages& given = *made.provenance.given;
  given.noise = noise_of_images;
  given.images = drawn->size();
  if (images.budget.kind == "spp")
    made.provenance.samples = static_cast<std::uint64_t>(images.budget.amount * static_cast<double>(count));
  return made;
}

Provenance store_reference_of(const SuiteScene& scene, const MadeReference& made, const std::string& reason) {
  const fs::path beside = stored_beside(scene);
  std::error_code error;
  fs::create_directories(beside.parent_path(), error);
  if (error) throw InputError(beside.parent_path().string(), "cannot be made: " + error.message());
  return store_given_reference(beside, made.rendering, made.provenance, reason);
}

}  // namespace photonproof::inline harness_references
