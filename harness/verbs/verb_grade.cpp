// photonproof grade: builds and runs a class's submissions, judges their images and their speed, writes the gradebook.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "harness/grading/assignment.h"
#include "harness/grading/autograder.h"
#include "harness/grading/grade_session.h"
#include "harness/verbs/interrupt.h"
#include "harness/verbs/usage/progress.h"
#include "harness/verbs/usage/verb_usage.h"
#include "harness/verbs/verbs.h"
#include "harness/verbs/versions.h"
#include "reports/grades/grade_pages.h"
#include "reports/grades/gradebook.h"
#include "reports/grades/grades_json.h"
#include "reports/grades/gradescope.h"
#include "scenes/base/input_error.h"
#include "scenes/base/json_text.h"
#include "scenes/base/shell_text.h"
#include "scenes/base/utf8.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline harness_verbs {
namespace {

namespace fs = std::filesystem;

struct GradeArguments {
  std::string assignment, output, only, scene, autograder;
  std::string progress = "auto";
  std::vector<std::string> submissions;
  std::uint64_t seed = 1;
  int threads = 0;
  bool resume = false, fresh = false, json = false, sandbox = true, timing = true;
};

GradeOptions grade_options(const GradeArguments& arguments, const Assignment& assignment, Progress& progress) {
  GradeOptions options;
  options.folder = arguments.output.empty() ? fs::path("out") / assignment.name : fs::path(arguments.output);
  options.program = fs::read_symlink("/proc/self/exe");
  std::vector<std::string> command{"photonproof", "grade", arguments.assignment};
  for (const std::string& submission : arguments.submissions) {
    options.submissions.emplace_back(submission);
    command.push_back(submission);
  }
  command.insert(command.end(), {"-o", options.folder.string(), "--seed", std::to_string(arguments.seed)});
  for (const auto& [name, value] : {std::pair{"--only", &arguments.only}, {"--scene", &arguments.scene}})
    if (!value->empty()) command.insert(command.end(), {name, *value});
  if (!arguments.sandbox) command.emplace_back("--no-sandbox");
  if (!arguments.timing) command.emplace_back("--no-timing");
  options.command = shell_line(command);
  options.versions = program_versions();
  options.only = arguments.only;
  options.scene = arguments.scene;
  options.seed = arguments.seed;
  options.threads = arguments.threads;
  options.resume = arguments.resume;
  options.fresh = arguments.fresh;
  options.contained = arguments.sandbox;
  options.timing = arguments.timing;
  options.interrupt = &interrupt_flag();
  options.progress = [&progress](const std::string& text) { progress.at({.phase = text}); };
  options.heard = [&progress](const SubmissionGrade& grade) {
    progress.say(grade.name + ": " + right_scenes_text(grade) + " scenes right; " + grade.sentence);
  };
  return options;
}

void write_grades(const Grades& grades, const fs::path& folder) {
  write_file_atomically(folder / "gradebook.csv", gradebook_csv(grades));
  for (const SubmissionGrade& submission : grades.submissions) {
    const fs::path file = folder / submission.folder / "results.json";
    fs::create_directories(file.parent_path());
    write_file_atomically(file, json_text(gradescope_results(grades, submission)) + "\n");
    write_student_page(grades, submission, folder, folder / submission.folder / "page.html");
  }
  write_staff_page(grades, folder, folder / "staff.html");
  write_file_atomically(folder / "grades.json", json_text(grades_to_json(grades)) + "\n");
}

int run_grade(const GradeArguments& arguments) {
  const Assignment assignment = read_assignment(arguments.assignment);
  if (!arguments.autograder.empty()) {
    const std::vector<std::string> members =
        write_autograder(assignment, {fs::read_symlink("/proc/self/exe"), arguments.sandbox}, arguments.autograder);
    for (const std::string& name : members) std::printf("  %s\n", name.c_str());
    std::printf("autograder: %s, %zu files\n", arguments.autograder.c_str(), members.size());
    return 0;
  }
  if (arguments.submissions.empty()) throw InputError("submissions", "there are none to grade");
  Progress progress(arguments.progress);
  const GradeOptions options = grade_options(arguments, assignment, progress);
  const Grades grades = grade_submissions(assignment, options);
  progress.clear();
  write_grades(grades, options.folder);
  if (arguments.json) {
    std::printf("%s\n", json_text(grades_to_json(grades)).c_str());
  } else {
    std::printf("%s", grades_table(grades).c_str());
    for (const std::string& caveat : grades.caveats) std::printf("note: %s\n", printable(caveat).c_str());
    for (const auto& [what, name] : {std::pair{"gradebook", "gradebook.csv"},
                                     {"record", "grades.json"},
                                     {"report", "staff.html"},
                                     {"for students", "submissions/*/page.html"}})
      std::printf("%s: %s\n", what, (options.folder / name).c_str());
    if (grades.interrupted) std::printf("interrupted: --resume goes on from here\n");
  }
  return grades.interrupted ? 130 : 0;
}

void add_grade_options(CLI::App& verb, GradeArguments& arguments) {
  begin_option_group(verb, input_group);
  verb.add_option("assignment", arguments.assignment, "assignment: scenes, baseline, points (TOML)")->required();
  verb.add_option("submissions", arguments.submissions, "folders, zip or tar archives, git bundles");
  verb.add_option("--only", arguments.only, "grade only submissions whose name contains this");
  verb.add_option("--scene", arguments.scene, "grade only this scene");
  verb.add_option("--seed", arguments.seed, "seed of the session: same submissions and seed, same verdicts (default 1)")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000'000}));
  begin_option_group(verb, output_group);
  verb.add_option("-o,--output", arguments.output, "results folder (default: out/NAME of the assignment)");
  verb.add_flag("--json", arguments.json, "print the record as JSON");
  verb.add_option("--autograder", arguments.autograder,
                  "write Gradescope's autograder of the assignment (zip); grade nothing");
  begin_option_group(verb, run_group);
  add_progress_option(verb, arguments.progress);
  verb.add_flag("--resume", arguments.resume, "use the runs that an interrupted grading left in the results folder");
  verb.add_flag("--fresh", arguments.fresh, "make references anew (default: use those in the results folder)");
  verb.add_flag("--sandbox,!--no-sandbox", arguments.sandbox,
                "run submissions in a sandbox (default); without it they can do whatever you can do");
  verb.add_flag("--timing,!--no-timing", arguments.timing, "time correct submissions (default)");
  verb.add_option("--threads", arguments.threads, "value of {threads} in commands (default: every core)")
      ->check(CLI::Range(1, 1024));
}

}  // namespace

void add_grade_verb(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<GradeArguments>();
  CLI::App* verb = add_verb(
      program,
      {.name = "grade",
       .group = judge_group,
       .purpose = "Grade a class: build and run submissions, judge images and speed, write the gradebook",
       .examples = {"photonproof grade harness/courses/photon-mapping/assignment.toml class/* -o out/class",
                    "photonproof grade harness/courses/photon-mapping/assignment.toml --autograder autograder.zip"},
       .exit_codes = {{0, "graded, whatever the grades"},
                      {2, "bad input or usage, or the baseline does not run"},
                      internal_error,
                      {130, "interrupted; --resume continues"}}});
  add_grade_options(*verb, *arguments);
  verb->callback([arguments, &exit_code] { exit_code = run_grade(*arguments); });
}

}  // namespace photonproof::inline harness_verbs
