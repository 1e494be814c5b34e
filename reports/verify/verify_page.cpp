#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <kainjow/mustache.hpp>

#include "reports/page/page_parts.h"
#include "reports/page/picture.h"
#include "reports/page/templates.h"
#include "reports/verify/verify_overview.h"
#include "reports/verify/verify_templates.h"
#include "reports/view/view.h"
#include "scenes/base/utf8.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline reports_verify {
namespace {

using kainjow::mustache::data;
namespace fs = std::filesystem;

const char* chip_of(const std::string& verdict) {
  if (verdict == "agree" || verdict == "right") return "good";
  if (verdict == "inconclusive" || verdict == "undecided" || verdict == "not rendered") return "open";
  return "poor";
}

data picture_of(const fs::path& folder, const std::string& file, const std::string& caption) {
  data out;
  const reports::EmbeddedPicture picture =
      file.empty() ? reports::EmbeddedPicture{} : reports::embed_thumbnail(folder, file, 128);
  out.set("uri", picture.uri);
  out.set("has_picture", !picture.uri.empty());
  out.set("caption", printable(caption));
  return out;
}

data list_of(const std::vector<std::string>& texts) {
  data list(data::type::list);
  for (const std::string& text : texts) list.push_back(printable(text));
  return list;
}

data picture_card(const VerifyPicture& picture, const VerifyScene& scene, const fs::path& folder) {
  data card = picture_of(folder, picture.picture, picture.engine);
  const bool is_odd =
      std::ranges::any_of(scene.faults, [&](const auto& fault) { return fault.engine == picture.engine; });
  card.set("engine", printable(picture.engine));
  card.set("is_odd", is_odd);
  card.set("facts", fmt::format("{}{:.2g} s", picture.samples > 0 ? fmt::format("{} samples, ", picture.samples) : "",
                                picture.seconds));
  std::vector<std::string> remarks = picture.losses;
  if (picture.declared_whole > 0)
    remarks.insert(remarks.begin(),
                   fmt::format("may be off by {} ({} of a block): {}", error_words(picture.declared_whole),
                               error_words(picture.declared_block), picture.declared_reason));
  card.set("remarks", list_of(remarks));
  return card;
}

data pair_cell(const VerifyPair* pair, bool turned, bool is_self) {
  data cell;
  cell.set("self", is_self);
  cell.set("there", pair != nullptr);
  if (pair == nullptr) return cell;
  const double shift = pair->shown_shift();
  cell.set("state", pair->verdict == "differ" ? "bad" : pair->verdict == "agree" ? "good" : "open");
  cell.set("mark", pair->verdict == "differ" ? "✗" : pair->verdict == "agree" ? "✓" : "?");
  cell.set("word", pair->verdict);
  cell.set("shift", fmt::format("{:+.2g} %", 100 * (turned ? -shift / (1 + shift) : shift)));
  cell.set("seen", error_words(pair->would_see));
  cell.set("ssim", pair->ssim ? fmt::format("{:.3f}", *pair->ssim) : "");
  cell.set("has_ssim", pair->ssim.has_value());
  cell.set("sentence", printable(pair->sentence));
  return cell;
}

/// Engines against engines: the column's value relative to the row's.
void set_matrix(data& out, const VerifyScene& scene) {
  std::vector<std::string> names;
  for (const VerifyPair& pair : scene.pairs)
    for (const std::string& name : {pair.first, pair.second})
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  data rows(data::type::list);
  for (const std::string& first : names) {
    data row, cells(data::type::list);
    row.set("name", printable(first));
    for (const std::string& second : names) {
      const VerifyPair* pair = first == second ? nullptr : pair_between(scene, second, first);
      cells.push_back(pair_cell(pair, pair != nullptr && pair->second == first, first == second));
    }
    row.set("cells", cells);
    rows.push_back(row);
  }
  out.set("names", list_of(names));
  out.set("rows", rows);
  out.set("has_matrix", !names.empty());
}

data fault_data(const VerifyFault& fault, const VerifyScene& scene, const fs::path& folder) {
  data out, pictures(data::type::list);
  out.set("engine", printable(fault.engine));
  out.set("sentence", printable(fault.sentence));
  out.set("place", printable(fault.place));
  out.set("has_pass", !fault.pass.empty());
  out.set("pass", printable(fault.pass));
  out.set("pass_words", printable(fault.pass_words));
  out.set("pass_sentence", printable(fault.pass_sentence));
  const std::string right = scene.verdict == "cannot tell which" ? "the other" : "who agree";
  if (!fault.right_picture.empty()) pictures.push_back(picture_of(folder, fault.right_picture, right));
  if (!fault.odd_picture.empty()) pictures.push_back(picture_of(folder, fault.odd_picture, fault.engine));
  if (!fault.difference_picture.empty())
    pictures.push_back(picture_of(folder, fault.difference_picture, "where: orange too bright, blue too dark"));
  out.set("pictures", pictures);
  return out;
}

data scene_data(const VerifyScene& scene, const fs::path& folder) {
  data out, cards(data::type::list), missing(data::type::list), faults(data::type::list);
  out.set("id", printable(scene.name));
  out.set("name", printable(scene.shown_name()));
  out.set("purpose", printable(scene.purpose));
  out.set("verdict", scene.verdict);
  out.set("chip", chip_of(scene.verdict));
  out.set("sentence", printable(scene.sentence));
  out.set("facts", fmt::format("{}×{} pixels, {:.1f} s", scene.width, scene.height, scene.seconds));
  for (const VerifyPicture& picture : scene.pictures) {
    if (picture.status == "ok") {
      cards.push_back(picture_card(picture, scene, folder));
      continue;
    }
    data row;
    row.set("engine", printable(picture.engine));
    row.set("status", picture.status);
    row.set("is_refusal", picture.status == "unsupported");
    row.set("detail", printable(picture.detail));
    missing.push_back(row);
  }
  for (const VerifyFault& fault : scene.faults) faults.push_back(fault_data(fault, scene, folder));
  out.set("cards", cards);
  out.set("missing", missing);
  out.set("faults", faults);
  out.set("notes", list_of(scene.notes));
  set_matrix(out, scene);
  return out;
}

data probe_data(const VerifyProbe& probe) {
  data out;
  out.set("engine", printable(probe.engine));
  out.set("kind", probe.kind);
  out.set("what", printable(probe.what));
  out.set("verdict", probe.verdict);
  out.set("chip", chip_of(probe.verdict));
  out.set("gain", probe.gain ? fmt::format("{:.4f}", *probe.gain) : "–");
  out.set("error", probe.gain_error ? fmt::format("{:.1g}", *probe.gain_error) : "");
  out.set("offset", probe.offset ? fmt::format("{:+.2g} %", 100 * *probe.offset) : "–");
  out.set("sentence", printable(probe.sentence));
  return out;
}

/// The worst scenes' sentences, at most three: "furnace: mine is wrong: -17 % over the whole image".
data answers_of(const std::vector<const VerifyScene*>& sorted) {
  constexpr std::size_t most = 3;
  std::vector<std::string> answers;
  for (const VerifyScene* scene : sorted)
    if (scene->verdict != "agree") answers.push_back(scene->shown_name() + ": " + scene->sentence);
  if (answers.empty() && sorted.size() == 1) answers = {sorted.front()->shown_name() + ": " + sorted.front()->sentence};
  if (answers.empty() && !sorted.empty()) answers = {fmt::format("Yes: all {} scenes agree.", sorted.size())};
  const auto differ = [](const VerifyScene* s) { return s->verdict == "differ" || s->verdict == "cannot tell which"; };
  if (!sorted.empty() && differ(sorted.front())) answers.front().insert(0, "No. ");
  if (answers.size() > most) {
    const std::size_t more = answers.size() - (most - 1);
    answers.resize(most - 1);
    answers.push_back(fmt::format("and {} more scenes", more));
  }
  return list_of(answers);
}

/// The least error that every agreeing pair would show, beside the one asked for.
std::string detects_words(const VerifyRecord& record) {
  const std::string asked = error_words(record.power);
  const std::optional<double> worst = largest_detectable(record);
  return worst ? fmt::format("an error of {} of the mean, in every pair that agrees ({} was asked for)",
                             error_words(worst), asked)
               : fmt::format("no pair agrees (an error of {} was asked for)", asked);
}

/// The overview of all scenes, if there are several.
void set_overview(data& page, const VerifyOverview& overview) {
  data rows(data::type::list);
  for (const OverviewRow& row : overview.rows) {
    data out, cells(data::type::list);
    out.set("id", printable(row.scene->name));
    out.set("name", printable(row.scene->shown_name()));
    out.set("verdict", row.scene->verdict);
    out.set("chip", chip_of(row.scene->verdict));
    for (const OverviewCell& cell : row.cells) {
      data shown;
      shown.set("words", printable(cell.words));
      shown.set("state", cell.state);
      cells.push_back(shown);
    }
    out.set("cells", cells);
    out.set("seen", row.seen);
    out.set("seconds", fmt::format("{:.0f}", row.scene->seconds));
    rows.push_back(out);
  }
  page.set("has_overview", overview.rows.size() > 1);
  page.set("overview_words", verify_overview_words);
  data columns(data::type::list);
  for (const OverviewColumn& column : overview.columns) {
    data out;
    out.set("name", printable(column.name));
    out.set("title", column.title.empty() ? data(false) : data(printable(column.title)));
    columns.push_back(out);
  }
  page.set("columns", columns);
  page.set("overview", rows);
}

int rank_of(const VerifyScene& scene) {
  const std::string& verdict = scene.verdict;
  return verdict == "agree" ? 2 : verdict == "inconclusive" ? 1 : 0;
}

}  // namespace

