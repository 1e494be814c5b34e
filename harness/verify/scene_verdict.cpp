#include "harness/verify/scene_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <numeric>
#include <utility>

#include "harness/gates/independence.h"
#include "harness/verify/fault_location.h"
#include "harness/verify/odd_one_out.h"
#include "harness/verify/picture_pair.h"
#include "harness/verify/probes.h"
#include "harness/verify/stale_reference.h"
#include "reference/store/half_rounding.h"
#include "reference/store/reference_store.h"
#include "scenes/base/input_error.h"
#include "scenes/base/timer.h"

namespace photonproof::inline harness_verify {
namespace {

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 < names.size() ? ", " : " and ") + names[i];
  return text;
}

std::string to_word(PairVerdict verdict) {
  return verdict == PairVerdict::agree ? "agree" : verdict == PairVerdict::differ ? "differ" : "undecided";
}

/// A side of pairs: an engine with its pictures, the closed form, or the stored reference.
struct Side {
  Witness witness;
  const VerifyEngine* engine = nullptr;
  std::map<int, EnginePicture> pictures{};  ///< by series; one without noise has only the first
  std::optional<RgbD> closed_form{};
  bool is_set_aside = false;  ///< gives no information about the scene: in no pair
};

class SceneJudge {
 public:
  SceneJudge(const EngineRenderer& renderer, const RenderedScene& scene, const SceneDescription& description,
             const std::vector<VerifyProbe>& probes)
      : renderer_(renderer), scene_(scene), description_(description), probes_(probes) {
    out_.name = scene.name;
    out_.path = scene.file.string();
    out_.width = scene.crop ? scene.crop->width : scene.width;
    out_.height = scene.crop ? scene.crop->height : scene.height;
    out_.exposure = scene.expect ? scene.expect->exposure : 0;
  }

  VerifyScene judge(const std::vector<VerifyEngine>& engines) {
    const Timer timer;
    for (const VerifyEngine& engine : engines) add_engine(engine);
    if (scene_.expect && scene_.expect->analytic && scene_.expect->analytic->mean)
      sides_.push_back({{closed_form_side, closed_form_side, true}, nullptr, {}, scene_.expect->analytic->mean});
    add_stored_reference();
    compare_all();
    set_aside_who_cannot_find_light();
    decide();
    out_.seconds = timer.seconds();
    return std::move(out_);
  }

 private:
  void add_engine(const VerifyEngine& engine) {
    const EngineRender render = renderer_.render(scene_, engine);
    VerifyPicture picture;
    picture.engine = engine.row.name;
    picture.status = to_string(render.status);
    picture.detail = render.detail;
    picture.command = render.command;
    if (render.picture) {
      const EnginePicture& drawn = *render.picture;
      picture.seconds = drawn.seconds;
      picture.samples = drawn.samples;
      picture.declared_whole = drawn.declared.whole;
      picture.declared_block = drawn.declared.block;
      picture.declared_reason = drawn.declared.reason;
      picture.losses = drawn.losses;
      for (std::size_t i = 0; i < drawn.rendering.mean.rgb.size(); ++i)
        picture.mean[i % 3] += double{drawn.rendering.mean.rgb[i]} / double(drawn.rendering.mean.pixels());
      picture.picture = "pictures/" + scene_.name + "-" + engine.row.name + ".png";
      write_png((renderer_.options().folder / picture.picture).string(), drawn.rendering.mean, out_.exposure);
      sides_.push_back({{engine.row.name, engine.sampling, false}, &engine, {{0, drawn}}, {}});
    }
    out_.pictures.push_back(std::move(picture));
  }

  /// The stored reference is one more picture, with the sampling of its estimator.
  void add_stored_reference() {
    if (!std::filesystem::exists(committed_reference_path(scene_.file, scene_.width, scene_.height))) return;
    try {
      const StoredReference stored = load_reference(scene_.file, scene_.width, scene_.height);
      EnginePicture picture;
      picture.engine = stored_reference_side;
      picture.rendering = stored.rendering;
      widen_to_half_rounding(picture.rendering);
      if (stored.provenance.bias > 0)
        picture.declared = {stored.provenance.bias, 2 * stored.provenance.bias, "as its provenance states"};
      sides_.push_back(
          {{stored_reference_side, sampling_of(stored.provenance.estimator), false}, nullptr, {{0, picture}}, {}});
    } catch (const InputError& error) {
      out_.notes.push_back("stale reference: " + error.summary());
      stale_ = true;
    }
  }

