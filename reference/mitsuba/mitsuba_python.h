// The Python interpreter that has Mitsuba.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace photonproof::inline reference_mitsuba {

/// Names the interpreter, in place of the search.
inline constexpr const char* mitsuba_python_variable = "PHOTONPROOF_MITSUBA_PYTHON";

/// The interpreter that the environment variable names. Without it, build/peers/bin/python of the tree that `program`
/// was built in. Without that, a python3 on PATH that can import Mitsuba. Empty where there is none.
std::optional<std::string> find_mitsuba_python(const std::filesystem::path& program);

/// "Mitsuba 3.9.1": what the interpreter has; empty where it has none.
std::string mitsuba_version(const std::string& python);

/// The message where no interpreter is found.
inline constexpr const char* no_mitsuba =
    "Mitsuba is not installed: './run --with-mitsuba' does it, or PHOTONPROOF_MITSUBA_PYTHON names a Python that has "
    "it";

}  // namespace photonproof::inline reference_mitsuba
