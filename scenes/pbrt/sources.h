// The texts of a pbrt scene, places in them, and what is told about those places.
#pragma once

#include <cstddef>
#include <deque>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/description/scene_note.h"
#include "scenes/xml/obstacles.h"

namespace photonproof::inline scenes_pbrt {

/// A byte of one of the files.
struct Place {
  std::size_t file = 0, offset = 0;
};

class PbrtSources {
 public:
  /// Keeps the text; views into it stay valid.
  std::size_t add(std::string name, std::string text) {
    files_.push_back({std::move(name), std::move(text)});
    return files_.size() - 1;
  }
  std::size_t count() const { return files_.size(); }
  std::string_view text(std::size_t file) const { return files_[file].text; }
  const std::string& name(std::size_t file) const { return files_[file].name; }
  /// Throws InputError at a place.
  [[noreturn]] void fail(const Place& at, const std::string& message) const;
  /// "file:line:col"
  std::string where(const Place& at) const;
  /// A line of a file by its name, counted from 1; empty where there is none.
  std::string line(const std::string& file, int number) const;

 private:
  struct File {
    std::string name, text;
  };
  std::deque<File> files_;
};

/// Remarks and obstacles of one reading. A remark is told once, at its first place.
class PbrtLog {
 public:
  explicit PbrtLog(const PbrtSources& sources) : sources_(sources) {}

  void note(const Place& at, const std::string& text) {
    if (known_.insert(text).second) notes_.push_back({sources_.where(at), text});
  }
  /// Runs `read`; what it cannot read is kept. More than a thousand of these end the reading.
  template <class Read>
  void attempt(Read&& read) {
    obstacles_.attempt(std::forward<Read>(read));
    if (obstacles_.errors().size() >= kMost) obstacles_.raise();
  }
  const scene_xml::Obstacles& obstacles() const { return obstacles_; }
  const std::vector<SceneNote>& notes() const { return notes_; }

 private:
  static constexpr std::size_t kMost = 1000;
  const PbrtSources& sources_;
  scene_xml::Obstacles obstacles_;
  std::vector<SceneNote> notes_;
  std::set<std::string> known_;
};

}  // namespace photonproof::inline scenes_pbrt
