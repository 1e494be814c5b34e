// photonproof view IMAGE...: a page with a viewer of any images, and opens it where there is a screen.
// Exit codes are the program's: 0 done, 2 bad input or usage.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "harness/metrics/metrics.h"
#include "harness/verbs/engine_output.h"
#include "harness/verbs/usage/name_hints.h"
#include "harness/verbs/usage/verb_usage.h"
#include "harness/verbs/verbs.h"
#include "reports/page/viewer_page.h"
#include "scenes/base/input_error.h"
#include "scenes/base/process.h"
#include "scenes/base/size_text.h"
#include "scenes/base/text_numbers.h"
#include "scenes/description/output_files.h"

namespace photonproof::inline harness_verbs {
namespace {

namespace fs = std::filesystem;

struct ViewOptions {
  std::vector<std::string> images;
  std::string reference;
  std::string output = "view.html";
  double exposure = 0;
  bool no_open = false;
};

ViewedImage viewed(const std::string& file) {
  ViewedImage made{fs::path(file).filename().string(), "", read_image(file)};
  if (made.image.width > largest_viewed || made.image.height > largest_viewed)
    throw InputError(file, "is " + size_text(made.image.width, made.image.height) + ", expected at most " +
                               std::to_string(largest_viewed) + " pixels a side");
  made.caption = size_text(made.image.width, made.image.height);
  return made;
}

/// "bias -0.3 %, relMSE 0.0012", or the reason why there is none.
std::string error_text(const Image& reference, const Image& test) {
  if (const auto defects = find_defects(reference, test); !defects.empty()) return defects.front().sentence;
  std::string text;
  for (const MetricValue& metric : compute_metrics(reference, test, {.only = {"relmse", "bias"}})) {
    char words[64];
    if (metric.name == "relmse")
      std::snprintf(words, sizeof words, "relMSE %.3g", metric.value);
    else
      std::snprintf(words, sizeof words, "bias %+.2g %%", 100 * metric.value);
    text += (text.empty() ? "" : ", ") + std::string(words);
  }
  return text;
}

/// The reference comes first. Files of the same name in several folders have their whole paths as titles.
ViewerPage page_of(const ViewOptions& options) {
  ViewerPage page;
  page.exposure = options.exposure;
  std::vector<std::string> files = options.images;
  if (!options.reference.empty()) {
    files.insert(files.begin(), options.reference);
    page.reference = 0;
  }
  for (const std::string& file : files) {
    ViewedImage image = viewed(file);
    if (!page.images.empty()) {
      const ViewedImage& first = page.images.front();
      if (image.image.width != first.image.width || image.image.height != first.image.height)
        throw InputError(file, "is " + size_text(image.image.width, image.image.height) + ", but " + files.front() +
                                   " is " + size_text(first.image.width, first.image.height) +
                                   ": images of one view have one size");
      if (page.reference) image.caption = error_text(first.image, image.image);
    }
    page.images.push_back(std::move(image));
  }
  for (std::size_t i = 0; i < files.size(); ++i)
    for (std::size_t k = 0; k < files.size(); ++k)
      if (i != k && fs::path(files[i]).filename() == fs::path(files[k]).filename()) page.images[i].title = files[i];
  for (const ViewedImage& image : page.images) page.title += (page.title.empty() ? "" : ", ") + image.title;
  return page;
}

bool has_screen() { return std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr; }

void run_view(const ViewOptions& options) {
  check_extension(options.output, ".html", "a page");
  std::vector<InputFile> inputs;
  for (const std::string& file : options.images) inputs.push_back({file, "an image to view"});
  if (!options.reference.empty()) inputs.push_back({options.reference, "the reference"});
  prepare_outputs({options.output}, inputs);
  write_viewer_page(page_of(options), options.output);
  std::printf("%s\n", options.output.c_str());
  std::fflush(stdout);
  if (options.no_open || !has_screen()) return;
  constexpr double patience_seconds = 10;
  if (!run_process({"xdg-open", options.output}, {.wall_limit_seconds = patience_seconds}).ok())
    std::fprintf(stderr, "xdg-open did not open it\n");
}

}  // namespace

void add_view_verb(CLI::App& program, int& exit_code) {
  CLI::App* verb =
      add_verb(program, {.name = "view",
                         .group = measure_group,
                         .purpose = "Make a page with a viewer of images, side by side and linked",
                         .examples = {"photonproof view before.exr after.exr",
                                      "photonproof view path.exr maps.exr --reference reference.exr -o maps.html"},
                         .exit_codes = {done, bad_input, internal_error}});
  const auto options = std::make_shared<ViewOptions>();
  begin_option_group(*verb, input_group);
  verb->add_option("images", options->images, "images of one size, of any format that compare reads")->required();
  verb->add_option("--reference", options->reference, "image that errors are measured from; it comes first");
  begin_option_group(*verb, output_group);
  verb->add_option("-o,--output", options->output, "page to write")->capture_default_str();
  verb->add_option("--exposure", options->exposure, "stops to begin with")
      ->check(CLI::Range(-64.0, 64.0))
      ->check(is_finite_number)
      ->type_name("STOPS")
      ->capture_default_str();
  verb->add_flag("--no-open", options->no_open, "only write the page; else xdg-open shows it where there is a screen");
  verb->callback([options, &exit_code] {
    run_view(*options);
    exit_code = 0;
  });
}

}  // namespace photonproof::inline harness_verbs