void write_verify_page(const VerifyRecord& record, const fs::path& folder, const fs::path& out) {
  data page, scenes(data::type::list), engines(data::type::list), probes(data::type::list);
  reports::set_style_and_script(
      page, std::string(reports::templates::style) + std::string(reports::verify_templates::verify_style),
      reports::verify_templates::script, reports::verify_templates::script_sha256);
  std::vector<const VerifyScene*> sorted;
  for (const VerifyScene& scene : record.scenes) sorted.push_back(&scene);
  std::ranges::stable_sort(sorted, {}, [](const VerifyScene* scene) { return rank_of(*scene); });
  for (const VerifyScene* scene : sorted) scenes.push_back(scene_data(*scene, folder));
  std::string absent;
  for (const VerifyEngineRecord& engine : record.engines) {
    data row;
    row.set("name", printable(engine.title.empty() ? engine.name : engine.title));
    row.set("version", printable(engine.problem.empty() ? engine.version : engine.problem));
    engines.push_back(row);
    if (!engine.problem.empty()) absent += (absent.empty() ? "" : "; ") + engine.problem;
  }
  for (const VerifyProbe& probe : record.probes) probes.push_back(probe_data(probe));
  const VerifyOverview overview = verify_overview(record);
  set_overview(page, overview);
  page.set("totals", (record.interrupted ? "Interrupted. " : "") + overview.totals);
  page.set("fails", exit_code_of(record) == 1);
  page.set("created", printable(reports::time_text(record.created)));
  page.set("seconds", fmt::format("{:.0f}", record.seconds));
  page.set("host", printable(record.host));
  page.set("program", printable(record.program));
  page.set("command", printable(record.command));
  page.set("answers", answers_of(sorted));
  page.set("detects", detects_words(record));
  page.set("absent", absent.empty() ? data(false) : data(printable(absent)));
  page.set("engines", engines);
  page.set("has_probes", !record.probes.empty());
  page.set("probes", probes);
  page.set("scenes", scenes);
  write_file_atomically(out, reports::rendered_page(reports::verify_templates::verify, page));
}

}  // namespace photonproof::inline reports_verify
