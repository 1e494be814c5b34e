#include "harness/images/image_source.h"

#include <algorithm>
#include <utility>

#include "harness/cells/cells.h"
#include "harness/cells/host.h"
#include "scenes/base/faults.h"
#include "scenes/base/size_text.h"

namespace photonproof::inline harness_images {

ImageSource::ImageSource(ImageSourceOptions options)
    : options_(std::move(options)),
      store_(options_.store ? options_.store : std::make_shared<ImageStore>(options_.folder)) {
  if (options_.use != ImageUse::measurement) return;
  const Host host = describe_host();
  host_ = host.cpu + "/" + std::to_string(host.cores);
}

std::string ImageSource::key(const ImageEngine& engine, const ImageScene& scene, const Budget& budget,
                             std::uint64_t seed) const {
  const Limits& limits = options_.limits;
  std::vector<std::pair<std::string, std::string>> parts;
  if (options_.use == ImageUse::estimate) parts.emplace_back("verify", "1");
  parts.emplace_back("scene", scene.content);
  parts.emplace_back("engine", engine_content(*engine.row) + length_prefixed(engine.further));
  parts.emplace_back("version", engine.version);
  if (options_.use == ImageUse::verdict) parts.emplace_back("fault", engine.fault + planted_fault());
  parts.emplace_back("budget", budget.label());
  parts.emplace_back("seed", std::to_string(seed));
  parts.emplace_back("size", size_text(scene.row->width, scene.row->height));
  parts.emplace_back("seconds", std::to_string(limits.seconds));
  if (options_.use != ImageUse::estimate) {
    parts.emplace_back("memory_mb", std::to_string(limits.memory_mb));
    parts.emplace_back("threads", std::to_string(limits.threads));
  }
  if (options_.use == ImageUse::measurement) parts.emplace_back("host", host_);
  std::string key = content_key(parts);
  // Without file content the key stays the same.
  if (const std::string file = scene.row->file_content(engine.row->name); !file.empty())
    key = content_key({{"cell", key}, {"file", file}});
  if (scene.crop) key = content_key({{"cell", key}, {"crop", scene.crop->text()}});
  return key;
}

std::optional<KeptImage> ImageSource::draw(const ImageEngine& engine, const ImageScene& scene, const Budget& budget,
                                           std::uint64_t seed) {
  const std::string key = this->key(engine, scene, budget, seed);
  std::unique_lock<std::mutex> drawing;
  if (!options_.reused.empty()) {
    drawing = std::unique_lock(store_->drawing(key));
    if (std::optional<KeptImage> found = find(key);
        found && std::ranges::find(options_.reused, found->kept.result.status) != options_.reused.end())
      return found;
  }
  if (options_.starts) options_.starts({scene.row->name, engine.row->name, budget, seed});
  const std::string folder = claim(key);
  std::optional<Result> result = run_engine(run_of(folder, engine, scene, budget, seed));
  if (!result || (result->status == Status::timeout && is_late())) return std::nullopt;
  result->key = key;
  KeptImage image{{std::move(*result), ""}, folder};
  keep(image);
  return image;
}

EngineRun ImageSource::run_of(const std::string& folder, const ImageEngine& engine, const ImageScene& scene,
                              const Budget& budget, std::uint64_t seed) const {
  EngineRun run{engine, scene, budget, seed, options_.limits, options_.program, options_.suite_folder};
  run.results_folder = options_.folder;
  run.folder = folder;
  run.interrupt = options_.interrupt;
  run.executor = options_.executor;
  run.samples_peak = options_.use == ImageUse::measurement;
  if (options_.until) {
    const std::chrono::duration<double> left = *options_.until - std::chrono::steady_clock::now();
    run.limits.seconds = std::min(run.limits.seconds, left.count());
  }
  return run;
}

Rendering ImageSource::image_of(const Result& result) const {
  return read_stored((options_.folder / result.image).string());
}

EngineStats ImageSource::stats_of(const KeptImage& image) const {
  return read_engine_stats(options_.folder / image.folder / stats_name);
}

}  // namespace photonproof::inline harness_images
