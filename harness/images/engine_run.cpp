#include "harness/images/engine_run.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "harness/cells/host.h"
#include "harness/cells/others_busy.h"
#include "harness/metrics/metrics.h"
#include "harness/suites/engine_command.h"
#include "harness/suites/engine_stats.h"
#include "scenes/base/faults.h"
#include "scenes/base/input_error.h"
#include "scenes/base/shell_text.h"
#include "scenes/base/size_text.h"
#include "scenes/base/utf8.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/file_checksum.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_images {
namespace {

namespace fs = std::filesystem;

// Two clocks that tick every 10 ms do not measure shorter differences.
constexpr double least_seconds_for_caveats = 0.2;
// A timing gets a warning if others use more than this share of the machine.
constexpr double tolerated_share_of_others = 0.1;

struct EngineCommand {
  std::vector<std::string> argv;   // to be started
  std::vector<std::string> typed;  // for the record: with the scene's own path instead of the copy's
  // The copy's folder as in argv, and the scene's own, which replaces it in the engine's messages.
  std::string given_folder, own_folder;
};

fs::path short_path(const fs::path& path) {
  const fs::path near = fs::proximate(path);
  return near.string().size() < path.string().size() ? near : path;
}

EngineCommand command_of(const EngineRun& run) {
  const Engine& engine = *run.engine.row;
  const SuiteScene& scene = *run.scene.row;
  const fs::path& own = scene.file_for(engine.name);
  CommandValues values;
  values.photonproof = short_path(run.program);
  // A bare name would be looked up on PATH.
  if (!values.photonproof.has_parent_path()) values.photonproof = fs::path(".") / values.photonproof;
  values.suite = short_path(run.suite_folder);
  // A word is no path, unless the engine has a file of its own for the scene.
  const bool is_word = scene.reader == SceneReader::engine_by_word && own == scene.path;
  values.scene = is_word ? own : short_path(own);
  values.scene_name = scene.name;
  values.output = run.image();
  values.stats = run.image().replace_filename(stats_name);
  values.width = scene.width;
  values.height = scene.height;
  values.threads = run.limits.threads;
  values.seed = has_fault(Fault::repeated_seed) ? 1 : run.seed;
  values.budget = run.budget;
  if (has_fault(Fault::quarter_budget)) values.budget.amount /= 4;
  EngineCommand command;
  command.typed = fill_command(engine.command, values);
  if (run.scene.copies != nullptr && !is_word) {
    values.scene = short_path(run.scene.copies->of(scene, own));
    command.own_folder = short_path(own.has_parent_path() ? own.parent_path() : fs::path(".")).string();
    command.given_folder = values.scene.parent_path().string();
  }
  command.argv = fill_command(engine.command, values);
  for (std::vector<std::string>* words : {&command.argv, &command.typed}) {
    words->insert(words->end(), run.engine.further.begin(), run.engine.further.end());
    if (!run.engine.fault.empty()) words->insert(words->begin(), {"env", "PHOTONPROOF_FAULT=" + run.engine.fault});
  }
  return command;
}

// The last line that is not blank, at most 300 bytes of it.
std::string last_words(const std::string& text) {
  const std::string line = printable(last_line(text));
  return line.size() <= 300 ? line : printable("..." + line.substr(line.size() - 297));
}

std::string sentence_with_last_words(const ProcessOutcome& outcome) {
  const std::string words = last_words(outcome.standard_error);
  return outcome.sentence() + (words.empty() ? "" : ": " + words);
}

std::string wrong_size(const EngineRun& run, const ImageRows& rows) {
  const ImagePlace film = rows.place().value_or(ImagePlace{0, 0, rows.width(), rows.height()});
  const std::optional<FilmPart>& part = run.scene.crop;
  const std::string crop = part ? " or the crop's " + size_text(part->width, part->height) : "";
  return "wrote " + size_text(film.width, film.height) + " pixels instead of " +
         size_text(run.scene.row->width, run.scene.row->height) + crop;
}

// The reason why the image is no result; empty when it is one.
std::optional<std::string> image_problem(const EngineRun& run, Result& result) {
  const std::string file = run.image().string(), &layer = run.engine.row->layer;
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return "wrote no image";
  try {
    const ImageRows rows(file, layer, ImageWindow::stored);  // before memory is allocated for it
    if (!layer.empty() && rows.layer().empty()) return "wrote an image without layers, not even '" + layer + "'";
    const FilmPart part = run.scene.crop.value_or(whole_film(run.scene.row->width, run.scene.row->height));
    if (!has_part(rows.place(), rows.width(), rows.height(), part)) return wrong_size(run, rows);
    if (!rows.layer().empty()) result.caveats.push_back("its image is read from " + printable(rows.remarks().front()));
    Rendering stored = read_rendering(file, layer, ImageWindow::stored);
    const bool is_kept = layer.empty() && is_part(stored, part);
    const Rendering kept = *part_of(std::move(stored), part);
    const std::vector<ImageDefect> defects = find_defects(Image(part.width, part.height), kept.mean);
    if (!defects.empty()) return defects.front().sentence;
    if (!is_kept) write_exr(file, kept);
  } catch (const InputError& unreadable) {
    return "wrote an image that cannot be read: " + unreadable.summary();
  }
  return std::nullopt;
}

void set_status(const EngineRun& run, const ProcessOutcome& outcome, Result& result) {
  using End = ProcessOutcome::End;
  if (outcome.ok()) {
    if (const auto problem = image_problem(run, result)) {
      result.status = Status::bad_image;
      result.detail = *problem;
    }
  } else if (outcome.end == End::timed_out) {
    result.status = Status::timeout;
    result.detail = outcome.sentence();
  } else if (outcome.end == End::exited && outcome.exit_code == unsupported_exit_code) {
    result.status = Status::unsupported;
    result.detail = last_words(outcome.standard_error);
    if (result.detail.empty()) result.detail = "the engine says so by its exit code and gives no reason";
  } else if (outcome.end == End::not_started) {
    result.status = Status::not_started;
    result.detail = outcome.sentence() + start_hint(run.engine.row->command, run.suite_folder);
  } else {
    result.status = Status::crash;
    result.detail = sentence_with_last_words(outcome);
    if (outcome.end == End::exited) result.detail += argument_hint(run.engine.row->command, run.suite_folder);
  }
}

void add_timing_caveats(const ProcessOutcome& outcome, std::optional<double> busy_before, double own_before, int cores,
                        Result& result) {
  if (outcome.wall_seconds < least_seconds_for_caveats) return;
  if (outcome.cpu_seconds < 0.5 * outcome.wall_seconds)
    result.caveats.push_back(fmt::format("waited more than it computed (CPU {:.2g} s of {:.2g} s wall)",
                                         outcome.cpu_seconds, outcome.wall_seconds));
  const std::optional<double> busy_after = machine_busy_seconds();
  if (!busy_before || !busy_after) return;
  const double others = *busy_after - *busy_before - outcome.cpu_seconds - (own_cpu_seconds() - own_before);
  if (others > tolerated_share_of_others * outcome.wall_seconds * cores)
    result.caveats.push_back(
        fmt::format("host was busy: others used {:.2g} of {} cores meanwhile", others / outcome.wall_seconds, cores));
}

/// The engine's message, with the scene's own folder in place of the copy's.
std::string in_own_words(std::string text, const EngineCommand& command) {
  if (command.given_folder.empty()) return text;
  const std::string absolute = fs::absolute(command.given_folder).lexically_normal().string();
  for (const std::string& given : {absolute, command.given_folder})
    for (std::size_t at = text.find(given); at != std::string::npos;
         at = text.find(given, at + command.own_folder.size()))
      text.replace(at, given.size(), command.own_folder);
  return text;
}

/// A denoised image counts only where the row says so: gates and references must know of it.
void mark_denoised(const std::string& library, const Engine& engine, Result& result) {
  result.caveats.push_back("denoised by " + library + ", which is biased");
  if (engine.denoises || result.status != Status::ok) return;
  result.status = Status::bad_image;
  result.detail = "the image is denoised by " + library + ", and the engine's row lacks denoise = true";
}

// Whatever the engine did to its folder, and a full disk, must not end the run.
void keep_output(const fs::path& file, const std::string& text, Result& result) try {
  if (!text.empty()) write_file_atomically(file, text);
} catch (const InputError& error) {
  result.caveats.push_back("its output could not be kept: " + error.summary());
}

struct TimedRun {
  ProcessOutcome outcome;
  double own_before = 0;              ///< processor seconds of this process when the run began
  std::optional<double> busy_before;  ///< of the machine
  double more_time = 1;               ///< factor on the limit
};

/// Runs the engine. Where other work of the machine took the time until the limit, runs it once more with as much more
/// time.
TimedRun run_beside_others(const EngineRun& run, const std::vector<std::string>& argv, ProcessOptions options) {
  const auto run_once = [&](double more_time, double& wanted) {
    // In tenths of a second, since messages have it; the limit itself may be shorter.
    options.wall_limit_seconds =
        more_time == 1 ? run.limits.seconds : std::ceil(10 * more_time * run.limits.seconds) / 10;
    TimedRun timed{{}, own_cpu_seconds(), machine_busy_seconds(), more_time};
    const OthersBusy busy;
    timed.outcome = run.executor->run(argv, options);
    const bool timed_out = timed.outcome.end == ProcessOutcome::End::timed_out;
    wanted = timed_out ? time_beside_others(busy, timed.outcome.cpu_seconds, timed.outcome.wall_seconds) : 1;
    return timed;
  };
  double wanted = 1;
  TimedRun first = run_once(1, wanted);
  if (wanted == 1) return first;
  for (const fs::path& left : {run.image(), run.place() / stats_name}) {
    std::error_code ignored;
    fs::remove(left, ignored);
  }
  return run_once(wanted, wanted);
}

}  // namespace

