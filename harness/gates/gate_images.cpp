#include "harness/gates/gate_images.h"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <mutex>

#include "harness/cells/side_by_side.h"
#include "scenes/base/faults.h"

namespace photonproof::inline harness_gates {
namespace {

Image upside_down(const Image& image) {
  Image turned = image;
  for (int y = 0; y < image.height; ++y)
    std::copy_n(image.pixel(0, y), 3 * image.width, turned.pixel(0, image.height - 1 - y));
  return turned;
}

constexpr std::uint64_t seeds_of_a_run = 1'000'000;

ImageSourceOptions source_options(const GateSuite& suite, const DrawOptions& options) {
  ImageSourceOptions source{.use = ImageUse::verdict,
                            .folder = options.folder,
                            .program = options.program,
                            .suite_folder = suite.folder,
                            .limits = suite.limits};
  if (options.resume) source.reused = {Status::ok};
  source.interrupt = options.interrupt;
  return source;
}

}  // namespace

std::string stream_label(const Gate& gate) { return gate.scene + "/" + gate.engine + "/" + gate.budget.label(); }

ImageStream::ImageStream(const GateSuite& suite, const Gate& gate, StreamContent content,
                         std::vector<std::uint64_t> avoided, const DrawOptions& options)
    : engine_{&suite.engine(gate.engine), std::move(content.engine_version), options.further, options.fault},
      scene_{&suite.scene(gate.scene), std::move(content.scene_hash), content.crop, options.copies},
      budget_(gate.budget),
      avoided_(std::move(avoided)),
      processes_(options.processes),
      source_(source_options(suite, options)),
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
  return draw_streams({&demand, 1}, processes_);
}

bool ImageStream::append(std::span<std::unique_ptr<DrawnImage>> fresh) {
  const auto gap = std::find(fresh.begin(), fresh.end(), nullptr);
  std::move(fresh.begin(), gap, std::back_inserter(drawn_));
  if (gap == fresh.end()) return true;
  // Images after a gap are lost, but the failure itself must be kept.
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

std::unique_ptr<DrawnImage> ImageStream::draw_one(std::uint64_t seed) {
  std::optional<KeptImage> image = source_.draw(engine_, scene_, budget_, seed);
  if (!image) return nullptr;
  auto drawn = std::make_unique<DrawnImage>();
  drawn->result = std::move(image->kept.result);
  if (drawn->result.status == Status::ok) {
    drawn->image = source_.image_of(drawn->result).mean;
    if (has_fault(Fault::upside_down)) drawn->image = upside_down(drawn->image);
  }
  return drawn;
}

}  // namespace photonproof::inline harness_gates
