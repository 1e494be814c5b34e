// Collects the notes of stand-ins.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scenes/base/text_numbers.h"
#include "scenes/description/scene_note.h"
#include "scenes/dialect/element_edit.h"

namespace photonproof::scene_xml {

class StandInNotes {
 public:
  explicit StandInNotes(const Sources& sources) : sources_(sources) {}

  void add(const Element& element, const std::string& text) {
    const SourceLoc loc = sources_.loc(element.at);
    made.push_back({sources_.name(loc.file) + ":" + std::to_string(loc.line) + ":" + std::to_string(loc.column), text});
  }
  /// "bsdf 'ward' is rendered as 'phong': <loss>", before the type is changed.
  void add_stand_in(const Element& element, const std::string& becomes, const std::string& loss) {
    add(element, element.tag + " " + in_quotes(value_of(element, "type")) + " is rendered as " + in_quotes(becomes) +
                     (loss.empty() ? "" : ": " + loss));
  }

  std::vector<SceneNote> made;

 private:
  const Sources& sources_;
};

}  // namespace photonproof::scene_xml
