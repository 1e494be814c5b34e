// The parts of Python's module `photonproof._native`. The package photonproof/ wraps them: it converts arrays, has the
// documentation and the types.
#pragma once

#include <nanobind/nanobind.h>

namespace photonproof::inline harness_python {

// Types of what functions return, for the stub that nanobind makes.
using Values = nanobind::typed<nanobind::dict, nanobind::str, nanobind::any>;
using Rows = nanobind::typed<nanobind::list, nanobind::any>;
using Parts = nanobind::typed<nanobind::tuple, nanobind::any, nanobind::ellipsis>;

/// Turns InputError into photonproof.InputError, with its place.
void bind_errors(nanobind::module_& module);
/// Scene, and its render.
void bind_scene(nanobind::module_& module);
/// Reads and writes image files.
void bind_images(nanobind::module_& module);
/// The table of metrics, and measurements of a pair of arrays.
void bind_metrics(nanobind::module_& module);
/// Agreement of two images with variances, and gates on several images.
void bind_verdicts(nanobind::module_& module);
/// Checks records.
void bind_records(nanobind::module_& module);

}  // namespace photonproof::inline harness_python
