#include "scenes/plugins.h"

namespace photonproof::scene_xml {

std::string title_of(const Sources& sources, const Element& object) {
  return object.tag + " " + in_quotes(require(sources, object, "type").value);
}

void check_nested(const Sources& sources, const Element& object, const std::vector<std::string>& nested) {
  std::vector<std::string> seen;
  for (const Element& child : object.children) {
    if (is_parameter_tag(child.tag)) continue;
    if (std::find(nested.begin(), nested.end(), child.tag) == nested.end()) {
      std::vector<std::string> expected = {"parameters"};
      for (const std::string& tag : nested) expected.push_back("<" + tag + ">");
      sources.fail(child.at, "<" + child.tag + "> is not supported in " + title_of(sources, object) +
                                 did_you_mean(child.tag, nested) + ", expected " + join_or(expected));
    }
    if (std::find(seen.begin(), seen.end(), child.tag) != seen.end())
      sources.fail(child.at, title_of(sources, object) + " has a second <" + child.tag + ">, expected one");
    seen.push_back(child.tag);
  }
}

const Element* find_nested(const Element& object, std::string_view tag) {
  const auto& children = object.children;
  const auto found = std::find_if(children.begin(), children.end(), [&](const Element& c) { return c.tag == tag; });
  return found == children.end() ? nullptr : &*found;
}

std::string id_of(const Element& object) {
  const Attribute* id = object.find("id");
  return id ? id->value : std::string();
}

}  // namespace photonproof::scene_xml