  /// Empty if the side has no picture.
  const EnginePicture* picture_of(Side& side, int series) {
    if (side.pictures.empty()) return nullptr;
    if (series > 0 && side.engine != nullptr && side.engine->counts_samples() && !side.pictures.contains(series)) {
      EngineRender render = renderer_.render(scene_, *side.engine, series);
      if (render.picture) side.pictures.emplace(series, std::move(*render.picture));
    }
    const auto found = side.pictures.find(series);
    return found != side.pictures.end() ? &found->second : &side.pictures.at(0);
  }

  PairTest test(Side& a, Side& b, int series) {
    if (a.closed_form || b.closed_form) {
      Side& engine = a.closed_form ? b : a;
      return test_against_closed_form(a.closed_form ? *a.closed_form : *b.closed_form, *picture_of(engine, series));
    }
    return test_pair(*picture_of(a, series), *picture_of(b, series));
  }

  static double declared_by(const Side& side) { return side.pictures.empty() ? 0 : side.pictures.at(0).declared.whole; }

  void compare(std::size_t i, std::size_t j) {
    PairTest result = test(sides_[i], sides_[j], 0);
    // A difference must repeat with new samples, or it may be chance. An outlier is proof enough by itself.
    if (result.differs && !result.has_outlier) result = test(sides_[i], sides_[j], 1);
    const double asked = accepted_power * renderer_.options().power + declared_by(sides_[i]) + declared_by(sides_[j]);
    // An engine with a larger declared error is not used as an independent reference.
    constexpr double most_declared = 0.25;
    const bool says_little = std::max(declared_by(sides_[i]), declared_by(sides_[j])) > most_declared;
    const bool is_seen = result.would_see && *result.would_see <= asked && !result.is_undecided && !says_little;
    const PairVerdict verdict = result.differs ? PairVerdict::differ
                                : is_seen      ? PairVerdict::agree
                                               : PairVerdict::undecided;
    pairs_.push_back({i, j, verdict});
    VerifyPair record{sides_[i].witness.name, sides_[j].witness.name, to_word(verdict), result.sentence, result.shift,
                      result.whole_shift,     result.would_see,       result.relmse,    result.ssim};
    if (sides_[i].closed_form || sides_[j].closed_form) record.relmse = std::nullopt;
    out_.pairs.push_back(std::move(record));
  }

  void compare_all() {
    for (std::size_t i = 0; i < sides_.size(); ++i)
      for (std::size_t j = i + 1; j < sides_.size(); ++j)
        if (!sides_[i].pictures.empty() || !sides_[j].pictures.empty()) compare(i, j);
  }

  std::vector<std::string> names_of(const std::vector<std::size_t>& sides) const {
    std::vector<std::string> names;
    for (const std::size_t side : sides) names.push_back(sides_[side].witness.name);
    return names;
  }

  /// Exact engines first, since differences from them are detected best.
  std::vector<Believed> believed_engines(const std::vector<std::size_t>& sides) const {
    std::vector<Believed> engines, others;
    for (const std::size_t side : sides) {
      const Side& s = sides_[side];
      if (s.pictures.empty()) continue;
      (s.engine != nullptr && s.pictures.at(0).declared.is_exact() ? engines : others)
          .push_back({s.engine, &s.pictures.at(0)});
    }
    engines.insert(engines.end(), others.begin(), others.end());
    return engines;
  }

  std::string sentence_with(std::size_t odd, const std::string& other) const {
    for (const VerifyPair& pair : out_.pairs)
      if ((pair.first == other && pair.second == sides_[odd].witness.name) ||
          (pair.second == other && pair.first == sides_[odd].witness.name))
        return pair.sentence;
    return "";
  }

  void add_fault(std::size_t odd, const std::vector<std::size_t>& right) {
    const Side& side = sides_[odd];
    if (side.engine == nullptr) return;
    const std::vector<Believed> believed = believed_engines(right);
    if (believed.empty()) {
      VerifyFault fault;
      fault.engine = side.witness.name;
      fault.sentence = sentence_with(odd, closed_form_side) + " against the closed form";
      fault.pass_words = "no other engine renders the scene, so that the pass is unknown";
      out_.faults.push_back(std::move(fault));
      return;
    }
    const FaultLocator locator(renderer_, scene_, description_);
    out_.faults.push_back(locator.locate({*side.engine, side.pictures.at(0)}, believed));
  }

  std::vector<std::size_t> who_differs_from(std::size_t side) const {
    std::vector<std::size_t> others;
    for (const WitnessPair& pair : pairs_)
      if (pair.verdict == PairVerdict::differ && (pair.first == side || pair.second == side))
        others.push_back(pair.first == side ? pair.second : pair.first);
    return others;
  }

