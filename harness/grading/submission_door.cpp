#include "harness/grading/submission_door.h"

#include <algorithm>
#include <cmath>

#include "harness/cells/cells.h"
#include "reference/process/process.h"
#include "scenes/text/atomic_file.h"
#include "scenes/text/file_checksum.h"
#include "scenes/text/input_error.h"
#include "scenes/text/scratch_folder.h"

namespace photonproof {
namespace {

namespace fs = std::filesystem;

std::string tree_checksum(const fs::path& tree) {
  std::vector<std::pair<std::string, std::string>> parts;
  if (fs::is_regular_file(tree)) return file_checksum(tree);
  for (const auto& entry : fs::recursive_directory_iterator(tree))
    if (entry.is_regular_file())
      parts.emplace_back(entry.path().lexically_relative(tree).string(), file_checksum(entry.path()));
  std::ranges::sort(parts);
  return content_key(parts);
}

}  // namespace

SubmissionDoor::SubmissionDoor(const Assignment& assignment, const DoorOptions& options)
    : assignment_(assignment), options_(options) {}

std::string SubmissionDoor::containment() const { return "none (--no-sandbox)"; }

PreparedSubmission SubmissionDoor::prepare(const std::string& name, const fs::path& source,
                                           const fs::path& folder) const {
  PreparedSubmission prepared{.name = name, .source = source, .folder = folder};
  fs::create_directories(folder);
  fs::copy(source, folder, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  if (!assignment_.overwrite.empty())
    fs::copy(assignment_.overwrite, folder, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  prepared.checksum = tree_checksum(folder);
  prepared.built = true;
  if (assignment_.build_command.empty()) return prepared;
  std::vector<std::string> command = assignment_.build_command;
  for (std::string& word : command)
    if (const auto at = word.find("{threads}"); at != std::string::npos)
      word.replace(at, 9, std::to_string(options_.threads));
  const ProcessOutcome outcome = run_process(command, {.wall_limit_seconds = assignment_.build_limits.seconds,
                                                       .interrupt = options_.interrupt,
                                                       .working_folder = folder});
  prepared.built = outcome.ok();
  prepared.sentence = outcome.ok() ? "" : outcome.sentence();
  prepared.log_tail = outcome.standard_error;
  prepared.seconds = outcome.wall_seconds;
  return prepared;
}

DoorAnswer SubmissionDoor::run(const PreparedSubmission& submission, const DoorRequest& request) const {
  const ScratchFolder scratch("grade");
  const fs::path folder = scratch.path() / "run";
  fs::copy(submission.folder, folder, fs::copy_options::recursive);
  for (const PlacedFile& file : request.files) {
    fs::create_directories((folder / file.inside).parent_path());
    fs::copy_file(file.outside, folder / file.inside, fs::copy_options::overwrite_existing);
  }
  const std::string output = "output." + assignment_.image.format;
  std::vector<std::string> command = request.command;
  for (std::string& word : command)
    for (const auto& [key, value] : {std::pair<std::string, std::string>{"{output}", output},
                                     {"{scene}", request.scene.string()},
                                     {"{params}", request.params.string()}})
      if (const auto at = word.find(key); at != std::string::npos) word.replace(at, key.size(), value);
  const ProcessOutcome outcome = run_process(command, {.wall_limit_seconds = assignment_.limits.seconds,
                                                       .memory_limit_bytes = assignment_.limits.memory_mb << 20,
                                                       .interrupt = options_.interrupt,
                                                       .working_folder = folder});
  DoorAnswer answer;
  answer.wall_seconds = outcome.wall_seconds;
  answer.cpu_seconds = outcome.cpu_seconds;
  answer.peak_bytes = outcome.peak_bytes;
  answer.log_tail = outcome.standard_error;
  using End = ProcessOutcome::End;
  if (!outcome.ok()) {
    answer.end = outcome.end == End::timed_out       ? "timeout"
                 : outcome.end == End::out_of_memory ? "memory"
                 : outcome.end == End::interrupted   ? "interrupted"
                                                     : "crash";
    answer.sentence = outcome.sentence();
    return answer;
  }
  try {
    if (!fs::exists(folder / output)) {
      answer.end = "no-image";
      answer.sentence = "wrote no image";
      return answer;
    }
    Image image = read_image((folder / output).string());
    if (assignment_.image.gamma && assignment_.image.is_clamped())
      for (float& v : image.rgb) {  // read as sRGB
        const double encoded = v <= 0.0031308 ? 12.92 * double{v} : 1.055 * std::pow(double{v}, 1 / 2.4) - 0.055;
        v = static_cast<float>(std::pow(encoded, *assignment_.image.gamma));
      }
    answer.image = std::move(image);
  } catch (const InputError& error) {
    answer.end = "bad-image";
    answer.sentence = "wrote an image that cannot be read: " + error.summary();
  }
  return answer;
}

}  // namespace photonproof
