#include "harness/stress/soak/soak_run.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>

#include "harness/cells/folder_lock.h"
#include "harness/cells/host.h"
#include "harness/cells/side_by_side.h"
#include "harness/stress/soak/soak_scenes.h"
#include "reference/store/reference_store.h"
#include "scenes/base/input_error.h"
#include "scenes/base/json_text.h"
#include "scenes/base/process.h"
#include "scenes/base/timer.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/file_checksum.h"

namespace photonproof::inline harness_stress_soak {
namespace {

namespace fs = std::filesystem;
constexpr double render_limit = 120;  // seconds; a small render that takes longer hangs
constexpr double disk_bound = 16;     // bytes a render: times in the stats vary in their digits
constexpr std::size_t most_problems = 20;

struct Render {
  SoakKind kind;
  std::vector<std::string> arguments;  // arguments of `photonproof render`
  fs::path image;
  std::vector<double> peaks;
};

/// The content of a folder.
struct FolderSize {
  std::set<std::string> files;
  double bytes = 0;
};

FolderSize size_of(const fs::path& folder) {
  FolderSize size;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    size.files.insert(entry.path().lexically_relative(folder).string());
    size.bytes += static_cast<double>(entry.file_size());
  }
  return size;
}

class Soak {
 public:
  explicit Soak(const SoakOptions& options) : options_(options), images_(options.folder / "images") {
    record_.created = utc_now();
    record_.program = options.version;
    record_.checksum = file_checksum(options.program);
    record_.command = options.command;
    record_.asked = options.renders;
    const Host host = describe_host();
    cores_ = host.cores;
    record_.host = host.cpu + ", " + std::to_string(host.cores) + " cores, " + host.os;
  }

  SoakRecord run() {
    const Timer timer;
    fs::remove_all(images_);
    for (const fs::path& made : {options_.folder / "scenes", images_}) fs::create_directories(made);
    list_kinds(write_soak_scenes(options_.folder / "scenes"));
    by_processes();
    if (!record_.interrupted) within_one();
    for (const Render& render : renders_) record_.kinds.push_back(render.kind);
    record_.seconds = timer.seconds();
    write_soak_record(record_, options_.folder / "soak.json");
    return record_;
  }

 private:
  bool is_interrupted() const { return options_.interrupt != nullptr && *options_.interrupt; }

  void problem(const std::string& sentence) {
    if (record_.problems.size() < most_problems) record_.problems.push_back(sentence);
  }

  void list_kinds(const std::vector<SoakScene>& scenes) {
    for (const SoakScene& scene : scenes)
      for (const SoakMethod& method : options_.methods) {
        Render render;
        render.kind = {scene.name, method.name, {}, {}};
        std::string file = scene.name + "-" + method.name + ".exr";
        std::replace(file.begin(), file.end(), ' ', '-');
        render.image = images_ / file;
        render.arguments = {scene.file.string(),
                            "-o",
                            render.image.string(),
                            "--size",
                            "16x16",
                            "--spp",
                            "4",
                            "--seed",
                            std::to_string(options_.seed),
                            "--threads",
                            "1",
                            "--quiet"};
        render.arguments.insert(render.arguments.end(), method.arguments.begin(), method.arguments.end());
        renders_.push_back(std::move(render));
      }
  }

  std::size_t rendered_kinds() const {
    return static_cast<std::size_t>(
        std::count_if(renders_.begin(), renders_.end(), [](const Render& r) { return r.kind.refused.empty(); }));
  }

  std::size_t cycles() const {
    const std::size_t kinds = std::max<std::size_t>(rendered_kinds(), 1);
    return std::max<std::size_t>((options_.renders + kinds - 1) / kinds, 1);
  }

  static std::string where(const Render& render, std::size_t cycle) {
    return render.kind.scene + " by " + render.kind.method + ", render " + std::to_string(cycle + 1);
  }

  void render_once(Render& render, std::size_t cycle) {
    std::vector<std::string> argv{options_.program.string(), "render"};
    argv.insert(argv.end(), render.arguments.begin(), render.arguments.end());
    ProcessOptions how;
    how.wall_limit_seconds = render_limit;
    how.interrupt = options_.interrupt;
    const ProcessOutcome outcome = run_process(argv, how);
    const std::lock_guard lock(telling_);
    if (is_interrupted()) return;
    if (cycle == 0 && outcome.end == ProcessOutcome::End::exited && outcome.exit_code == 2) {
      render.kind.refused = last_line(outcome.standard_error);
      return;
    }
    if (!outcome.ok()) {
      problem(where(render, cycle) + " " + outcome.sentence() + ": " + last_line(outcome.standard_error));
      return;
    }
    ++record_.by_processes;
    render.peaks.push_back(static_cast<double>(outcome.peak_bytes));
    check_bits(render, file_checksum(render.image), where(render, cycle));
  }

  void check_bits(Render& render, const std::string& checksum, const std::string& what) {
    if (render.kind.checksum.empty()) render.kind.checksum = checksum;
    if (checksum != render.kind.checksum) problem(what + ": other bits than the first time");
  }

