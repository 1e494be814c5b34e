#include "harness/stress/faults/work_inputs.h"

#include "harness/stress/stress_scene.h"
#include "scenes/files/atomic_file.h"
#include "scenes/xml/writer.h"

namespace photonproof::inline harness_stress_faults {
namespace {

namespace fs = std::filesystem;

// Two cells an engine: from three on, bench would add a warm-up render.
constexpr const char* bench_suite = R"toml(name = "bench"
title = "Faults"

[[scene]]
name = "stage"
path = "scene/scene.xml"
width = 16
height = 16
exposure = 0
reference = {engine = "path", budget = "spp=64", seed = 1000}

[[run]]
engines = ["photonmapper", "bdpt", "ptracer"]
budgets = ["spp=4"]
seeds = [1, 2]
)toml";

constexpr const char* gate_suite = R"toml(name = "gates"
title = "Faults"
seeds = 4
looks = 2

[[scene]]
name = "stage"
path = "scene/scene.xml"
width = 16
height = 16
exposure = 0

[[gate]]
scene = "stage"
engine = "path"
budget = "spp=16"
metric = "agreement"
bound = 0.5

[[gate]]
scene = "stage"
engine = "photonmapper"
budget = "spp=16"
metric = "bias"
bound = 0.5
)toml";

// Both submissions are equally right, so that nothing has to be diagnosed.
constexpr const char* course = R"toml(name = "course"
title = "Faults"
[build]
command = ["sh", "-c", "test -x render"]
[run]
command = ["./render", "{name}", "{seed}", "{output}"]
seeds = true
[image]
format = "ppm"
transfer = "linear"
[limits]
seconds = 20
[baseline]
submission = "handout"
[correctness]
metrics = {flip = 0.3}
blocks = {relative = 0.3, alpha = 0.001}
[points]
correctness = 100
[[scene]]
name = "a"
width = 16
height = 16
[[hidden]]
name = "b"
width = 16
height = 16
)toml";

constexpr const char* submission = R"sh(
awk -v scene="$1" -v seed="$2" 'BEGIN { srand(seed); print "P3 16 16 255"
for (y = 0; y < 16; ++y) for (x = 0; x < 16; ++x) for (c = 0; c < 3; ++c)
  printf "%d\n", (scene == "a" ? 60 + 8 * x : 60 + 8 * y) + 10 * c + 12 * rand() }' >"$3"
)sh";

void write_submission(const fs::path& folder, const std::string& comment) {
  fs::create_directories(folder);
  write_file_atomically(folder / "render", "#!/bin/sh\n# " + comment + submission);
  fs::permissions(folder / "render", fs::perms::owner_all);
}

}  // namespace

void write_work_inputs(const fs::path& inputs) {
  fs::create_directories(inputs / "scene");
  write_file_atomically(inputs / "scene" / "scene.xml", write_scene(lit_stress_scene()));
  write_file_atomically(inputs / "bench.toml", bench_suite);
  write_file_atomically(inputs / "gates.toml", gate_suite);
  write_file_atomically(inputs / "course.toml", course);
  write_submission(inputs / "handout", "the baseline");
  write_submission(inputs / "pupil", "somebody's, of other bytes");
}

}  // namespace photonproof::inline harness_stress_faults
