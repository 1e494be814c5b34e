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
  return {text, model.parent_path(), {"no light: white light of radiance 1 comes from all around"}};
}

fs::path reader_program() {
  std::error_code ignored;
  const fs::path beside = fs::read_symlink("/proc/self/exe", ignored).parent_path() / "photonproof-read-model";
  return fs::exists(beside, ignored) ? beside : fs::path(PHOTONPROOF_PROGRAM_FOLDER) / "photonproof-read-model";
}

}  // namespace

bool is_model(const fs::path& file) {
  const std::string ending = ending_of(file);
  return ending == ".ply" || ending == ".obj" || ending == ".serialized" || ending == ".gltf" || ending == ".glb";
}

ModelScene read_model(const fs::path& model, const fs::path& folder) {
  const std::string ending = ending_of(model);
  if (ending == ".ply" || ending == ".serialized" || (ending == ".obj" && !names_materials(model)))
    return scene_of_mesh(model);
  constexpr double most_seconds = 300;
  const ProcessOutcome outcome = run_process({reader_program().string(), fs::absolute(model).string(), folder.string()},
                                             {.wall_limit_seconds = most_seconds});
  if (!outcome.ok()) {
    const std::string message = last_line(outcome.standard_error);
    const auto text = message.find(": error: ");
    throw InputError(model.string(), outcome.end == ProcessOutcome::End::exited && text != std::string::npos
                                         ? message.substr(text + 9)
                                         : "cannot be read as a model: its reader " + outcome.sentence());
  }
  ModelScene scene{read_file(folder / "scene.xml"), folder, {}};
  std::istringstream lines(outcome.standard_output);
  for (std::string line; std::getline(lines, line);) scene.remarks.push_back(printable(line));
  return scene;
}

}  // namespace photonproof::inline scenes_dialect
