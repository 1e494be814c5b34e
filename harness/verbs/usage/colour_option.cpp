#include "harness/verbs/usage/colour_option.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <string_view>

#include "harness/verbs/usage/name_hints.h"

namespace photonproof::inline harness_verbs_usage {
namespace {

std::string_view variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

}  // namespace

void add_colour_option(CLI::App& verb, std::string& colour) {
  verb.add_option("--color", colour, "colours: auto, always or never; NO_COLOR turns auto off")
      ->check(one_of({"auto", "always", "never"}))
      ->capture_default_str();
}

bool colours_on(const std::string& colour, int descriptor) {
  if (colour != "auto") return colour == "always";
  return isatty(descriptor) != 0 && variable("NO_COLOR").empty() && variable("TERM") != "dumb";
}

}  // namespace photonproof::inline harness_verbs_usage
