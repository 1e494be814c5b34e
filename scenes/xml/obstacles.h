// Parts of a scene that cannot be read. Reading goes on without them, so that one run tells all of them.
#pragma once

#include <string>
#include <unordered_set>
#include <vector>

#include "scenes/base/input_error.h"

namespace photonproof::scene_xml {

class Obstacles {
 public:
  /// Runs `read`. Keeps the InputError that it throws; then the result is false.
  template <class Read>
  bool attempt(Read&& read) {
    try {
      read();
      return true;
    } catch (const InputError& error) {
      if (errors_.size() < kMost && known_.insert(error.summary()).second) errors_.push_back(error);
      return false;
    }
  }

  bool none() const { return errors_.empty(); }
  const std::vector<InputError>& errors() const { return errors_; }
  /// Throws one error that tells all obstacles, if there are any.
  void raise() const;

 private:
  static constexpr std::size_t kMost = 10'000;
  std::vector<InputError> errors_;
  std::unordered_set<std::string> known_;  // a value may be read twice
};

}  // namespace photonproof::scene_xml
