#include <nanobind/stl/string.h>

#include <string>

#include "harness/python/bindings.h"
#include "reports/record/results.h"

namespace nb = nanobind;

namespace photonproof::inline harness_python {

void bind_records(nb::module_& module) {
  using namespace nb::literals;
  module.def(
      "check_record",
      [](const std::string& path) {
        const nb::gil_scoped_release released;
        static_cast<void>(read_results(path));
      },
      "path"_a, "Raises InputError where the file is no whole record.");
}

}  // namespace photonproof::inline harness_python