  /// An engine that differs but declares that it cannot find some of the light is not wrong: it gives no information
  /// about the scene. Engines that show the light decide. Among engines that all lack some, the brighter one shows more
  /// of it. The first pass in which they differ must be caustics.
  void set_aside_who_cannot_find_light() {
    const auto blind = [&](std::size_t side) {
      const bool draws = sides_[side].engine != nullptr && !sides_[side].pictures.empty();
      const std::vector<std::string> none;
      const std::vector<std::string>& lost = draws ? sides_[side].pictures.at(0).cannot_find : none;
      return lost.empty() ? std::string() : lost.front();
    };
    const auto light = [&](std::size_t side) {
      const std::vector<float>& values = sides_[side].pictures.at(0).rendering.mean.rgb;
      return std::accumulate(values.begin(), values.end(), 0.0);
    };
    for (std::size_t side = 0; side < sides_.size(); ++side) {
      const std::string why = blind(side);
      if (why.empty()) continue;
      std::vector<std::size_t> others = who_differs_from(side);
      std::erase_if(others, [&](std::size_t other) { return !blind(other).empty() && light(other) <= light(side); });
      const std::vector<Believed> seeing = believed_engines(others);
      if (seeing.empty()) continue;
      const FaultLocator locator(renderer_, scene_, description_);
      if (locator.locate({*sides_[side].engine, sides_[side].pictures.at(0)}, seeing).pass == "caustic")
        set_aside(side, why);
    }
  }

  void set_aside(std::size_t side, const std::string& why) {
    sides_[side].is_set_aside = true;
    const std::string& name = sides_[side].witness.name;
    std::erase_if(pairs_, [&](const WitnessPair& pair) { return pair.first == side || pair.second == side; });
    std::erase_if(out_.pairs, [&](const VerifyPair& pair) { return pair.first == name || pair.second == name; });
    for (VerifyPicture& picture : out_.pictures) {
      if (picture.engine != name) continue;
      picture.status = to_string(Status::unsupported);
      picture.detail = why;
    }
  }

  void judge_reference(std::size_t reference, const std::vector<std::size_t>& right) {
    const std::vector<Believed> believed = believed_engines(right);
    if (believed.empty()) return;
    const ReferenceState state = state_of_reference(sides_[reference].pictures.at(0), *believed.front().picture);
    stale_ = true;
    out_.notes.push_back(state.sentence);
  }

  void decide() {
    std::vector<Witness> witnesses;
    for (const Side& side : sides_) witnesses.push_back(side.witness);
    OddOnes odd = odd_ones(witnesses, pairs_);
    if (odd.end == OddOnes::End::cannot_tell && !odd.odd.empty()) odd = decided_by_probes(odd);
    out_.believed = names_of(odd.believed);
    if (odd.end == OddOnes::End::odd)
      say_who_is_odd(odd);
    else if (!odd.odd.empty())
      say_that_nobody_can_tell(odd);
    else if (odd.end == OddOnes::End::agree)
      say_that_all_agree();
    else
      say_what_is_missing();
    add_what_failed();
  }

  /// Decides by a probe of the scene's contents that one engine gets wrong and no other.
  OddOnes decided_by_probes(const OddOnes& odd) {
    const std::vector<std::string> held = kinds_in(description_);
    std::vector<std::size_t> wrong;
    std::vector<std::string> notes;
    for (const std::size_t side : odd.odd) {
      const auto is_wrong = [&](const VerifyProbe& probe) {
        return probe.verdict == "wrong" && probe.engine == sides_[side].witness.name &&
               std::ranges::find(held, probe.what) != held.end();
      };
      const auto probe = std::ranges::find_if(probes_, is_wrong);
      if (probe == probes_.end()) continue;
      wrong.push_back(side);
      notes.push_back("a probe decides: " + probe->sentence);
    }
    OddOnes decided = decided_by_known_wrong(odd, wrong, pairs_);
    if (decided.end == OddOnes::End::odd) out_.notes.insert(out_.notes.end(), notes.begin(), notes.end());
    return decided;
  }

  void say_who_is_odd(const OddOnes& odd) {
    std::vector<std::size_t> engines;
    for (const std::size_t side : odd.odd) {
      if (sides_[side].witness.name == stored_reference_side)
        judge_reference(side, odd.believed);
      else
        engines.push_back(side);
    }
    if (engines.empty()) {
      out_.verdict = "stale reference";
      out_.sentence = out_.notes.empty() ? "the stored reference differs from all engines" : out_.notes.back();
      return;
    }
    for (const std::size_t side : engines) add_fault(side, odd.believed);
    out_.verdict = "differ";
    const VerifyFault& first = out_.faults.front();
    out_.sentence = listed(names_of(engines)) + (engines.size() == 1 ? " is wrong: " : " are wrong; the first: ") +
                    first.sentence + (first.place.empty() ? "" : " " + first.place) +
                    (first.pass.empty() ? "" : ", first in " + first.pass) + "; " + listed(out_.believed) +
                    (out_.believed.size() == 1 ? " decides" : " agree");
    add_doubt(odd);
  }

