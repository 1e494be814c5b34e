// Verifies scenes: every engine that can renders each, pairs are compared, and where some differ it is said who is
// wrong, where, and in which pass of light.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/verify/engine_renderer.h"
#include "harness/verify/verify_engines.h"
#include "reports/verify/verify_record.h"

namespace photonproof::inline harness_verify {

struct VerifyOptions {
  EngineRendererOptions renderer;  ///< the folder is made and locked by run_verify
  EngineChoice engines;
  std::vector<std::filesystem::path> scenes;  ///< files, or folders with a scene.xml
  int width = 0, height = 0;                  ///< 0: of the stored reference, else 64 pixels on the longer side
  bool probes = true;
  std::string command, version;                           ///< for the record
  std::function<void(const VerifyScene& scene)> ended{};  ///< after each scene
};

/// Throws InputError where a scene cannot be read, an engine that was asked for by name is not there, or the folder
/// cannot be used. verify.json is written after every scene, so that what is done is never lost; `interrupted` says
/// that Ctrl-C ended it.
VerifyRecord run_verify(VerifyOptions options);

}  // namespace photonproof::inline harness_verify
