// Python's module `photonproof._native`.
#include <nanobind/stl/string.h>

#include "harness/python/bindings.h"
#include "renderer/core/version.h"

NB_MODULE(_native, module) {
  module.doc() = "The C++ side of photonproof. Use the package's own functions instead.";
  module.def("version", &photonproof::version_line, "Version, and a hash of the sources that affect an image.");
  photonproof::bind_errors(module);
  photonproof::bind_scene(module);
  photonproof::bind_images(module);
  photonproof::bind_metrics(module);
  photonproof::bind_verdicts(module);
  photonproof::bind_records(module);
}
