// One scene as template values: its row of the summary, its pictures, its plot and its measurements.
#pragma once

#include <filesystem>
#include <kainjow/mustache.hpp>
#include <string>

#include "reports/view/view.h"

namespace photonproof::reports::inline reports_page {

/// Reads pictures from `folder`; `id` names the scene's anchor and prefixes ids within its plot.
kainjow::mustache::data scene_data(const View& view, const SceneView& scene, const std::filesystem::path& folder,
                                   const std::string& id);

/// Sets the templates inside scene_section.mustache.
void set_scene_partials(kainjow::mustache::data& object);

}  // namespace photonproof::reports::inline reports_page
