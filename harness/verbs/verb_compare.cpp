// photonproof compare REF TEST: every metric of a pair of images, bounds on them, heat maps.
// Exit codes are those of OpenImageIO's idiff:
//   0  ok
//   1  a --warn bound is broken
//   2  a --fail bound is broken, images disagree, a value is not finite, or wrong usage
//   3  sizes differ
//   4  a file cannot be read or written

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "harness/metrics/heatmap.h"
#include "harness/metrics/metric_bounds.h"
#include "harness/pixels/data_windows.h"
#include "harness/statistics/agreement.h"
#include "harness/verbs/usage/verb_usage.h"
#include "harness/verbs/verbs.h"
#include "scenes/base/input_error.h"
#include "scenes/base/text_numbers.h"
#include "scenes/base/utf8.h"
#include "scenes/description/output_files.h"

namespace photonproof::inline harness_verbs {
namespace {

constexpr const char* kNoVariance =
    "the image has no channels variance.R, variance.G, variance.B, which agreement needs";

enum class Verdict { ok, warn, fail, size_mismatch, file_error };  // in the order of the exit codes

const char* name_of(Verdict verdict) {
  constexpr const char* names[] = {"ok", "warn", "fail", "size_mismatch", "file_error"};
  return names[static_cast<int>(verdict)];
}

struct CompareOptions {
  std::string reference, test;
  std::string layer;  // of files that hold several; empty: as choose_colour does
  MetricOptions metrics;
  std::vector<std::string> warn, fail;  // "metric=bound"
  std::string heatmap_folder;           // empty: none
  std::string mask;                     // a file; empty: none
  std::vector<int> region;              // x, y, width, height; empty: all
  bool agreement = false, shared_noise = false;
  bool json = false;
};

/// A reason for a verdict other than ok.
struct Finding {
  Verdict verdict;
  std::string sentence;
};

struct Comparison {
  int width = 0, height = 0;                                 // of the reference; 0 when it could not be read
  std::vector<std::string> reference_remarks, test_remarks;  // how they were read, where not as plain linear RGB
  std::optional<PixelRegion> region;
  std::string note;  // what the numbers count that the files do not store; empty: nothing
  std::vector<Measurement> measurements;
  std::optional<Agreement> agreement;
  std::vector<Finding> findings;
  HeatmapFiles heatmaps;  // empty paths when there are none

