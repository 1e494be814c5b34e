#include "harness/cells/run_cell.h"

#include <fmt/format.h>

#include <utility>

#include "harness/cells/host.h"
#include "harness/metrics/metrics.h"
#include "harness/suites/engine_stats.h"
#include "scenes/base/input_error.h"
#include "scenes/base/process.h"
#include "scenes/base/shell_text.h"
#include "scenes/base/size_text.h"
#include "scenes/base/utf8.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/file_checksum.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_cells {
namespace {

namespace fs = std::filesystem;

// Below this a difference of two clocks that tick every 10 ms says nothing.
constexpr double least_seconds_for_caveats = 0.2;
// Others may take this share of the machine before a timing is doubted.
constexpr double tolerated_share_of_others = 0.1;

// The last line that is not blank, at most 300 bytes of it.
std::string last_words(const std::string& text) {
  const std::string line = printable(last_line(text));
  return line.size() <= 300 ? line : printable("..." + line.substr(line.size() - 297));
}

std::string sentence_with_last_words(const ProcessOutcome& outcome) {
  const std::string words = last_words(outcome.standard_error);
  return outcome.sentence() + (words.empty() ? "" : ": " + words);
}

std::string wrong_size(const CellRun& run, const ImageRows& rows) {
  const ImagePlace film = rows.place().value_or(ImagePlace{0, 0, rows.width(), rows.height()});
  const std::string crop = run.crop ? " or the crop's " + size_text(run.crop->width, run.crop->height) : "";
  return "wrote " + size_text(film.width, film.height) + " pixels instead of " + size_text(run.width, run.height) +
         crop;
}

// Why the image is no result; empty when it is one.
std::optional<std::string> image_problem(const CellRun& run, Result& result) {
  std::error_code ignored;
  if (!fs::exists(run.image, ignored)) return "wrote no image";
  try {
    const ImageRows rows(run.image.string(), run.layer, ImageWindow::stored);  // before memory is taken for it
    if (!run.layer.empty() && rows.layer().empty())
      return "wrote an image without layers, not even '" + run.layer + "'";
    const FilmPart part = run.crop.value_or(whole_film(run.width, run.height));
    if (!has_part(rows.place(), rows.width(), rows.height(), part)) return wrong_size(run, rows);
    if (!rows.layer().empty()) result.caveats.push_back("its image is read from " + printable(rows.remarks().front()));
    Rendering stored = read_rendering(run.image.string(), run.layer, ImageWindow::stored);
    const bool is_kept = run.layer.empty() && is_part(stored, part);
    const Rendering kept = *part_of(std::move(stored), part);
    const std::vector<ImageDefect> defects = find_defects(Image(part.width, part.height), kept.mean);
    if (!defects.empty()) return defects.front().sentence;
    if (!is_kept) write_exr(run.image.string(), kept);
  } catch (const InputError& unreadable) {
    return "wrote an image that cannot be read: " + unreadable.summary();
  }
  return std::nullopt;
}

void set_status(const CellRun& run, const ProcessOutcome& outcome, Result& result) {
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
    result.detail = outcome.sentence() + run.start_hint;
  } else {
    result.status = Status::crash;
    result.detail = sentence_with_last_words(outcome);
    if (outcome.end == End::exited) result.detail += run.argument_hint;
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

/// What the engine said, with the scene's own folder instead of the copy it was given.
std::string in_own_words(std::string text, const CellRun& run) {
  if (run.given_folder.empty()) return text;
  const std::string absolute = fs::absolute(run.given_folder).lexically_normal().string();
  for (const std::string& given : {absolute, run.given_folder})
    for (std::size_t at = text.find(given); at != std::string::npos; at = text.find(given, at + run.own_folder.size()))
      text.replace(at, given.size(), run.own_folder);
  return text;
}

// What the engine did to its folder, or a full disk, must not end the run.
void keep_output(const fs::path& file, const std::string& text, Result& result) try {
  if (!text.empty()) write_file_atomically(file, text);
} catch (const InputError& error) {
  result.caveats.push_back("what it printed could not be kept: " + error.summary());
}

}  // namespace

std::optional<Result> run_cell(const CellRun& run) {
  ProcessOptions options;
  options.wall_limit_seconds = run.limits.seconds;
  options.memory_limit_bytes = run.limits.memory_mb << 20;
  options.interrupt = run.interrupt;
  options.processor = run.processor;

  const int cores = describe_host().cores;
  const double own_before = own_cpu_seconds();
  const std::optional<double> busy_before = machine_busy_seconds();
  ProcessOutcome outcome = run_process(run.argv, options);
  if (outcome.end == ProcessOutcome::End::interrupted) return std::nullopt;

  Result result;
  result.cell = run.cell;
  result.command = shell_line(run.typed.empty() ? run.argv : run.typed);
  outcome.standard_output = in_own_words(std::move(outcome.standard_output), run);
  outcome.standard_error = in_own_words(std::move(outcome.standard_error), run);
  if (outcome.end != ProcessOutcome::End::not_started) {
    result.wall_seconds = outcome.wall_seconds;
    result.cpu_seconds = outcome.cpu_seconds;
    result.peak_bytes = outcome.peak_bytes;
    result.instructions = outcome.instructions;
  }
  add_timing_caveats(outcome, busy_before, own_before, cores, result);
  keep_output(run.output_folder / "stdout.txt", outcome.standard_output, result);
  keep_output(run.output_folder / "stderr.txt", outcome.standard_error, result);
  remove_all_abandoned_temporaries(run.output_folder);  // of the engine's processes, which have all ended
  set_status(run, outcome, result);
  result.image_checksum = file_checksum(run.image);
  EngineStats stats = read_engine_stats(run.stats);
  result.phases = std::move(stats.phases);
  result.counts = std::move(stats.counts);
  result.skipped = std::move(stats.skipped);
  for (std::string& words : result.skipped) words = in_own_words(std::move(words), run);
  for (const std::string& loss : stats.losses) result.caveats.push_back(declared_by_engine + in_own_words(loss, run));
  if (stats.problem) result.caveats.push_back("its stats cannot all be used: " + *stats.problem);
  return result;
}

}  // namespace photonproof::inline harness_cells