fs::path EngineRun::image() const { return short_path(place()) / ("image." + engine.row->image_extension); }

bool exited_with(const Result& result, int exit_code) {
  const std::string start = "exited with " + std::to_string(exit_code), &detail = result.detail;
  return result.status == Status::crash && detail.starts_with(start) &&
         detail.find_first_of("0123456789", start.size()) != start.size();
}

std::optional<Result> run_engine(const EngineRun& run) {
  const EngineCommand command = command_of(run);
  ProcessOptions options;
  options.wall_limit_seconds = run.limits.seconds;
  if (run.limits.memory_mb > 0) options.memory_limit_bytes = run.limits.memory_mb << 20;
  options.interrupt = run.interrupt;
  options.processor = run.processor;
  options.samples_peak = run.samples_peak;

  const int cores = describe_host().cores;
  TimedRun timed = run_beside_others(run, command.argv, options);
  ProcessOutcome& outcome = timed.outcome;
  if (outcome.end == ProcessOutcome::End::interrupted) return std::nullopt;

  Result result;
  result.cell = {run.scene.row->name, run.engine.row->name, run.budget, run.seed};
  result.engine_version = run.engine.version;
  result.command = shell_line(command.typed);
  outcome.standard_output = in_own_words(std::move(outcome.standard_output), command);
  outcome.standard_error = in_own_words(std::move(outcome.standard_error), command);
  if (outcome.end != ProcessOutcome::End::not_started) {
    result.wall_seconds = outcome.wall_seconds;
    result.cpu_seconds = outcome.cpu_seconds;
    result.peak_bytes = outcome.peak_bytes;
    result.instructions = outcome.instructions;
  }
  add_timing_caveats(outcome, timed.busy_before, timed.own_before, cores, result);
  keep_output(run.place() / "stdout.txt", outcome.standard_output, result);
  keep_output(run.place() / "stderr.txt", outcome.standard_error, result);
  remove_all_abandoned_temporaries(run.place());  // temporaries of the engine's processes, which have all ended
  set_status(run, outcome, result);
  if (timed.more_time > 1)
    result.caveats.push_back(fmt::format(
        "a second run, with {:.2g} times the limit: other work used the machine in the first", timed.more_time));
  std::error_code ignored;
  if (fs::exists(run.image(), ignored)) result.image = (run.folder / run.image().filename()).string();
  result.image_checksum = file_checksum(run.image());
  EngineStats stats = read_engine_stats(run.place() / stats_name);
  result.phases = std::move(stats.phases);
  result.counts = std::move(stats.counts);
  result.skipped = std::move(stats.skipped);
  for (std::string& words : result.skipped) words = in_own_words(std::move(words), command);
  for (const std::string& loss : stats.losses)
    result.caveats.push_back(declared_by_engine + in_own_words(loss, command));
  if (stats.denoised) mark_denoised(*stats.denoised, *run.engine.row, result);
  if (stats.problem) result.caveats.push_back("its stats cannot all be used: " + *stats.problem);
  return result;
}

}  // namespace photonproof::inline harness_images
