#include "harness/submissions/submission.h"

#include <array>
#include <fstream>
#include <string_view>
#include <vector>

#include "harness/sandbox/sandbox.h"
#include "harness/submissions/submission_tree.h"
#include "scenes/base/input_error.h"
#include "scenes/base/utf8.h"

namespace photonproof::inline harness_submissions {
namespace {

namespace fs = std::filesystem;

constexpr const char* archive_inside = "/submission.archive";
// Exit code of the scripts below after a sentence on standard output.
constexpr int refused = 10;

// Checks names only to report them to the author; nothing in the archive can leave the sandbox.
constexpr const char* unpack_archive = R"sh(
bsdtar -tf "$0" >/tmp/names || exit 1
name=$(grep -m 1 -E '^/|(^|/)\.\.(/|$)' /tmp/names) && { echo "$name would be unpacked outside of it"; exit 10; }
bsdtar -tvf "$0" >/tmp/kinds || exit 1
name=$(grep -m 1 '^[bcps]' /tmp/kinds) && { echo "${name##* } is a device, a pipe or a socket"; exit 10; }
rm /tmp/names /tmp/kinds
exec bsdtar -x -f "$0" --no-same-owner --no-same-permissions --no-acls --no-xattrs --no-fflags
)sh";
// A bundle need not mark one of its branches as the current one.
constexpr const char* unpack_bundle = R"sh(
git clone -q --template= --no-checkout "$0" . || exit 1
git checkout -q 2>/dev/null || git checkout -q "$(git for-each-ref --count=1 --format='%(refname)' refs/remotes)" || exit 1
exec rm -rf .git
)sh";

enum class Form { folder, archive, bundle, unknown };

Form form_of(const fs::path& source) {
  if (fs::is_directory(source)) return Form::folder;
  if (!fs::is_regular_file(source)) return Form::unknown;
  std::string start(512, '\0');
  std::ifstream in(source, std::ios::binary);
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  using namespace std::string_view_literals;
  for (const std::string_view magic : {"# v2 git bundle"sv, "# v3 git bundle"sv})
    if (start.starts_with(magic)) return Form::bundle;
  for (const std::string_view magic :
       {"PK\x03\x04"sv, "PK\x05\x06"sv, "\x1f\x8b"sv, "\xfd\x37zXZ\0"sv, "\x28\xb5\x2f\xfd"sv, "BZh"sv})
    if (start.starts_with(magic)) return Form::archive;
  constexpr std::size_t place_of_ustar = 257;
  return start.substr(place_of_ustar, 5) == "ustar" ? Form::archive : Form::unknown;
}

std::string mebibytes_and_files(const IntakeLimits& limits) {
  return std::to_string(limits.bytes >> 20) + " MiB or " + std::to_string(limits.files) + " files";
}

SandboxOptions intake_options(const IntakeLimits& limits, const Handling& handling, const fs::path& folder) {
  SandboxOptions options;
  options.limits.wall_seconds = limits.seconds;
  options.limits.disk_bytes = limits.bytes;
  options.limits.file_bytes = limits.bytes;
  options.limits.memory_bytes = std::uint64_t{1} << 30;
  options.collect = ".";
  options.collect_to = folder;
  options.contained = handling.contained;
  options.interrupt = handling.interrupt;
  return options;
}

SandboxOutcome unpack(Form form, const fs::path& source, SandboxOptions options) {
  if (form == Form::folder) {
    options.starts_with = source;
    return run_sandboxed({"true"}, options);
  }
  options.mounts = {{source, archive_inside}};
  const char* const script = form == Form::bundle ? unpack_bundle : unpack_archive;
  return run_sandboxed({"/bin/sh", "-c", script, options.contained ? archive_inside : source.string()}, options);
}

// Throws if unpacking failed.
void check_unpacked(const SandboxOutcome& outcome, const IntakeLimits& limits) {
  const ProcessOutcome& process = outcome.process;
  if (outcome.limit == "disk" || outcome.limit == "file size")
    throw SubmissionError("it is more than " + mebibytes_and_files(limits) + " when unpacked");
  if (outcome.limit == "time") throw SubmissionError("it cannot be unpacked: " + outcome.sentence());
  if (process.end == ProcessOutcome::End::exited && process.exit_code == 127)
    throw InputError("bsdtar, git", "are needed to unpack submissions: " + last_line(process.standard_error));
  if (process.end == ProcessOutcome::End::exited && process.exit_code == refused)
    throw SubmissionError(printable(last_line(process.standard_output)));
  if (!process.ok()) {
    const std::string message = last_line(process.standard_error);
    throw SubmissionError("it cannot be unpacked: " + printable(message.empty() ? process.sentence() : message));
  }
  if (!outcome.special.empty()) throw SubmissionError(printable(outcome.special) + " is a device, a pipe or a socket");
}

}  // namespace

void take_in(const Submission& submission, const fs::path& folder, const IntakeLimits& limits,
             const Handling& handling) {
  std::error_code none;
  const fs::path source = fs::canonical(submission.source, none);
  if (none) throw InputError(submission.source.string(), "no such submission: " + none.message());
  const Form form = form_of(source);
  if (form == Form::unknown)
    throw SubmissionError("it is no folder, .zip, .tar, .tar.gz, .tar.bz2, .tar.xz, .tar.zst or git bundle");
  fs::create_directories(folder.parent_path());
  if (!fs::create_directory(folder)) throw InputError(folder.string(), "is there already");
  try {
    check_unpacked(unpack(form, source, intake_options(limits, handling, fs::canonical(folder))), limits);
    if (const std::string wrong = what_is_wrong_with_tree(folder, limits.files); !wrong.empty())
      throw SubmissionError(wrong);
    if (form != Form::folder) enter_only_folder(folder);
    if (fs::is_empty(folder)) throw SubmissionError("it is empty");
  } catch (...) {
    fs::remove_all(folder, none);
    throw;
  }
}

}  // namespace photonproof::inline harness_submissions
