// A render's plan and stats as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "harness/verbs/render/render_run.h"
#include "renderer/api/render_scene.h"

namespace photonproof::inline harness_verbs_render {

nlohmann::ordered_json plan_json(const RenderPlan& plan);

nlohmann::ordered_json stats_json(const RenderArguments& arguments, const Rendered& rendered);

}  // namespace photonproof::inline harness_verbs_render
