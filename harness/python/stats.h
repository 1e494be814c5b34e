// A render's statistics for Python, with the names that `render`'s own stats file has.
#pragma once

#include <nanobind/nanobind.h>

#include <cstdint>
#include <string>

#include "renderer/api/render_scene.h"

namespace photonproof::inline harness_python {

nanobind::dict stats_of(const Rendered& rendered, std::uint64_t seed, const std::string& sampler);

}  // namespace photonproof::inline harness_python
