#include "reports/verify/verify_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenes/base/percent_text.h"

namespace photonproof::inline reports_verify {
namespace {

std::string number(const std::optional<double>& value, const char* format) {
  return value ? fmt::format(fmt::runtime(format), *value) : "–";
}

}  // namespace

double VerifyPair::shown_shift() const {
  if (whole_shift) return *whole_shift;
  double worst = 0;
  for (const double by : shift)
    if (std::abs(by) > std::abs(worst)) worst = by;
  return worst;
}

const VerifyPair* pair_between(const VerifyScene& scene, const std::string& a, const std::string& b) {
  for (const VerifyPair& pair : scene.pairs)
    if ((pair.first == a && pair.second == b) || (pair.first == b && pair.second == a)) return &pair;
  return nullptr;
}

std::optional<double> largest_detectable(const VerifyRecord& record) {
  std::optional<double> worst;
  for (const VerifyScene& scene : record.scenes)
    for (const VerifyPair& pair : scene.pairs)
      if (pair.verdict == "agree" && pair.would_see) worst = std::max(worst.value_or(0), *pair.would_see);
  return worst;
}

std::string error_words(const std::optional<double>& error) {
  if (!error) return "–";
  return std::isfinite(*error) ? percent_text(*error) : "all";
}

int exit_code_of(const VerifyRecord& record) {
  if (record.interrupted) return 130;
  const auto any = [&](std::initializer_list<const char*> verdicts) {
    return std::ranges::any_of(record.scenes, [&](const VerifyScene& scene) {
      return std::ranges::find(verdicts, scene.verdict) != verdicts.end();
    });
  };
  const auto is_missing = [](const VerifyPicture& picture) { return picture.status == "not_started"; };
  if (std::ranges::any_of(record.scenes,
                          [&](const VerifyScene& scene) { return std::ranges::any_of(scene.pictures, is_missing); }))
    return 2;
  const bool wrong_probe =
      std::ranges::any_of(record.probes, [](const VerifyProbe& probe) { return probe.verdict == "wrong"; });
  if (wrong_probe || any({"differ", "stale reference", "cannot tell which", "failed"})) return 1;
  return any({"inconclusive"}) ? 3 : 0;
}

std::string verify_table(const VerifyRecord& record) {
  std::string text;
  for (const VerifyProbe& probe : record.probes)
    if (probe.verdict == "wrong") text += "probe: " + probe.sentence + "\n";
  for (const VerifyScene& scene : record.scenes) {
    text += fmt::format("{}: {}: {}\n", scene.name, scene.verdict, scene.sentence);
    for (const VerifyPair& pair : scene.pairs)
      text += fmt::format("  {:14} {:16} {:9} {:>+9.2g} % would see {:>8} relmse {:>8} ssim {:>7}{}\n", pair.first,
                          pair.second, pair.verdict, 100 * pair.shown_shift(), error_words(pair.would_see),
                          number(pair.relmse, "{:.2g}"), number(pair.ssim, "{:.4f}"),
                          pair.sentence.empty() ? "" : "  " + pair.sentence);
    for (const VerifyPicture& picture : scene.pictures)
      for (const std::string& loss : picture.losses) text += fmt::format("  {:14} warning: {}\n", picture.engine, loss);
    for (const VerifyPicture& picture : scene.pictures)
      if (picture.status != "ok")
        text += fmt::format("  {:14} {}: {}\n", picture.engine, picture.status, picture.detail);
    for (const std::string& note : scene.notes) text += "  note: " + note + "\n";
  }
  return text;
}

}  // namespace photonproof::inline reports_verify