  void by_processes() {
    std::vector<double> peaks, disk;
    FolderSize first;
    std::size_t cycle = 0;
    for (; cycle < cycles() && !is_interrupted(); ++cycle) {
      side_by_side(renders_.size(), cores_, [&](std::size_t i) {
        if (renders_[i].kind.refused.empty() && !is_interrupted()) render_once(renders_[i], cycle);
      });
      if (is_interrupted()) break;
      if (rendered_kinds() == 0) throw InputError(options_.program.string(), "renders none of the scenes");
      double peak = 0;
      for (const Render& render : renders_)
        if (!render.peaks.empty()) peak += render.peaks.back();
      peaks.push_back(peak);  // sum over all kinds, so that a step is a cycle
      const FolderSize size = size_of(images_);
      if (cycle == 0) first = size;
      for (const std::string& file : size.files)
        if (first.files.insert(file).second) problem(file + ": a file that was not there after the first cycle");
      disk.push_back(size.bytes);
      if (options_.progress) options_.progress(record_.by_processes, 2 * cycles() * rendered_kinds());
    }
    record_.interrupted = is_interrupted();
    // The first render of a kind may find less of its libraries in memory than later ones.
    add_series("peak memory of processes", peaks, std::min<std::size_t>(1, peaks.size()), options_.memory_bound,
               1.0 / static_cast<double>(std::max<std::size_t>(rendered_kinds(), 1)));
    add_series("disk", disk, std::min<std::size_t>(1, disk.size()), disk_bound, 1);
  }

  /// `share`: the part of a cycle's value that one render has. Growth and bound are a render, a step is a cycle.
  void add_series(const std::string& name, const std::vector<double>& values, std::size_t warm_up, double bound,
                  double share) {
    const auto kinds = static_cast<double>(std::max<std::size_t>(rendered_kinds(), 1));
    SoakSeries series{name, "bytes", {}, warm_up, bound};
    for (const double value : values) series.values.push_back(value * share);
    series.drift = drift_of(std::span(series.values).subspan(warm_up), bound * kinds);
    series.drift.slope /= kinds;
    series.drift.interval.low /= kinds;
    series.drift.interval.high /= kinds;
    record_.series.push_back(std::move(series));
  }

  /// Writes the renders of the second half and the number of cycles.
  void write_job() const {
    nlohmann::ordered_json job = {{"cycles", cycles()},
                                  {"renders", nlohmann::ordered_json::array()},
                                  {"images", nlohmann::ordered_json::array()}};
    for (const Render& render : renders_) {
      if (!render.kind.refused.empty()) continue;
      job["renders"].push_back(render.arguments);
      job["images"].push_back(render.image.string());
    }
    write_file_atomically(options_.folder / "within.json", json_text(job) + "\n");
  }

  void within_one() {
    write_job();
    ProcessOptions how;
    how.wall_limit_seconds = render_limit + render_limit / 60 * static_cast<double>(cycles() * rendered_kinds());
    how.interrupt = options_.interrupt;
    std::uint64_t done = record_.by_processes;
    how.on_stderr = [&](std::string_view text) {
      done += static_cast<std::uint64_t>(std::count(text.begin(), text.end(), '.')) * rendered_kinds();
      if (options_.progress) options_.progress(done, 2 * cycles() * rendered_kinds());
    };
    const FolderSize before = size_of(images_);
    const ProcessOutcome outcome =
        run_process({options_.within.string(), "soak", "--within", options_.folder.string()}, how);
    record_.interrupted = is_interrupted();
    if (record_.interrupted) return;
    if (!outcome.ok()) {
      problem("all renders within one process: " + outcome.sentence() + ": " + last_line(outcome.standard_error));
      return;
    }
    if (size_of(images_).files != before.files) problem("renders within one process left other files than processes");
    read_samples();
  }

  void read_samples() {
    const nlohmann::ordered_json samples =
        nlohmann::ordered_json::parse(read_file(options_.folder / "within-samples.json"));
    const auto heap = samples.at("heap").get<std::vector<double>>();
    const std::size_t warm_up = heap.size() / 4;  // caches of libraries fill
    record_.within_one = heap.size() * rendered_kinds();
    add_series("heap within one process", heap, warm_up, options_.memory_bound, 1);
    add_series("resident memory within one process", samples.at("resident").get<std::vector<double>>(), warm_up,
               options_.memory_bound, 1);
    compare_bits(samples.at("checksums"), 0);
    if (samples.contains("other_bits"))
      compare_bits(samples["other_bits"].at("checksums"), samples["other_bits"].at("cycle").get<std::size_t>());
  }

  void compare_bits(const nlohmann::ordered_json& checksums, std::size_t cycle) {
    std::size_t i = 0;
    for (Render& render : renders_)
      if (render.kind.refused.empty())
        check_bits(render, checksums.at(i++).get<std::string>(), where(render, cycle) + " within one process");
  }

  const SoakOptions& options_;
  fs::path images_;
  SoakRecord record_;
  std::vector<Render> renders_;
  std::mutex telling_;
  int cores_ = 1;
};

}  // namespace

SoakRecord run_soak(const SoakOptions& options) {
  const FolderLock lock(options.folder);
  return Soak(options).run();
}

}  // namespace photonproof::inline harness_stress_soak
