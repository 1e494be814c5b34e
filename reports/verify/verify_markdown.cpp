// Tables of a record of many scenes: one row per scene for people, one row per pair for programs.

#include <fmt/format.h>

#include <algorithm>

#include "reports/verify/verify_overview.h"

namespace photonproof::inline reports_verify {

std::string verify_markdown(const VerifyRecord& record) {
  const VerifyOverview overview = verify_overview(record);
  std::string text = fmt::format("{:.0f} s on {}, {}. {}\n\n{}\n", record.seconds, record.host, record.program,
                                 overview.totals, verify_overview_words);
  text +=
      "`seen`: the least error of the mean that every agreeing pair would have shown; `s`: seconds of all engines, "
      "pairs and passes.\n\n| scene | verdict |";
  for (const OverviewColumn& column : overview.columns) text += " " + column.name + " |";
  text += " seen | s |\n|---|---|";
  for (std::size_t i = 0; i < overview.columns.size() + 2; ++i) text += "--:|";
  text += "\n";
  std::string others, losses;
  for (const OverviewRow& row : overview.rows) {
    const VerifyScene& scene = *row.scene;
    text += fmt::format("| `{}` | {} |", scene.name, scene.verdict);
    for (const OverviewCell& cell : row.cells) text += " " + cell.words + " |";
    text += fmt::format(" {} | {:.0f} |\n", row.seen, scene.seconds);
    for (const VerifyPicture& picture : scene.pictures)
      for (const std::string& loss : picture.losses)
        losses += fmt::format("- `{}`, {}: {}\n", scene.name, picture.engine, loss);
    if (scene.verdict != "agree") others += fmt::format("- `{}`: {}: {}\n", scene.name, scene.verdict, scene.sentence);
  }
  if (!losses.empty()) text += "\nWarnings of engines about their own images:\n\n" + losses;
  return others.empty() ? text : text + "\nNot all agree:\n\n" + others;
}

std::string verify_csv(const VerifyRecord& record) {
  std::string text = "scene,first,second,verdict,bias,would_see,relmse,ssim,seconds_first,seconds_second\n";
  const auto number = [](const std::optional<double>& value) { return value ? fmt::format("{:.4g}", *value) : ""; };
  for (const VerifyScene& scene : record.scenes)
    for (const VerifyPair& pair : scene.pairs) {
      const auto seconds = [&](const std::string& name) {
        const auto picture = std::ranges::find(scene.pictures, name, &VerifyPicture::engine);
        return picture != scene.pictures.end() ? fmt::format("{:.2f}", picture->seconds) : "";
      };
      text += fmt::format("{},{},{},{},{:.4g},{},{},{},{},{}\n", scene.name, pair.first, pair.second, pair.verdict,
                          pair.shown_shift(), number(pair.would_see), number(pair.relmse), number(pair.ssim),
                          seconds(pair.first), seconds(pair.second));
    }
  return text;
}

}  // namespace photonproof::inline reports_verify
