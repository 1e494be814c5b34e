#include "reports/verify/verify_overview.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace photonproof::inline reports_verify {
namespace {

const VerifyPicture* drawn_by(const VerifyScene& scene, const std::string& engine) {
  const auto found = std::ranges::find(scene.pictures, engine, &VerifyPicture::engine);
  return found != scene.pictures.end() ? &*found : nullptr;
}

/// The base of comparisons: the first believed engine without a declared error, else the first with a picture.
std::string base_of(const VerifyScene& scene) {
  for (const std::string& name : scene.believed) {
    const VerifyPicture* picture = drawn_by(scene, name);
    if (picture != nullptr && picture->declared_whole == 0) return name;
  }
  for (const VerifyPicture& picture : scene.pictures)
    if (picture.status == "ok") return picture.engine;
  return {};
}

OverviewCell cell_of(const VerifyScene& scene, const std::string& base, const std::string& name) {
  if (name == base) return {"base", "good"};
  const VerifyPair* pair = pair_between(scene, base, name);
  if (pair == nullptr) {
    const VerifyPicture* picture = drawn_by(scene, name);
    const bool refused = picture == nullptr || picture->status == "unsupported";
    return {refused ? "–" : picture->status, refused ? "" : "bad"};
  }
  const double shift = pair->first == base ? pair->shown_shift() : -pair->shown_shift() / (1 + pair->shown_shift());
  const bool differs = pair->verdict == "differ", agrees = pair->verdict == "agree";
  return {fmt::format("{:+.2f} %{}{}", std::round(1e4 * shift) / 100 + 0.0,  // + 0.0: never "-0.00"
                      pair->ssim ? fmt::format(" {:.3f}", *pair->ssim) : "",
                      differs  ? " ✗"
                      : agrees ? ""
                               : " ?"),
          differs  ? "bad"
          : agrees ? "good"
                   : "open"};
}

/// The largest minimum detectable error among pairs of the believed engines.
std::string power_words(const VerifyScene& scene) {
  double worst = 0;
  bool known = false;
  for (const VerifyPair& pair : scene.pairs) {
    const auto believed = [&](const std::string& name) {
      return std::ranges::find(scene.believed, name) != scene.believed.end();
    };
    if (pair.verdict != "agree" || !pair.would_see || !believed(pair.first) || !believed(pair.second)) continue;
    worst = std::max(worst, *pair.would_see);
    known = true;
  }
  return known ? error_words(worst) : "–";
}

/// Whether an engine of this program agrees with one that shares no code with it: another program, or a closed form.
bool has_other_witness(const VerifyRecord& record, const VerifyScene& scene) {
  const auto is_ours = [&](const std::string& name) {
    return std::ranges::any_of(record.engines, [&](const VerifyEngineRecord& engine) {
      return engine.name == name && engine.version == record.program;
    });
  };
  const auto is_other = [&](const std::string& name) { return name != stored_reference_side && !is_ours(name); };
  return std::ranges::any_of(scene.pairs, [&](const VerifyPair& pair) {
    return pair.verdict == "agree" &&
           ((is_ours(pair.first) && is_other(pair.second)) || (is_ours(pair.second) && is_other(pair.first)));
  });
}

std::string totals_of(const VerifyRecord& record) {
  std::map<std::string, int> verdicts;
  int witnessed = 0, pairs = 0, agreeing = 0;
  for (const VerifyScene& scene : record.scenes) {
    ++verdicts[scene.verdict];
    witnessed += has_other_witness(record, scene) ? 1 : 0;
    pairs += static_cast<int>(scene.pairs.size());
    agreeing += static_cast<int>(std::ranges::count(scene.pairs, "agree", &VerifyPair::verdict));
  }
  std::string words;
  for (const auto& [verdict, scenes] : verdicts)
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", scenes, verdict);
  const auto scenes = record.scenes.size();
  return fmt::format(
      "{} scene{}: {}. {} of {} pairs agree. {} ha{} an independent reference: another renderer, or a closed form.",
      scenes, scenes == 1 ? "" : "s", words, agreeing, pairs, witnessed, witnessed == 1 ? "s" : "ve");
}

}  // namespace

VerifyOverview verify_overview(const VerifyRecord& record) {
  VerifyOverview overview;
  for (const VerifyEngineRecord& engine : record.engines)
    if (engine.problem.empty()) overview.columns.push_back({engine.name, engine.title});
  for (const char* side : {closed_form_side, stored_reference_side}) overview.columns.push_back({side, ""});
  for (const VerifyScene& scene : record.scenes) {
    OverviewRow row{&scene, {}, power_words(scene)};
    const std::string base = base_of(scene);
    for (const OverviewColumn& column : overview.columns) row.cells.push_back(cell_of(scene, base, column.name));
    overview.rows.push_back(std::move(row));
  }
  overview.totals = totals_of(record);
  return overview;
}

}  // namespace photonproof::inline reports_verify
