#include "renderer/api/render_identity.h"

#include <string>

#include "renderer/core/version.h"
#include "renderer/passes/aov.h"
#include "scenes/base/size_text.h"
#include "scenes/description/scene_hash.h"

namespace photonproof::inline renderer_api {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text.empty() ? "none" : text;
}

}  // namespace

const char* sampler_name(SamplerKind sampler) { return sampler == SamplerKind::sobol ? "sobol" : "independent"; }

RenderIdentity render_identity(const SceneDescription& description, const RenderRequest& request,
                               const RenderPlan& plan, const Tile& window) {
  const FilmDescription& film = description.sensor.film;
  return {{"program", version_line()},
          {"scene's content", scene_hash(description)},
          {"image", size_text(film.width, film.height) + ", of which " + size_text(window.width(), window.height()) +
                        " from " + std::to_string(window.x0) + "," + std::to_string(window.y0)},
          {"integrator", plan.integrator},
          {"preset", request.preset.empty() ? "none" : request.preset},
          {"view", aov_row(plan.view).name},
          {"seed", std::to_string(request.seed)},
          {"sampler", sampler_name(request.sampler)},
          {"grid", std::to_string(request.grid)},
          {"instruction set", plan.isa},
          {"list of --no-skip", joined(request.no_skip)}};
}

}  // namespace photonproof::inline renderer_api
