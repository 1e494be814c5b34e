#include "harness/diagnosis/common_causes.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace photonproof::inline harness_diagnosis {
namespace {

bool says_missing(const Finding& finding) {
  return finding.kind == "object-missing" || finding.kind == "objects-missing";
}

/// "the lamp", "the mirror sphere": what stands before "is missing" or "are missing".
void add_names_of(const Finding& finding, std::vector<std::string>& names) {
  std::string text = finding.sentence;
  for (const char* verb : {" is missing", " are missing"}) text = text.substr(0, text.rfind(verb));
  for (std::size_t start = text.find("the "); start < text.size();) {
    const std::size_t end = std::min(text.find(", the ", start), text.find(" and the ", start));
    names.push_back(text.substr(start, std::min(end, text.size()) - start));
    start = text.find("the ", std::min(end, text.size()));
  }
}

void join_missing(std::vector<Finding>& findings) {
  const auto count = std::count_if(findings.begin(), findings.end(), says_missing);
  if (count < 2) return;
  const auto first = std::find_if(findings.begin(), findings.end(), says_missing);
  std::vector<std::string> names;
  double explained = 0;
  for (const Finding& finding : findings) {
    if (!says_missing(finding)) continue;
    add_names_of(finding, names);
    explained += finding.explained;
  }
  std::string all_names;
  for (std::size_t i = 0; i < names.size(); ++i)
    all_names += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  Finding all{"objects-missing", all_names + " are missing",
              "no ray finds them: the first hit is taken and not the nearest, or the loop over objects ends early",
              first->where, explained};
  const auto place = first - findings.begin();
  std::erase_if(findings, says_missing);
  findings.insert(findings.begin() + place, std::move(all));
}

/// Of one body's own look, as mistakes.cpp and the candidates name it.
bool is_of_a_body(const Finding& finding) {
  for (const char* start : {"glass-", "mirror-", "object-"})
    if (finding.kind.starts_with(start)) return true;
  return false;
}

void add_wrong_spheres(const SceneKnowledge& knowledge, std::vector<Finding>& findings) {
  std::size_t spheres = 0, wrong = 0;
  double explained = 0;
  for (const Landmark& mark : knowledge.landmarks) {
    if (!mark.name.ends_with("sphere")) continue;
    ++spheres;
    const auto found = std::find_if(findings.begin(), findings.end(), [&](const Finding& finding) {
      return is_of_a_body(finding) && !says_missing(finding) &&
             finding.sentence.find("the " + mark.name + " ") != std::string::npos;
    });
    if (found == findings.end()) continue;
    ++wrong;
    explained += found->explained;
  }
  if (spheres < 2 || wrong < spheres) return;
  Finding all{"spheres-wrong", "what the spheres show is wrong, in each of them",
              "something that they share: their normals, which must have length 1, or how rays meet them",
              findings.front().where, explained};
  findings.insert(findings.begin(), std::move(all));
}

}  // namespace

void join_common_causes(const SceneKnowledge& knowledge, std::vector<Finding>& findings) {
  add_wrong_spheres(knowledge, findings);
  join_missing(findings);
}

}  // namespace photonproof::inline harness_diagnosis
