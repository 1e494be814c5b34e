// The defects of wrong images, in sentences (harness/diagnosis).
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "harness/diagnosis/diagnosis.h"
#include "harness/grading/scene_grading.h"
#include "harness/variants/own_engine.h"

namespace photonproof::inline harness_grading {

class SceneFindings {
 public:
  SceneFindings(const Assignment& assignment, const std::vector<WorkScene>& scenes,
                const std::vector<std::optional<SceneReference>>& references, OwnEngine engine,
                std::function<void(const std::string&)> progress)
      : assignment_(assignment),
        scenes_(scenes),
        references_(references),
        engine_(std::move(engine)),
        progress_(std::move(progress)),
        known_(scenes.size()) {}

  /// Adds findings where the scene's verdict is wrong. A scene with another verdict becomes wrong if a mistake is found
  /// that noise or wide bounds hide. The knowledge of a scene is rendered when an image first needs it. Threads may
  /// call it at once.
  void add(std::size_t scene, SceneWorkGrade& work);

  /// Scenes whose light could not be rendered, so that their sentences do without it: a sentence each.
  std::vector<std::string> problems() const;

 private:
  const SceneKnowledge& knowledge(std::size_t scene);
  using Find = std::vector<Finding> (*)(const Image&, const SceneKnowledge&);
  std::vector<Finding> found_in(const Image& image, std::size_t scene, Find find);
  std::vector<Finding> mistakes_in(const SceneWorkGrade& work, std::size_t scene);
  SceneKnowledge found_out(std::size_t scene) const;

  const Assignment& assignment_;
  const std::vector<WorkScene>& scenes_;
  const std::vector<std::optional<SceneReference>>& references_;
  OwnEngine engine_;
  std::function<void(const std::string&)> progress_;
  struct Known {
    std::once_flag once;
    SceneKnowledge knowledge;
  };
  std::deque<Known> known_;
  mutable std::mutex telling_;
  std::map<std::size_t, std::string> failures_;  ///< by scene
};

}  // namespace photonproof::inline harness_grading