  Verdict verdict() const {
    Verdict worst = Verdict::ok;
    for (const Finding& finding : findings) worst = std::max(worst, finding.verdict);
    return worst;
  }
};

std::vector<MetricBound> parse_bounds(const std::string& option, const std::vector<std::string>& texts) {
  std::vector<MetricBound> bounds;
  bounds.reserve(texts.size());
  for (const std::string& text : texts) bounds.push_back(parse_bound(option, text));
  return bounds;
}

void check_bounds(const std::vector<MetricBound>& bounds, Verdict verdict, Comparison& comparison) {
  for (const MetricBound& bound : bounds)
    if (auto reason = broken_bound(bound, comparison.measurements))
      comparison.findings.push_back({verdict, std::move(*reason)});
}

/// Throws InputError, naming the file, when one has no variance.
void check_agreement(const CompareOptions& options, const Rendering& reference, const Rendering& test,
                     Comparison& comparison) {
  if (!reference.variance) throw InputError(options.reference, kNoVariance);
  if (!test.variance) throw InputError(options.test, kNoVariance);
  constexpr double alpha = 0.01;
  comparison.agreement = test_agreement(reference, test, alpha, options.shared_noise);
  if (comparison.agreement->inconclusive)
    comparison.findings.push_back({Verdict::warn,
                                   "agreement is inconclusive: pixels share noise, and the images do not state "
                                   "their means' standard errors; only single pixels were judged"});
  for (const StatisticalVerdict* part :
       {&comparison.agreement->pixels, &comparison.agreement->blocks, &comparison.agreement->whole})
    if (!part->pass) comparison.findings.push_back({Verdict::fail, part->sentence});
}

/// The mask of a file: pixels where any channel is not 0. Throws InputError when there are none.
std::shared_ptr<const PixelMask> read_mask(const std::string& path, const std::optional<PixelRegion>& region) {
  FileSource file(path);
  std::optional<RegionSource> part;
  if (region) part.emplace(file, *region);
  RowSource& rows = region ? static_cast<RowSource&>(*part) : file;
  auto mask = std::make_shared<PixelMask>(rows.width(), rows.height());
  std::vector<float> rgb(3 * static_cast<std::size_t>(rows.width()));
  for (int y = 0; y < rows.height(); ++y) {
    rows.read(y, y + 1, rgb.data());
    for (int x = 0; x < rows.width(); ++x) {
      const float* pixel = &rgb[3 * static_cast<std::size_t>(x)];
      if (pixel[0] != 0 || pixel[1] != 0 || pixel[2] != 0) mask->set(x, y);
    }
  }
  if (mask->counted() == 0) throw InputError(path, "mask chooses no pixel: all of them are 0");
  return mask;
}

/// Throws InputError when a heat map would replace what it is made of.
void check_heatmaps(const CompareOptions& options, const std::string& stem) {
  const HeatmapFiles maps = heatmap_files(options.heatmap_folder, stem);
  for (const std::filesystem::path& map : {maps.flip, maps.error})
    for (const std::string& read : {options.reference, options.test, options.mask})
      if (!read.empty() && same_file(map, read))
        throw InputError(map.string(), "is an image that is read, which it would replace");
}

/// Both images; says how they are read. Throws InputError when a layer is asked for and neither has any.
std::array<std::unique_ptr<RowSource>, 2> open_pair(const CompareOptions& options, ImageWindow part,
                                                    Comparison& comparison) {
  auto reference = std::make_unique<FileSource>(options.reference, options.layer, part),
       test = std::make_unique<FileSource>(options.test, options.layer, part);
  comparison.reference_remarks = reference->file().remarks();
  comparison.test_remarks = test->file().remarks();
  if (!options.layer.empty() && reference->file().layer().empty() && test->file().layer().empty())
    throw InputError("--layer", "both images are plain R, G, B and have no layers");
  return {std::move(reference), std::move(test)};
}

/// Throws InputError when a file cannot be read or written.
void compare_files(const CompareOptions& options, const std::vector<MetricBound>& warn,
                   const std::vector<MetricBound>& fail, Comparison& comparison) {
  MetricOptions metrics = options.metrics;
  ComparedPart compared;
  if (!metrics.region) compared = compared_part(options.reference, options.test, options.layer);
  if (compared.region) metrics.region = compared.region;
  comparison.region = metrics.region;
  comparison.note = compared.note;
  std::optional<Rendering> reference_rendering, test_rendering;  // in memory only where that is needed
  auto [reference, test] = open_pair(options, compared.part, comparison);
  if (options.agreement) {
    const ImageWindow part = compared.region ? ImageWindow::stored : compared.part;
    metrics.region.reset();
    reference = std::make_unique<ImageRowSource>(
        reference_rendering.emplace(read_rendering(options.reference, options.layer, part)).mean);
    test = std::make_unique<ImageRowSource>(
        test_rendering.emplace(read_rendering(options.test, options.layer, part)).mean);
  }
  if (!options.mask.empty()) {
    metrics.mask = read_mask(options.mask, metrics.region);
    metrics.mask_name = options.mask;
  }
  const bool same_size = reference->width() == test->width() && reference->height() == test->height();
  std::optional<HeatmapWriter> maps;
  const std::string stem = std::filesystem::path(options.test).stem().string();
  if (!options.heatmap_folder.empty()) check_heatmaps(options, stem);
  if (!options.heatmap_folder.empty() && same_size)
    maps.emplace(metrics.region ? metrics.region->width : reference->width(),
                 metrics.region ? metrics.region->height : reference->height(), options.heatmap_folder, stem);
  PairMeasurements measured = measure_pair(*reference, *test, metrics, maps ? &*maps : nullptr);
  comparison.width = measured.width;
  comparison.height = measured.height;
  for (const ImageDefect& defect : measured.defects)
    comparison.findings.push_back(
        {defect.kind == ImageDefect::Kind::size_mismatch ? Verdict::size_mismatch : Verdict::fail, defect.sentence});
  if (!comparison.findings.empty()) return;

  comparison.measurements = std::move(measured.measurements);
  check_bounds(warn, Verdict::warn, comparison);
  check_bounds(fail, Verdict::fail, comparison);
  if (options.agreement) check_agreement(options, *reference_rendering, *test_rendering, comparison);
  if (maps) comparison.heatmaps = maps->finish();
}

void print_remarks(const char* whose, const std::vector<std::string>& remarks) {
  for (const std::string& remark : remarks) std::printf("%s read as: %s\n", whose, printable(remark).c_str());
}

const char* word_for(const Agreement& agreement) {
  if (agreement.inconclusive) return "inconclusive";
  if (!agreement.pass()) return "fail";
  return agreement.shared_noise ? "pass by pixels and the whole image" : "pass";
}

void print_comparison(const CompareOptions& options, const Comparison& comparison) {
  if (comparison.width > 0)
    std::printf("reference %s, test %s, %d x %d pixels\n", options.reference.c_str(), options.test.c_str(),
                comparison.width, comparison.height);
  print_remarks("reference", comparison.reference_remarks);
  print_remarks("test", comparison.test_remarks);
  if (!comparison.note.empty()) std::printf("note: %s\n", comparison.note.c_str());
  for (const Measurement& measured : comparison.measurements) {
    std::array<char, 32> value{'-'};
    if (measured.value) std::snprintf(value.data(), value.size(), "%.8g", *measured.value);
    std::string notes = measured.parameters;
    if (!measured.value) notes += std::string(notes.empty() ? "" : "; ") + "undefined: " + measured.row->undefined_when;
    std::printf("%-24s%-16s%s\n", measured.row->name, value.data(), notes.c_str());
  }
  if (comparison.agreement)
    std::printf("agreement: %s; %s\n  %s\n  %s\n  %s\n", word_for(*comparison.agreement),
                comparison.agreement->power_sentence().c_str(), comparison.agreement->pixels.sentence.c_str(),
                comparison.agreement->blocks.sentence.c_str(), comparison.agreement->whole.sentence.c_str());
  if (!comparison.heatmaps.flip.empty())
    std::printf("%s: %s\n%s: %s\n", comparison.heatmaps.flip.c_str(), flip_scale_caption,
                comparison.heatmaps.error.c_str(), error_scale_caption);
  for (const Finding& finding : comparison.findings)
    if (finding.verdict != Verdict::file_error)  // those are on standard error
      std::printf("%s: %s\n", name_of(finding.verdict), finding.sentence.c_str());
  std::printf("verdict: %s\n", name_of(comparison.verdict()));
}

nlohmann::ordered_json as_json(const StatisticalVerdict& verdict) {
  return {{"pass", verdict.pass}, {"observed", verdict.observed}, {"bound", verdict.bound},
          {"n", verdict.n},       {"alpha", verdict.alpha},       {"sentence", verdict.sentence}};
}

void print_comparison_json(const CompareOptions& options, const Comparison& comparison) {
  using json = nlohmann::ordered_json;
  json metrics = json::array();
  for (const Measurement& measured : comparison.measurements) {
    json entry = {{"name", measured.row->name}, {"value", nullptr}, {"parameters", measured.parameters}};
    if (!measured.value)
      entry["undefined"] = measured.row->undefined_when;
    else if (std::isinf(*measured.value))
      entry["undefined"] = "infinite: the images are equal once encoded";
    else
      entry["value"] = *measured.value;
    metrics.push_back(std::move(entry));
  }
  json findings = json::array();
  for (const Finding& finding : comparison.findings)
    findings.push_back({{"verdict", name_of(finding.verdict)}, {"sentence", finding.sentence}});
  json record = {{"schema_version", 1},
                 {"reference", options.reference},
                 {"test", options.test},
                 {"width", comparison.width},
                 {"height", comparison.height},
                 {"reference_read_as", comparison.reference_remarks},
                 {"test_read_as", comparison.test_remarks},
                 {"exposure", options.metrics.parameters.exposure},
                 {"region", nullptr},
                 {"note", nullptr},
                 {"mask", nullptr},
                 {"verdict", name_of(comparison.verdict())},
                 {"findings", std::move(findings)},
                 {"metrics", std::move(metrics)}};
  if (!comparison.note.empty()) record["note"] = comparison.note;
  if (const auto& region = comparison.region) record["region"] = {region->x, region->y, region->width, region->height};
  if (!options.mask.empty()) record["mask"] = options.mask;
  if (comparison.agreement) {
    record["agreement"] = {{"pass", comparison.agreement->pass() && !comparison.agreement->inconclusive},
                           {"inconclusive", comparison.agreement->inconclusive},
                           {"shared_noise", comparison.agreement->shared_noise},
                           {"would_see", nullptr},
                           {"power", Agreement::power},
                           {"pixels", as_json(comparison.agreement->pixels)},
                           {"blocks", as_json(comparison.agreement->blocks)},
                           {"whole", as_json(comparison.agreement->whole)}};
    if (const auto& would_see = comparison.agreement->would_see; would_see && std::isfinite(*would_see))
      record["agreement"]["would_see"] = *would_see;
  }
  if (!comparison.heatmaps.flip.empty())
    record["heatmaps"] = {{"flip", comparison.heatmaps.flip.string()}, {"error", comparison.heatmaps.error.string()}};
  std::printf("%s\n", record.dump(2, ' ', false, json::error_handler_t::replace).c_str());
}

/// The exit code. Throws InputError on a bound that cannot be read.
int run_compare(CompareOptions options) {
  const std::vector<MetricBound> warn = parse_bounds("--warn", options.warn);
  const std::vector<MetricBound> fail = parse_bounds("--fail", options.fail);
  if (const auto& part = options.region; !part.empty())
    options.metrics.region = PixelRegion{part[0], part[1], part[2], part[3]};
  for (const std::string& name : options.metrics.only) metric_named("--metrics", name);
  for (const auto* bounds : {&warn, &fail})
    for (const MetricBound& bound : *bounds) options.metrics.also.emplace_back(bound.metric->name);
  Comparison comparison;
  try {
    compare_files(options, warn, fail, comparison);
  } catch (const InputError& error) {
    comparison.findings.push_back({Verdict::file_error, error.summary()});
    std::fprintf(stderr, "%s\n", error.summary().c_str());
  }
  options.json ? print_comparison_json(options, comparison) : print_comparison(options, comparison);
  return static_cast<int>(comparison.verdict());
}

/// An option's name: "--hdr-flip" of hdr_flip.
std::string option_of(std::string name) {
  std::ranges::replace(name, '_', '-');
  return "--" + name;
}

/// Sets the parameter, or says what is wrong with the texts.
std::optional<std::string> set_from(const std::vector<std::string>& texts, const MetricParameter& parameter,
                                    ParameterValues& values) {
  std::vector<double> numbers;
  for (const std::string& text : texts) {
    const Parsed<double> number = parse_number(text);
    if (!number.value)  // of three the last is a count
      return (numbers.size() == 2 ? "the count " : "") + number.problem;
    numbers.push_back(*number.value);
  }
  return set_parameter(parameter, numbers, values);
}

/// CLI11 checks a single number, as for other options. Several that are wrong together are an InputError.
void add_parameter_options(CLI::App& verb, ParameterValues& values) {
  for (const MetricParameter& parameter : metric_parameters) {
    const std::string name = option_of(parameter.name), range = range_text(parameter);
    const auto set = [&values, &parameter, name](const std::vector<std::string>& texts) {
      if (const auto problem = set_from(texts, parameter, values)) throw InputError(name, *problem);
    };
    const std::string help = parameter.meaning + (range.empty() ? "" : ", " + range);
    CLI::Option* option = verb.add_option_function<std::vector<std::string>>(name, set, help);
    option->type_name(parameter.argument)->expected(static_cast<int>(number_count(parameter)));
    if (parameter.without) option->default_str(parameter.without);
    if (number_count(parameter) > 1) continue;
    option->default_str(value_text(parameter, values))->check([&parameter](const std::string& text) {
      ParameterValues tried;
      return set_from({text}, parameter, tried).value_or("");
    });
  }
}

void add_agreement_options(CLI::App& verb, CompareOptions& options, CLI::Option* mask) {
  begin_option_group(verb, "Agreement of two noisy images");
  CLI::Option* agreement =
      verb.add_flag("--agreement", options.agreement,
                    "fail unless both are noisy images of one mean; needs variance and --sampler independent");
  agreement->excludes(mask)->excludes("--region");
  verb.add_flag("--shared-noise", options.shared_noise,
                "pixels of an image vary together, as with shared photons: judge no blocks of pixels")
      ->needs(agreement);
}

/// Returns --mask, which other options exclude.
CLI::Option* add_image_options(CLI::App& verb, CompareOptions& options) {
  begin_option_group(verb, input_group);
  verb.add_option("REF", options.reference, "reference image: linear EXR, or sRGB of 8 or 16 bits")->required();
  verb.add_option("TEST", options.test, "test image of the same size")->required();
  verb.add_option("--layer", options.layer, "layer, part or channel of EXR files to read (default: R, G, B)")
      ->type_name("NAME");
  verb.add_option("--region", options.region, "compare only this part, as if both images were cropped to it")
      ->expected(4)
      ->type_name("X Y WIDTH HEIGHT");
  CLI::Option* mask = verb.add_option("--mask", options.mask, "count only pixels where this image is not 0");
  return mask->type_name("FILE");
}

void add_metric_options(CLI::App& verb, CompareOptions& options) {
  begin_option_group(verb, "Metrics");
  verb.add_option("--metrics", options.metrics.only, "compute only these metrics and those with a bound")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NAME,...");
  for (const MetricRow& row : metric_rows())
    if (row.on_request)
      verb.add_flag_callback(
          option_of(row.name), [&options, &row] { options.metrics.also.emplace_back(row.name); },
          std::string("compute ") + row.name + ", too; a bound on it does so as well");
  add_parameter_options(verb, options.metrics.parameters);
  begin_option_group(verb, "Bounds");
  verb.add_option("--warn", options.warn, "exit with 1 when broken, a minimum for psnr and ssim; may be repeated")
      ->type_name("METRIC=BOUND")
      ->take_all()
      ->allow_extra_args(false);
  verb.add_option("--fail", options.fail, "exit with 2 when broken; may be repeated")
      ->type_name("METRIC=BOUND")
      ->take_all()
      ->allow_extra_args(false);
}

void add_compare_outputs(CLI::App& verb, CompareOptions& options) {
  begin_option_group(verb, output_group);
  verb.add_option("--heatmaps", options.heatmap_folder, "folder for TEST-flip.png and TEST-error.png")
      ->type_name("FOLDER");
  verb.add_flag("--json", options.json, "print one JSON object instead of lines");
  begin_option_group(verb, run_group);
  verb.add_option("--threads", options.metrics.threads, "worker threads (0: every core); the numbers are the same")
      ->check(CLI::Range(0, 1024))
      ->type_name("N");
}

}  // namespace

void add_compare_verb(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<CompareOptions>();
  std::string names;
  for (const MetricRow& row : metric_rows()) names += (names.empty() ? "" : ", ") + std::string(row.name);
  CLI::App* verb = add_verb(
      program,
      {.name = "compare",
       .group = measure_group,
       .purpose = "Measure how far a test image is from its reference, and hold it to bounds",
       .examples = {"photonproof compare reference.exr test.exr --heatmaps out",
                    "photonproof compare reference.exr test.exr --fail relmse=0.01 --warn flip=0.05",
                    "photonproof compare reference.exr test.exr --agreement"},
       .exit_codes = {{0, "no bound is broken"},
                      {1, "a --warn bound is broken, or --agreement is inconclusive"},
                      {2, "a --fail bound is broken, the images disagree, a value is not finite, or bad usage"},
                      {3, "the images' sizes differ"},
                      {4, "a file cannot be read or written"}},
       .notes = "Metrics: " + names + ".\nWithout bounds no metric fails: compare only prints the numbers."});
  CLI::Option* mask = add_image_options(*verb, *options);
  add_metric_options(*verb, *options);
  add_agreement_options(*verb, *options, mask);
  add_compare_outputs(*verb, *options);
  verb->callback([options, &exit_code] { exit_code = run_compare(*options); });
}

}  // namespace photonproof::inline harness_verbs
