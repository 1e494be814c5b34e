// Drawings of a grading's times and points, as <svg> elements of its pages. Texts of the record are escaped.
#pragma once

#include <string>

#include "reports/grades/grade_record.h"

namespace photonproof::reports::inline reports_grades {

/// The meaning of a colour and marker in these plots.
enum class PlotRole { baseline, own, noise };
struct RoleStyle {
  std::string color;  ///< CSS
  const char* shape;  ///< SVG in a 12 x 12 box
};
RoleStyle role_style(PlotRole role);

/// Seconds of the baseline and of the submission in each round, on a logarithmic axis. Below them are the cores that
/// others kept busy. Empty if no round can be drawn.
std::string rounds_plot_svg(const SceneSpeed& speed, const std::string& label);

/// A speed-up with its interval on a logarithmic axis with the tiers. Empty if there is none to draw.
std::string tiers_plot_svg(const Grades& grades, const Estimate& speedup, const std::string& label);

/// The same for the whole class: one row per submission, fastest first.
std::string class_speeds_svg(const Grades& grades);

/// Histogram of the submissions' points.
std::string class_points_svg(const Grades& grades);

}  // namespace photonproof::reports::inline reports_grades
