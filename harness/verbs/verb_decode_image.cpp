// photonproof decode-image FILE PIXELS: not for users, hence not in --help. `grade` starts it in a sandbox for every
// image that a submission wrote (harness/submissions/image_decoder.h).

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "harness/submissions/image_decoder.h"
#include "harness/verbs/verbs.h"

namespace photonproof::inline harness_verbs {

void add_decode_image_verb(CLI::App& program, int&) {
  struct Options {
    std::string file, pixels, format;
    int width = 0, height = 0;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand("decode-image", "decode an untrusted image to plain floats")->group("");
  verb->add_option("file", options->file)->required();
  verb->add_option("pixels", options->pixels)->required();
  verb->add_option("--format", options->format)
      ->required()
      ->check(CLI::IsMember(std::vector<std::string>(submitted_format_names.begin(), submitted_format_names.end())));
  constexpr int greatest_side = 1 << 15;
  verb->add_option("--width", options->width)->required()->check(CLI::Range(1, greatest_side));
  verb->add_option("--height", options->height)->required()->check(CLI::Range(1, greatest_side));
  verb->callback([options] {
    decode_image(options->file, *submitted_format(options->format), options->width, options->height, options->pixels);
  });
}

}  // namespace photonproof::inline harness_verbs