  /// Warns if only engines of ours are believed against another program, since ours share parts.
  void add_doubt(const OddOnes& odd) {
    if (odd.by_closed_form) return;
    const auto is_ours = [&](std::size_t side) {
      return sides_[side].engine == nullptr || sides_[side].engine->is_ours;
    };
    if (!std::ranges::all_of(odd.believed, is_ours) || std::ranges::all_of(odd.odd, is_ours)) return;
    std::string note =
        "the engines that agree share materials, lights and textures: a mistake there would look the same";
    for (const VerifyProbe& probe : probes_)
      if (probe.verdict == "wrong") note += "; probe: " + probe.sentence;
    out_.notes.push_back(note);
  }

  void say_that_nobody_can_tell(const OddOnes& odd) {
    out_.verdict = "cannot tell which";
    const std::vector<std::string> names = names_of(odd.odd);
    for (const std::size_t side : odd.odd) {
      if (out_.faults.empty()) add_fault(side, who_differs_from(side));  // the pass is the same from either side
    }
    std::string where;
    if (!out_.faults.empty()) where = ": " + out_.faults.front().engine + " is " + out_.faults.front().sentence;
    if (!out_.faults.empty() && !out_.faults.front().pass.empty()) where += ", first in " + out_.faults.front().pass;
    out_.sentence = listed(names) + " differ; which is wrong is unknown" + where;
  }

  void say_that_all_agree() {
    double worst = 0;
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      if (pairs_[p].verdict == PairVerdict::agree) worst = std::max(worst, out_.pairs[p].would_see.value_or(0));
    out_.verdict = "agree";
    out_.sentence = fmt::format("{} agree; every pair would detect an error of {:.2g} % of the mean",
                                listed(out_.believed), 100 * worst);
    std::vector<std::string> undecided;
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      if (pairs_[p].verdict == PairVerdict::undecided && sides_[pairs_[p].first].engine != nullptr)
        undecided.push_back(out_.pairs[p].first + " with " + out_.pairs[p].second);
    if (!undecided.empty())
      out_.notes.push_back("noise explains the difference, and would hide a larger error than asked for: " +
                           listed(undecided));
    if (!stale_) return;
    out_.verdict = "stale reference";
    out_.sentence = out_.notes.front() + "; " + out_.sentence;
  }

  void say_what_is_missing() {
    out_.verdict = "inconclusive";
    std::vector<std::string> drawn;
    for (const Side& side : sides_)
      if (side.engine != nullptr && !side.is_set_aside) drawn.push_back(side.witness.name);
    out_.sentence =
        drawn.empty() ? "no engine renders this scene"
        : drawn.size() == 1
            ? "only " + drawn.front() + " renders this scene: no other way to compare"
            : "noise: no pair of engines that find light in different ways would detect the error asked for";
  }

  void add_what_failed() {
    for (const VerifyPicture& picture : out_.pictures) {
      const bool failed = picture.status == "crash" || picture.status == "bad_image" || picture.status == "not_started";
      const bool late = picture.status == "timeout";
      if (!failed && !late) continue;
      const std::string sentence = picture.engine + " wrote no image: " + picture.detail;
      const bool is_worse = out_.verdict == "agree" || (failed && out_.verdict == "inconclusive");
      if (!is_worse) {
        out_.notes.push_back(sentence);
        continue;
      }
      out_.notes.push_back(out_.sentence);
      out_.verdict = failed ? "failed" : "inconclusive";
      out_.sentence = sentence;
    }
  }

  const EngineRenderer& renderer_;
  const RenderedScene& scene_;
  const SceneDescription& description_;
  const std::vector<VerifyProbe>& probes_;
  VerifyScene out_;
  std::vector<Side> sides_;
  std::vector<WitnessPair> pairs_;
  bool stale_ = false;
};

}  // namespace

VerifyScene verify_scene(const EngineRenderer& renderer, const RenderedScene& scene,
                         const SceneDescription& description, const std::vector<VerifyEngine>& engines,
                         const std::vector<VerifyProbe>& probes) {
  return SceneJudge(renderer, scene, description, probes).judge(engines);
}

}  // namespace photonproof::inline harness_verify
