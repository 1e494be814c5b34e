#include "harness/grading/autograder.h"

#include <algorithm>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "reports/grades/zip_file.h"
#include "scenes/base/input_error.h"
#include "scenes/base/process.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline harness_grading {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_member_bytes = std::size_t{1} << 30;

bool is_inside(const fs::path& folder, const fs::path& file) {
  const fs::path relative = file.lexically_normal().lexically_relative(folder.lexically_normal());
  return !relative.empty() && *relative.begin() != "..";
}

void refuse_outside(const Assignment& assignment, const fs::path& file) {
  if (file.empty() || is_inside(assignment.folder, file)) return;
  throw InputError(assignment.file.string(),
                   "names '" + file.string() + "', which lies outside its folder and would be missing in the archive");
}

void check_inside(const Assignment& assignment) {
  refuse_outside(assignment, assignment.overwrite);
  refuse_outside(assignment, assignment.baseline);
  for (const AssignmentScene& scene : assignment.scenes)
    for (const fs::path& file : {scene.path, scene.params, scene.params_template, scene.reference, scene.given})
      refuse_outside(assignment, file);
}

// The files that the program loads, from the dynamic linker.
std::vector<std::string> libraries_of(const fs::path& file) {
  std::vector<std::string> libraries;
  std::istringstream lines(run_process({"ldd", file.string()}).standard_output);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find("=> /");
    if (at == std::string::npos) continue;
    std::string library = line.substr(at + 3);
    libraries.push_back(library.substr(0, library.find(" (")));
  }
  return libraries;
}

// The Debian packages that they belong to, without architectures. dpkg knows files by their names at installation,
// which may be links, or lack today's /usr. One call queries all of them, since each call takes some time.
std::set<std::string> packages_of(const std::vector<fs::path>& programs) {
  constexpr std::string_view usr = "/usr";
  std::set<std::string> names;
  for (const fs::path& program : programs)
    for (const std::string& library : libraries_of(program))
      for (const std::string& name : {library, fs::canonical(library).string()}) {
        names.insert(name);
        if (name.starts_with(usr)) names.insert(name.substr(usr.size()));
      }
  std::vector<std::string> question{"dpkg-query", "-S"};
  question.insert(question.end(), names.begin(), names.end());
  std::set<std::string> packages{"bubblewrap", "g++", "make"};
  std::istringstream owners(run_process(question).standard_output);
  for (std::string line; std::getline(owners, line);) packages.insert(line.substr(0, line.find(':')));
  return packages;
}

std::string setup_script(const std::set<std::string>& packages) {
  std::string script =
      "#!/bin/sh\n# Installs what the grader and builds need. For images of the distribution and release that the "
      "archive "
      "was made on.\nset -e\nexport DEBIAN_FRONTEND=noninteractive\napt-get update\napt-get install -y "
      "--no-install-recommends";
  for (const std::string& package : packages) script += " \\\n  " + package;
  return script + "\n";
}

std::string run_script(const Assignment& assignment, bool contained) {
  std::string script = R"sh(#!/bin/sh
# Grades /autograder/submission and leaves results.json where Gradescope looks for it. Where grading is impossible, for
# example without user namespaces, results.json has the reason.
here=${AUTOGRADER:-/autograder}
mkdir -p "$here/results"
"$here/source/bin/photonproof" grade "$here/source/assignment/ASSIGNMENT" "$here/submission" -o "$here/grades"OPTIONS \
  >"$here/grade.log" 2>&1
code=$?
cat "$here/grade.log"
graded=$here/grades/submissions/submission/results.json
[ -f "$graded" ] && exec cp "$graded" "$here/results/results.json"
reason=$(tail -n 1 "$here/grade.log" | tr -cd '\040-\176' | sed 's/[\\"]/\\&/g')
printf '{"score": 0, "output": "The autograder could not grade (exit code %s): %s. The submission is not at fault."}\n' \
  "$code" "$reason" >"$here/results/results.json"
)sh";
  const auto replace = [&](std::string_view word, const std::string& text) {
    script.replace(script.find(word), word.size(), text);
  };
  replace("ASSIGNMENT", assignment.file.filename().string());
  replace("OPTIONS", contained ? "" : " --no-sandbox");
  return script;
}

