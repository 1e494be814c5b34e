// Verifies scenes: every engine that can renders each scene, and pairs are compared. Where some differ, the report
// names the wrong engine, the place, and the pass of light.
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
  int width = 0, height = 0;                  ///< 0: that of the stored reference, else 64 pixels on the longer side
  bool probes = true;
  std::string command, version;                           ///< for the record
  std::function<void(const VerifyScene& scene)> ended{};  ///< after each scene
};

/// Throws InputError where a scene cannot be read, an engine requested by name is missing, or the folder cannot be
/// used. After every scene verify.json is written, so that finished work is never lost. `interrupted` is set if Ctrl-C
/// ended the run.
VerifyRecord run_verify(VerifyOptions options);

}  // namespace photonproof::inline harness_verify
