#include "harness/gate_images.h"

#include <algorithm>
#include <atomic>

#include "harness/cell_command.h"
#include "harness/cells.h"
#include "harness/run_cell.h"
#include "harness/side_by_side.h"
#include "scenes/faults.h"
#include "scenes/size_text.h"

namespace photonproof {
namespace {

namespace fs = std::filesystem;

Image upside_down(const Image& image) {
  Image turned = image;
  for (int y = 0; y < image.height; ++y)
    std::copy_n(image.pixel(0, y), 3 * image.width, turned.pixel(0, image.height - 1 - y));
  return turned;
}

constexpr std::uint64_t seeds_of_a_run = 1'000'000;

Image read_rendered(const fs::path& file) {
  Image image = read_image(file.string());
  if (has_fault(Fault::upside_down)) image = upside_down(image);
  return image;
}

}  // namespace

std::string stream_label(const Gate& gate) { return gate.scene + "/" + gate.engine + "/" + gate.budget.label(); }

ImageStream::ImageStream(const GateSuite& suite, const Gate& gate, StreamContent content,
                         std::vector<std::uint64_t> avoided, const DrawOptions& options)
    : suite_(suite),
      scene_(suite.scene(gate.scene)),
      engine_(suite.engine(gate.engine)),
      budget_(gate.budget),
      content_(std::move(content)),
      avoided_(std::move(avoided)),
      options_(options),
      store_(options.folder),
      file_content_(scene_.file_content(engine_.name)),
      seed_(options.seed * seeds_of_a_run) {}

const DrawnImage* ImageStream::failed() const {
  const auto found =
      std::find_if(drawn_.begin(), drawn_.end(), [](const auto& drawn) { return drawn->result.status != Status::ok; });
  return found == drawn_.end() ? nullptr : found->get();
}

std::uint64_t ImageStream::next_seed() {
  while (std::find(avoided_.begin(), avoided_.end(), seed_) != avoided_.end()) ++seed_;
  return seed_++;
}

bool ImageStream::draw(std::size_t count) {
  if (drawn_.size() >= count || failed() != nullptr) return true;
  std::vector<std::uint64_t> seeds;
  for (std::size_t i = drawn_.size(); i < count; ++i) seeds.push_back(next_seed());
  std::vector<std::unique_ptr<DrawnImage>> fresh(seeds.size());
  std::atomic<bool> stop = false;
  side_by_side(seeds.size(), options_.processes, [&](std::size_t i) {
    if (stop) return;
    fresh[i] = draw_one(seeds[i]);
    if (!fresh[i] || fresh[i]->result.status != Status::ok) stop = true;
  });
  for (auto& drawn : fresh) {
    if (drawn == nullptr) break;
    drawn_.push_back(std::move(drawn));
  }
  if (drawn_.size() >= count) return true;
  // Those after a gap are lost; the failure itself must not be.
  for (auto& drawn : fresh)
    if (drawn != nullptr && drawn->result.status != Status::ok) drawn_.push_back(std::move(drawn));
  return failed() != nullptr;
}

std::unique_ptr<DrawnImage> ImageStream::draw_one(std::uint64_t seed) const {
  const Cell cell{scene_.name, engine_.name, budget_, seed};
  std::string key = content_key({{"scene", content_.scene_hash},
                                 {"engine", length_prefixed(engine_.command) + length_prefixed(options_.further)},
                                 {"version", content_.engine_version},
                                 {"fault", options_.fault + planted_fault()},
                                 {"budget", budget_.label()},
                                 {"seed", std::to_string(seed)},
                                 {"size", size_text(scene_.width, scene_.height)},
                                 {"seconds", std::to_string(suite_.limits.seconds)},
                                 {"memory_mb", std::to_string(suite_.limits.memory_mb)},
                                 {"threads", std::to_string(suite_.limits.threads)}});
  if (!file_content_.empty()) key = content_key({{"cell", key}, {"file", file_content_}});
  if (options_.resume)
    if (auto found = store_.latest(key); found && found->kept.result.status == Status::ok) {
      auto drawn = std::make_unique<DrawnImage>();
      drawn->result = std::move(found->kept.result);
      drawn->image = read_rendered(options_.folder / drawn->result.image);
      return drawn;
    }
  const std::string cell_folder = store_.make_folder(key);
  CellCommand command = cell_command(suite_, cell, options_.program, options_.folder / cell_folder, "image",
                                     suite_.limits.threads, options_.copies);
  for (std::vector<std::string>* argv : {&command.argv, &command.typed}) {
    argv->insert(argv->end(), options_.further.begin(), options_.further.end());
    if (!options_.fault.empty()) argv->insert(argv->begin(), {"env", "PHOTONPROOF_FAULT=" + options_.fault});
  }
  const fs::path folder = command.image.parent_path();
  std::optional<Result> result = run_cell(cell_run(cell, command, scene_, suite_.limits, options_.interrupt));
  if (!result) return nullptr;
  auto drawn = std::make_unique<DrawnImage>();
  drawn->result = std::move(*result);
  drawn->result.key = key;
  drawn->result.engine_version = content_.engine_version;
  if (drawn->result.status == Status::ok) {
    drawn->result.image = cell_folder + "/" + command.image.filename().string();
    drawn->image = read_rendered(command.image);
  }
  if (options_.keep) {
    store_.keep(cell_folder, {drawn->result, ""});
  } else {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
  return drawn;
}

}  // namespace photonproof
