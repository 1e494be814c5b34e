// Parts of a record as values for the page templates (reports/templates/*.mustache). Every string of the record goes
// through printable() here; the templates escape it.
#pragma once

#include <kainjow/mustache.hpp>
#include <string>
#include <vector>

#include "reports/page/picture.h"
#include "reports/view/view.h"

namespace photonproof::reports::inline reports_page {

/// {color, shape, name, title, version}: an engine, with the values of swatch_svg.mustache.
kainjow::mustache::data engine_data(const View& view, std::size_t engine);

/// A list of {metric, parameters}.
kainjow::mustache::data parameters_data(const std::vector<MetricParameters>& parameters);

/// Sets {status, class, detail}: the end of a cell.
void set_status(kainjow::mustache::data& object, const Result& result);

/// Sets {scene, engine, budget, seed}.
void set_cell(kainjow::mustache::data& object, const Cell& cell);

/// Sets the values of picture_img.mustache.
void set_picture(kainjow::mustache::data& object, const EmbeddedPicture& picture, const std::string& alt);

/// A metric of the cell as its column shows it, or the dash.
std::string metric_text(const Result& result, const std::string& name);

/// Three significant digits, or the dash.
std::string seconds_text(const std::optional<double>& seconds);

/// The text, or false when it is empty, so that a template's section is left out.
kainjow::mustache::data text_or_false(const std::string& text);

}  // namespace photonproof::reports::inline reports_page