/// The names in a scene's or model's file that may be other files: quoted texts, or the ends of lines such as
/// "mtllib box.mtl".
std::vector<std::string> names_in(const fs::path& file) {
  const std::string extension = file.extension();
  std::vector<std::string> names;
  if (extension == ".obj" || extension == ".mtl") {
    std::istringstream lines(read_file(file, max_member_bytes));
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("mtllib") || line.starts_with("map_") || line.starts_with("bump"))
        names.push_back(line.substr(line.find_last_of(" \t") + 1));
  } else if (extension == ".xml" || extension == ".pbrt" || extension == ".gltf") {
    std::istringstream parts(read_file(file, max_member_bytes));
    for (std::string part; std::getline(parts, part, '"');) names.push_back(part);
  }
  return names;
}

/// Adds a scene's file, the files that it names, and what these name.
void add_scene(const fs::path& file, std::set<fs::path>& files) {
  if (!files.insert(file.lexically_normal()).second) return;
  constexpr std::size_t longest = 1024;
  for (const std::string& name : names_in(file)) {
    if (name.empty() || name.size() > longest || name.find('\n') != std::string::npos) continue;
    const fs::path named = file.parent_path() / name;
    std::error_code unreachable;
    if (fs::is_regular_file(named, unreachable)) add_scene(named, files);
  }
}

void add_tree(const fs::path& place, std::set<fs::path>& files) {
  if (place.empty()) return;
  if (!fs::is_directory(place))
    files.insert(place.lexically_normal());
  else
    for (const auto& entry : fs::recursive_directory_iterator(place))
      if (entry.is_regular_file()) files.insert(entry.path().lexically_normal());
}

/// The files that grading needs: those that the assignment names, and those that its scenes name.
std::set<fs::path> files_of(const Assignment& assignment) {
  std::set<fs::path> files{assignment.file.lexically_normal()};
  for (const fs::path& place : {assignment.overwrite, assignment.baseline}) add_tree(place, files);
  for (const AssignmentScene& scene : assignment.scenes) {
    if (!scene.path.empty()) add_scene(scene.path, files);
    for (const fs::path& file : {scene.params, scene.params_template, scene.reference, scene.given})
      add_tree(file, files);
  }
  return files;
}

ZipMember member_of(const fs::path& file, const std::string& name) {
  const bool executable = (fs::status(file).permissions() & fs::perms::owner_exec) != fs::perms::none;
  return {name, read_file(file, max_member_bytes), executable};
}

}  // namespace

std::vector<std::string> write_autograder(const Assignment& assignment, const AutograderOptions& options,
                                          const fs::path& archive) {
  check_inside(assignment);
  check_replaceable(archive);
  std::vector<fs::path> programs{options.program};
  std::vector<ZipMember> members{member_of(options.program, "bin/photonproof")};
  const fs::path modules = options.program.parent_path().parent_path() / "lib";
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(modules, none))
    if (entry.is_regular_file() && entry.path().extension() == ".so") {
      programs.push_back(entry.path());
      members.push_back(member_of(entry.path(), "lib/" + entry.path().filename().string()));
    }
  members.push_back({"setup.sh", setup_script(packages_of(programs)), true});
  members.push_back({"run_autograder", run_script(assignment, options.contained), true});
  for (const fs::path& file : files_of(assignment)) {
    refuse_outside(assignment, file);
    members.push_back(
        member_of(file, "assignment/" + file.lexically_relative(assignment.folder.lexically_normal()).string()));
  }
  std::ranges::sort(members, {}, &ZipMember::name);
  write_file_atomically(archive, zip_bytes(members));
  std::vector<std::string> names;
  for (const ZipMember& member : members) names.push_back(member.name);
  return names;
}

}  // namespace photonproof::inline harness_grading
