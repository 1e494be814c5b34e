#include "harness/gates/gate_images.h"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <mutex>

#include "harness/cells/cell_command.h"
#include "harness/cells/cells.h"
#include "harness/cells/run_cell.h"
#include "harness/cells/side_by_side.h"
#include "scenes/base/faults.h"
#include "scenes/base/size_text.h"

namespace photonproof::inline harness_gates {
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
  Image image = read_stored(file.string()).mean;
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
  const StreamDemand demand{this, count};
  return draw_streams({&demand, 1}, options_.processes);
}

bool ImageStream::append(std::span<std::unique_ptr<DrawnImage>> fresh) {
  const auto gap = std::find(fresh.begin(), fresh.end(), nullptr);
  std::move(fresh.begin(), gap, std::back_inserter(drawn_));
  if (gap == fresh.end()) return true;
  // Those after a gap are lost; the failure itself must not be.
  for (auto& drawn : std::span(gap, fresh.end()))
    if (drawn != nullptr && drawn->result.status != Status::ok) drawn_.push_back(std::move(drawn));
  return failed() != nullptr;
}

bool draw_streams(std::span<const StreamDemand> demands, int processes,
                  const std::function<void(std::size_t done, std::size_t total)>& progress) {
  struct Task {
    std::size_t demand;
    std::uint64_t seed;
  };
  std::vector<Task> tasks;
  for (std::size_t d = 0; d < demands.size(); ++d) {
    ImageStream& stream = *demands[d].stream;
    if (stream.failed() != nullptr) continue;
    for (std::size_t i = stream.drawn_.size(); i < demands[d].count; ++i) tasks.push_back({d, stream.next_seed()});
  }
  std::vector<std::unique_ptr<DrawnImage>> fresh(tasks.size());
  std::vector<std::atomic<bool>> stopped(demands.size());
  std::mutex reporting;
  std::size_t done = 0;
  side_by_side(tasks.size(), processes, [&](std::size_t i) {
    const auto [demand, seed] = tasks[i];
    if (stopped[demand]) return;
    fresh[i] = demands[demand].stream->draw_one(seed);
    if (!fresh[i] || fresh[i]->result.status != Status::ok) stopped[demand] = true;
    if (!progress) return;
    const std::lock_guard lock(reporting);
    progress(++done, tasks.size());
  });
  bool complete = true;
  for (std::size_t begin = 0, end = 0; begin < tasks.size(); begin = end) {
    const std::size_t demand = tasks[begin].demand;
    while (end < tasks.size() && tasks[end].demand == demand) ++end;
    if (!demands[demand].stream->append(std::span(fresh).subspan(begin, end - begin))) complete = false;
  }
  return complete;
}

std::unique_ptr<DrawnImage> ImageStream::draw_one(std::uint64_t seed) const {
  const Cell cell{scene_.name, engine_.name, budget_, seed};
  std::string key = content_key({{"scene", content_.scene_hash},
                                 {"engine", engine_content(engine_) + length_prefixed(options_.further)},
                                 {"version", content_.engine_version},
                                 {"fault", options_.fault + planted_fault()},
                                 {"budget", budget_.label()},
                                 {"seed", std::to_string(seed)},
                                 {"size", size_text(scene_.width, scene_.height)},
                                 {"seconds", std::to_string(suite_.limits.seconds)},
                                 {"memory_mb", std::to_string(suite_.limits.memory_mb)},
                                 {"threads", std::to_string(suite_.limits.threads)}});
  if (content_.crop) key = content_key({{"cell", key}, {"crop", content_.crop->text()}});
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
  std::optional<Result> result =
      run_cell(cell_run(cell, command, scene_, content_.crop, suite_.limits, options_.interrupt));
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

}  // namespace photonproof::inline harness_gates
