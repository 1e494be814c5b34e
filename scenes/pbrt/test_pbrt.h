// Reads pbrt scenes in tests.
#pragma once

#include <string>

#include "scenes/files/test_folder.h"
#include "scenes/pbrt/pbrt_scene.h"

namespace photonproof::inline scenes_pbrt {

class PbrtTest : public FolderTest {
 protected:
  /// Throws one error with all problems.
  SceneDescription read(const std::string& text, const PbrtOptions& options = {}) {
    std::filesystem::create_directories(folder_ / "made");
    PbrtSources sources;
    PbrtLog log(sources);
    SceneDescription scene =
        read_pbrt(sources, log, text, (folder_ / "scene.pbrt").string(), folder_ / "made", options);
    notes_ = log.notes();
    log.obstacles().raise();
    return scene;
  }
  SceneDescription world(const std::string& text) { return read("WorldBegin\n" + text); }
  /// The messages of all problems, each on its line, with ":line:col: " before it.
  std::string problems(const std::string& text) {
    std::filesystem::create_directories(folder_ / "made");
    PbrtSources sources;
    PbrtLog log(sources);
    std::string result;
    const auto add = [&](const InputError& error) {
      result += error.place().substr(error.place().rfind('/') + 1) + ": " + error.message() + "\n";
    };
    try {
      read_pbrt(sources, log, text, (folder_ / "scene.pbrt").string(), folder_ / "made", {});
    } catch (const InputError& error) {
      add(error);
    }
    for (const InputError& error : log.obstacles().errors()) add(error);
    return result;
  }
  bool noted(const std::string& part) const {
    for (const SceneNote& note : notes_)
      if (note.text.find(part) != std::string::npos) return true;
    return false;
  }

  std::vector<SceneNote> notes_;
};

}  // namespace photonproof::inline scenes_pbrt
