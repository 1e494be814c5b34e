// Parts of a grading as values for its pages' templates (reports/templates/grade_*.mustache). Every string of the
// record goes through printable() here; the templates escape it.
#pragma once

#include <functional>
#include <kainjow/mustache.hpp>
#include <string>
#include <vector>

#include "reports/grades/grade_record.h"

namespace photonproof::reports::inline reports_grades {

/// {class, symbol, verdict} for verdict_chip.mustache.
kainjow::mustache::data chip_data(const SceneGrade& grade);

/// A picture of the record for the page: an address, or the reason why there is none.
struct PagePicture {
  std::string address, problem;
  int width = 0, height = 0;
  std::string link;  ///< where a click leads; empty: no link
};
using PictureSource = std::function<PagePicture(const std::string& relative)>;

/// The values of grade_scene.mustache: verdict, findings, pictures with marks, checks, and runs with their output.
/// Precondition: the page's reader may see all of the scene.
kainjow::mustache::data scene_block(const GradedScene& scene, const SceneGrade& grade, const PictureSource& picture,
                                    const std::string& id, const std::string& title);

/// The scene's first `most` pictures with marks: submitted, reference and FLIP map.
/// Precondition: the page's reader may see all of the scene.
kainjow::mustache::data shots_data(const GradedScene& scene, const SceneGrade& grade, const PictureSource& picture,
                                   const std::string& title, std::size_t most);

/// A list of {metric, value, bound, side}. It has no sentences and no parameters, so it is safe for hidden scenes.
kainjow::mustache::data checks_data(const std::vector<GradedCheck>& checks);

/// The values of grade_speed.mustache.
kainjow::mustache::data speed_block(const Grades& grades, const SubmissionGrade& submission);

/// Sets the values of grade_build.mustache.
void set_build(kainjow::mustache::data& object, const SubmissionGrade& submission);

/// Sets style, script and the partial templates that both pages share.
void set_page_parts(kainjow::mustache::data& page);

}  // namespace photonproof::reports::inline reports_grades
