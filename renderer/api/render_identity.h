// The identity of a render, which decides whether a checkpoint fits.
#pragma once

#include "renderer/api/render_scene.h"
#include "renderer/core/checkpoint.h"
#include "renderer/core/parallel.h"

namespace photonproof::inline renderer_api {

/// Everything that affects the bits of the image, except the budget: a checkpoint may be resumed with a larger one.
RenderIdentity render_identity(const SceneDescription& description, const RenderRequest& request,
                               const RenderPlan& plan, const Tile& window);

/// "sobol" or "independent".
const char* sampler_name(SamplerKind sampler);

}  // namespace photonproof::inline renderer_api
