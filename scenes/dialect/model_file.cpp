#include "scenes/dialect/model_file.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>

#include "scenes/base/input_error.h"
#include "scenes/base/process.h"
#include "scenes/base/text_numbers.h"
#include "scenes/base/utf8.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline scenes_dialect {
namespace {

namespace fs = std::filesystem;

std::string ending_of(const fs::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

/// Whether an OBJ file names materials. They stand before the first face.
bool names_materials(const fs::path& obj) {
  std::ifstream file(obj);
  for (std::string line; std::getline(file, line) && !line.starts_with("f ");)
    if (line.starts_with("mtllib")) return true;
  return false;
}

std::string in_xml(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

/// One mesh under white light.
ModelScene scene_of_mesh(const fs::path& model) {
  std::string type = ending_of(model).substr(1), text = "<scene version=\"3.0.0\">\n  <shape type=\"" + type + "\">\n";
  text += "    <string name=\"filename\" value=\"" + in_xml(model.filename().string()) + "\"/>\n";
  text += "    <bsdf type=\"twosided\"><bsdf type=\"diffuse\"/></bsdf>\n  </shape>\n";
  text += "  <emitter type=\"constant\"/>\n</scene>\n";
  return {text, model.parent_path(), {{model.string(), "no light: white light of radiance 1 comes from all around"}}};
}

/// Throws InputError if the reader is not installed.
fs::path reader_program() {
  std::error_code ignored;
  const fs::path folder = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  for (const fs::path& place : {folder, folder / "../libexec/photonproof", fs::path(PHOTONPROOF_PROGRAM_FOLDER)})
    if (fs::exists(place / "photonproof-read-model", ignored)) return place / "photonproof-read-model";
  throw InputError("photonproof-read-model", "models cannot be read without it (Debian: photonproof-formats)");
}

std::vector<std::string> columns_of(const std::string& line) {
  std::vector<std::string> columns;
  std::istringstream parts(line);
  for (std::string part; std::getline(parts, part, '\t');) columns.push_back(printable(part));
  return columns;
}

/// The problems that the reader tells, in the format of its main.cpp. Empty where it ended otherwise.
std::vector<InputError> problems_of(const ProcessOutcome& outcome) {
  std::vector<InputError> problems;
  if (outcome.end != ProcessOutcome::End::exited) return problems;
  std::istringstream lines(outcome.standard_error);
  for (std::string line; std::getline(lines, line);) {
    const std::vector<std::string> columns = columns_of(line);
    if (columns.size() < 4) continue;
    const auto number = parse_integer(columns[1]).value, column = parse_integer(columns[2]).value;
    if (number.value_or(0) > 0 && column.value_or(0) > 0)
      problems.emplace_back(columns[0], static_cast<int>(*number), static_cast<int>(*column), columns[3],
                            columns.size() > 4 ? columns[4] : std::string());
    else
      problems.emplace_back(columns[0], columns[3]);
  }
  return problems;
}

}  // namespace

bool is_model(const fs::path& file) {
  const std::string ending = ending_of(file);
  return ending == ".ply" || ending == ".obj" || ending == ".serialized" || ending == ".gltf" || ending == ".glb" ||
         ending == ".pbrt";
}

ModelScene read_model(const fs::path& model, const fs::path& folder, const ModelOptions& options) {
  const std::string ending = ending_of(model);
  if (ending == ".ply" || ending == ".serialized" || (ending == ".obj" && !names_materials(model)))
    return scene_of_mesh(model);
  constexpr double most_seconds = 300;
  std::vector<std::string> command = {reader_program().string(), model.string(), folder.string()};
  if (options.lenient) command.emplace_back("--lenient");
  if (options.allow_outside) command.emplace_back("--allow-outside");
  const ProcessOutcome outcome = run_process(command, {.wall_limit_seconds = most_seconds});
  if (!outcome.ok()) {
    const std::vector<InputError> problems = problems_of(outcome);
    if (problems.empty())
      throw InputError(model.string(), "cannot be read as a model: its reader " + outcome.sentence());
    throw InputError(problems,
                     std::to_string(problems.size()) + " obstacles; --lenient renders the scene without them");
  }
  ModelScene scene{read_file(folder / "scene.xml"), folder, {}};
  std::istringstream lines(outcome.standard_output);
  for (std::string line; std::getline(lines, line);)
    if (const std::vector<std::string> columns = columns_of(line); columns.size() == 2) {
      if (columns[0].empty())
        scene.included.push_back(columns[1]);
      else
        scene.notes.push_back({columns[0], columns[1]});
    }
  return scene;
}

}  // namespace photonproof::inline scenes_dialect
