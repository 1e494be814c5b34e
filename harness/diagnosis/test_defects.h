// Pictures of library scenes as submissions draw them, right and with defects.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/diagnosis/diagnosis.h"
#include "harness/diagnosis/knowledge.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline harness_diagnosis {

/// Our engine. Its renderings, each by a process, are kept beside the program for all tests.
inline OwnEngine test_engine() {
  OwnEngine engine;
  engine.program = PHOTONPROOF_BINARY;
  const std::filesystem::path build = std::filesystem::path(PHOTONPROOF_BINARY).parent_path().parent_path();
  engine.kept = std::make_shared<ImageStore>(build / "diagnosis_test_cache", false);
  return engine;
}

inline SceneDescription test_scene(const std::string& name) {
  return parse_scene_file(PHOTONPROOF_SOURCE_DIR "/scenes/library/" + name + "/scene.xml");
}

inline Image test_render(const SceneDescription& scene, const OwnRender& render) {
  return render_with(test_engine(), scene, render).mean;
}

/// The image as in a BMP: clamped to white and rounded to 8 bits.
inline Image as_bytes(Image image) {
  for (float& v : image.rgb)
    if (std::isfinite(v)) v = std::round(std::min(1.0f, std::max(0.0f, v)) * 255) / 255;
  return image;
}

inline SceneKnowledge test_knowledge(const std::string& name, int side) {
  const SceneDescription scene = test_scene(name);
  const bool water = name == "course-2";
  OwnRender render{.width = side, .height = side, .spp = water ? 128 : 512, .seed = 99};
  render.integrator = water ? "photonmapper" : "path";
  KnowledgeOptions options;
  options.spp = water ? 8 : 32;
  return knowledge_of(scene, render_with(test_engine(), scene, render), test_engine(), options);
}

inline std::string text_of(const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& f : findings) {
    char share[16];
    std::snprintf(share, sizeof(share), "%.2f", f.explained);
    text += "\n  [" + f.kind + " " + share + "] " + f.sentence + " (" + f.cause + ")";
  }
  return text.empty() ? "\n  none" : text;
}

}  // namespace photonproof::inline harness_diagnosis
