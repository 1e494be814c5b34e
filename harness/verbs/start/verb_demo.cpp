// photonproof demo: renders two scenes by two engines and writes their page.

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "harness/verbs/start/data_folder.h"
#include "harness/verbs/usage/verb_usage.h"
#include "harness/verbs/verbs.h"
#include "scenes/base/input_error.h"

namespace photonproof::inline harness_verbs_start {
namespace {

namespace fs = std::filesystem;

/// Continues as `photonproof bench` of the suite; returns only by an exception.
[[noreturn]] void become_bench(const std::string& output) {
  const std::string self = fs::read_symlink("/proc/self/exe").string();
  std::vector<std::string> words{"photonproof", "bench", (data_folder() / "harness/suites/demo.toml").string(), "-o",
                                 output};
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  execv(self.c_str(), argv.data());
  throw InputError(self, "cannot be started: " + std::string(std::strerror(errno)));
}

}  // namespace

void add_demo_verb(CLI::App& program, int&) {
  CLI::App* verb =
      add_verb(program, {.name = "demo",
                         .group = start_group,
                         .purpose = "Render two scenes by two engines, and write a page that compares them",
                         .examples = {"photonproof demo"},
                         .exit_codes = {done, bad_input, internal_error, interrupted_and_kept}});
  auto output = std::make_shared<std::string>("photonproof-demo");
  begin_option_group(*verb, output_group);
  verb->add_option("-o,--output", *output, "folder of images, record and page")->capture_default_str();
  verb->callback([output] { become_bench(*output); });
}

}  // namespace photonproof::inline harness_verbs_start
