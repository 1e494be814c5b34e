// The rows of a scene's table of measurements as template values.
#pragma once

#include <kainjow/mustache.hpp>

#include "reports/view/view.h"

namespace photonproof::reports::inline reports_page {

/// One row per cell, the reference first, each with its remarks and details.
kainjow::mustache::data rows_data(const View& view, const SceneView& scene);

}  // namespace photonproof::reports::inline reports_page
