// photonproof completions: prints a completion script for a shell.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>
#include <memory>
#include <string>

#include "harness/verbs/usage/completion_script.h"
#include "harness/verbs/usage/name_hints.h"
#include "harness/verbs/usage/verb_usage.h"
#include "harness/verbs/verbs.h"

namespace photonproof::inline harness_verbs_start {

void add_completions_verb(CLI::App& program, int& exit_code) {
  CLI::App* verb = add_verb(program, {.name = "completions",
                                      .group = maintain_group,
                                      .purpose = "Print a script that completes verbs and options in bash, zsh or fish",
                                      .examples = {"photonproof completions bash"},
                                      .exit_codes = {done, bad_input, internal_error}});
  auto shell = std::make_shared<std::string>();
  begin_option_group(*verb, input_group);
  verb->add_option("shell", *shell, "bash, zsh or fish")->required()->check(one_of({"bash", "zsh", "fish"}));
  verb->callback([shell, &program, &exit_code] {
    static const std::map<std::string, Shell> shells{{"bash", Shell::bash}, {"zsh", Shell::zsh}, {"fish", Shell::fish}};
    std::printf("%s", completion_script(program, shells.at(*shell)).c_str());
    exit_code = 0;
  });
}

}  // namespace photonproof::inline harness_verbs_start
