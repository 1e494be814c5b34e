// Words of tables and plots for a paper: titles in place of names, and the clock of times.
#pragma once

#include <string>
#include <vector>

#include "reports/view/view.h"

namespace photonproof::inline reports_paper {

/// The record's title, or without one the name in words: "cornell-spheres" as "Cornell spheres".
std::string scene_title(const SceneRecord& scene);
/// The same of a scene by its name, also where the view has no such scene.
std::string scene_title(const reports::View& view, const std::string& name);

/// A title for each engine of the view: "photonproof path tracer" becomes "Path tracer". Two engines of one title have
/// their names instead.
std::vector<std::string> method_titles(const reports::View& view);

/// The title of the engine with this name. The name, if the view has no such engine.
std::string method_title(const reports::View& view, const std::string& name);

/// Throws InputError listing the scenes of the record if it has no scene of this name.
const reports::SceneView& scene_of(const reports::View& view, const std::string& name);

}  // namespace photonproof::inline reports_paper
