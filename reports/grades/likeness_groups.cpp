#include "reports/grades/likeness_groups.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace photonproof::reports::inline reports_grades {
namespace {

using Members = std::vector<std::size_t>;  // indices into Grades::submissions, ascending

std::vector<std::string> names_of(const Grades& grades, const Members& members) {
  std::vector<std::string> names;
  for (const std::size_t member : members) names.push_back(grades.submissions[member].name);
  return names;
}

/// The submissions that made each image of a scene, by the image's checksum.
std::map<std::string, std::set<std::size_t>> makers_of(const Grades& grades, const std::string& scene_name) {
  std::map<std::string, std::set<std::size_t>> makers;
  for (std::size_t i = 0; i < grades.submissions.size(); ++i) {
    const SceneGrade* grade = grades.submissions[i].scene(scene_name);
    if (grade == nullptr) continue;
    for (const GradedRun& run : grade->runs)
      if (!run.checksum.empty()) makers[run.checksum].insert(i);
  }
  return makers;
}

void add_equal_images(const Grades& grades, std::vector<LikenessGroup>& groups) {
  std::map<Members, std::vector<std::string>> scenes_of;
  for (const GradedScene& scene : grades.scenes) {
    std::set<Members> together;
    for (const auto& [checksum, makers] : makers_of(grades, scene.name))
      if (makers.size() > 1) together.insert(Members(makers.begin(), makers.end()));
    for (const Members& members : together) scenes_of[members].push_back(scene.name);
  }
  for (const auto& [members, scenes] : scenes_of) {
    std::string list;
    for (const std::string& scene : scenes) list += (list.empty() ? "" : ", ") + scene;
    groups.push_back({names_of(grades, members),
                      "the same image, bit for bit, of scene" + std::string(scenes.size() == 1 ? " " : "s ") + list});
  }
}

/// Submissions joined by flags, each found by the first of its group.
void add_shared_noise(const Grades& grades, std::vector<LikenessGroup>& groups) {
  Members first(grades.submissions.size());
  std::iota(first.begin(), first.end(), std::size_t{0});
  const auto index_of = [&](const std::string& name) {
    const auto found = std::ranges::find(grades.submissions, name, &SubmissionGrade::name);
    return static_cast<std::size_t>(found - grades.submissions.begin());
  };
  for (std::size_t i = 0; i < grades.submissions.size(); ++i)
    for (const GradeFlag& flag : grades.submissions[i].flags) {
      const std::size_t other = flag.kind == "same-as-other" ? index_of(flag.other) : grades.submissions.size();
      if (other == grades.submissions.size()) continue;
      const auto [low, high] = std::minmax(first[i], first[other]);
      std::ranges::replace(first, std::size_t{high}, std::size_t{low});
    }
  std::map<std::size_t, Members> joined;
  for (std::size_t i = 0; i < first.size(); ++i) joined[first[i]].push_back(i);
  for (const auto& [leader, members] : joined)
    if (members.size() > 1) groups.push_back({names_of(grades, members), "images with the same noise"});
}

}  // namespace

std::vector<LikenessGroup> likeness_groups(const Grades& grades) {
  std::vector<LikenessGroup> groups;
  add_equal_images(grades, groups);
  add_shared_noise(grades, groups);
  return groups;
}

}  // namespace photonproof::reports::inline reports_grades
