// photonproof-read-model [--lenient] [--allow-outside] MODEL FOLDER: writes a model, or a scene of pbrt-v4, as a scene
// into a folder. The program photonproof runs it for files that are no XML. Standard output has a remark a line, its
// place, a tab and its text. The place is empty and the text a name where another text was read. Exit codes: 0, and 2
// for a file that cannot be read. Then standard error has a problem a line: file, line, column, message and source
// line, between tabs. Line and column are 0 where they are unknown.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "scenes/base/input_error.h"
#include "scenes/base/utf8.h"
#include "scenes/models/model_scene.h"
#include "scenes/pbrt/pbrt_scene.h"

namespace {

/// A column of a line.
std::string column(std::string text) {
  std::replace(text.begin(), text.end(), '\t', ' ');
  return photonproof::printable(text);
}

void print_problem(const photonproof::InputError& error, const std::string& line) {
  const std::string place = ":" + std::to_string(error.line()) + ":" + std::to_string(error.column());
  std::string file = error.place();
  if (error.line() > 0 && file.ends_with(place)) file.resize(file.size() - place.size());
  std::fprintf(stderr, "%s\t%d\t%d\t%s\t%s\n", column(file).c_str(), error.line(), error.column(),
               column(error.message()).c_str(), column(line).c_str());
}

int read_pbrt_file(const std::string& file, const std::string& folder, bool allow_outside, bool lenient) {
  const photonproof::PbrtReport report = photonproof::write_pbrt_scene(file, folder, {allow_outside}, lenient);
  for (const photonproof::SceneNote& note : report.notes)
    std::printf("%s\t%s\n", column(note.where).c_str(), column(note.text).c_str());
  for (const std::string& name : report.included) std::printf("\t%s\n", column(name).c_str());
  for (const photonproof::PbrtProblem& problem : report.problems) print_problem(problem.error, problem.line);
  return report.problems.empty() ? 0 : 2;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  const auto flag = [&](const char* name) { return std::erase(arguments, name) > 0; };
  const bool lenient = flag("--lenient"), allow_outside = flag("--allow-outside");
  if (arguments.size() != 2) {
    std::fprintf(stderr, "usage: photonproof-read-model [--lenient] [--allow-outside] MODEL FOLDER\n");
    return 2;
  }
  const std::string &model = arguments[0], &folder = arguments[1];
  try {
    if (model.ends_with(".pbrt")) return read_pbrt_file(model, folder, allow_outside, lenient);
    for (const std::string& remark : photonproof::write_model_scene(model, folder, allow_outside))
      std::printf("%s\t%s\n", column(model).c_str(), column(remark).c_str());
    return 0;
  } catch (const photonproof::InputError& error) {
    print_problem(error, "");
  } catch (const std::exception& error) {
    print_problem(photonproof::InputError(model, std::string("cannot be read as a model: ") + error.what()), "");
  }
  return 2;
}
