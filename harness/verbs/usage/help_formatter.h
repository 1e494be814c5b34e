// The layout of every --help: options in two columns that fit 100, with what an option takes after its text.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace photonproof::inline harness_verbs_usage {

class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter();
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
  std::string make_footer(const CLI::App* app) const override;
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_subcommand(const CLI::App* subcommand) const override;
};

}  // namespace photonproof::inline harness_verbs_usage
