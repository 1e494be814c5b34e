// Pieces of a grading as the values that its pages' templates name (reports/templates/grade_*.mustache). Every string
// of the record goes through printable() here; the templates escape it.
#pragma once

#include <functional>
#include <kainjow/mustache.hpp>
#include <string>
#include <vector>

#include "reports/grades/grade_record.h"

namespace photonproof::reports::inline reports_grades {

/// {class, symbol, verdict} for verdict_chip.mustache.
kainjow::mustache::data chip_data(const SceneGrade& grade);

/// Where a picture of the record is for the page: an address, or why there is none.
struct PagePicture {
  std::string address, problem;
  int width = 0, height = 0;
  std::string link;  ///< where a click leads; empty: nowhere
};
using PictureSource = std::function<PagePicture(const std::string& relative)>;

/// What grade_scene.mustache needs: verdict, findings, pictures with marks, checks, runs with what they printed.
/// Precondition: whoever reads the page may see all of the scene.
kainjow::mustache::data scene_block(const GradedScene& scene, const SceneGrade& grade, const PictureSource& picture,
                                    const std::string& id, const std::string& title);

/// A list of {metric, value, bound, side}: no sentence and no parameter, so that it may be told of hidden scenes, too.
kainjow::mustache::data checks_data(const std::vector<GradedCheck>& checks);

/// What grade_speed.mustache needs.
kainjow::mustache::data speed_block(const Grades& grades, const SubmissionGrade& submission);

/// What grade_build.mustache needs is set.
void set_build(kainjow::mustache::data& object, const SubmissionGrade& submission);

/// Style, script and the partial templates that both pages share.
void set_page_parts(kainjow::mustache::data& page);

}  // namespace photonproof::reports::inline reports_grades
