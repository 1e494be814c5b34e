#include <nanobind/stl/string.h>

#include <exception>

#include "harness/python/bindings.h"
#include "scenes/base/input_error.h"

namespace nb = nanobind;

namespace photonproof::inline harness_python {
namespace {

void raise(const InputError& error) {
  const nb::object type = nb::module_::import_("photonproof._errors").attr("InputError");
  const nb::object raised = type(error.what(), error.place(), error.line(), error.column(), error.message());
  PyErr_SetObject(type.ptr(), raised.ptr());
}

}  // namespace

void bind_errors(nb::module_& /*module*/) {
  nb::register_exception_translator([](const std::exception_ptr& pending, void* /*payload*/) {
    try {
      std::rethrow_exception(pending);
    } catch (const InputError& error) {
      raise(error);
    }
  });
}

}  // namespace photonproof::inline harness_python
