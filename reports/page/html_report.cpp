#include "reports/page/html_report.h"

#include <algorithm>

#include "reports/page/html_conclusions.h"
#include "reports/page/html_data.h"
#include "reports/page/html_scene.h"
#include "reports/page/html_strip.h"
#include "reports/page/page_parts.h"
#include "reports/page/templates.h"
#include "reports/view/environment.h"
#include "reports/view/metric_columns.h"
#include "reports/view/text.h"
#include "reports/view/titles.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline reports_page {
using namespace reports;

namespace {

using kainjow::mustache::data;

void set_header(data& page, const Results& results, const View& view) {
  page.set("suite", printable(heading(results)));
  page.set("totals", totals_text(results));
  page.set("machine", printable(machine_text(results.host)));
  page.set("created", printable(time_text(results.created)));
  page.set("host", printable(host_text(results.host)));
  page.set("versions", printable(versions_text(results.versions)));
  page.set("command", printable(results.command));
  data findings(data::type::list);
  for (const std::string& finding : results.findings) findings.push_back(printable(finding));
  page.set("findings", findings);
  data caveats(data::type::list);
  for (const std::string& caveat : results.caveats) caveats.push_back(printable(caveat));
  page.set("caveats", caveats);
  page.set("verdicts_total", text_or_false(verdicts_text(view.gates)));
  const std::string failing = failing_text(view);
  page.set("failing", text_or_false(printable(failing)));
  const std::string change = failing.empty() ? "" : view.gates.front()->regression_only;
  page.set("regression", text_or_false(printable(change)));
  page.set("has_compared", !view.compared.empty());
  data engines(data::type::list);
  for (std::size_t i = 0; i < view.engines.size(); ++i) engines.push_back(engine_data(view, i));
  page.set("engines", engines);
  data compared(data::type::list);
  for (const std::size_t engine : view.compared) compared.push_back(engine_data(view, engine));
  page.set("compared", compared);
}

void set_failures(data& page, const View& view) {
  data failures(data::type::list);
  for (const Failure& failure : view.failures) {
    data item;
    set_cell(item, failure.cells.front()->cell);
    set_status(item, *failure.cells.front());
    item.set("cells", printable(failed_cells_text(failure)));
    failures.push_back(item);
  }
  page.set("has_failures", !view.failures.empty());
  page.set("failures", failures);
}

void set_columns(data& page, const View& view) {
  data columns(data::type::list);
  std::vector<MetricParameters> others = view.parameters;
  for (const MetricColumn& column : metric_columns()) {
    data item;
    item.set("title", column.title);
    item.set("meaning", column.meaning);
    const auto own = std::ranges::find(others, column.metric, &MetricParameters::metric);
    item.set("fixed_parameters", own == others.end() ? data(false) : data(printable(own->parameters)));
    if (own != others.end()) others.erase(own);
    columns.push_back(item);
  }
  page.set("columns", columns);
  page.set("has_other_parameters", !others.empty());
  page.set("other_parameters", parameters_data(merged(others)));
}

void set_templates(data& page) {
  set_style_and_script(page, std::string(templates::style), templates::script, templates::script_sha256);
  set_scene_partials(page);
  set_partial(page, "thumbnail_img", templates::thumbnail_img);
  set_partial(page, "scene_section", templates::scene_section);
  set_partial(page, "race_table", templates::race_table);
}

void write_page(const Results& record, const std::filesystem::path& results_folder, const std::filesystem::path& out,
                const data& live) {
  const Results results = titled(record);
  const View view = arrange(results);
  data page, scenes(data::type::list);
  set_header(page, results, view);
  set_glance(page, view);
  set_races(page, view);
  set_strip(page, view, results_folder);
  set_failures(page, view);
  set_columns(page, view);
  set_gates(page, view.gates, false);
  set_tiles(page, view);
  set_changes(page, view);
  set_templates(page);
  for (std::size_t i = 0; i < view.scenes.size(); ++i) {
    scenes.push_back(scene_data(view, view.scenes[i], results_folder, "scene-" + std::to_string(i + 1)));
  }
  page.set("has_scenes", !view.scenes.empty());
  page.set("scenes", scenes);
  page.set("live", live);
  write_file_atomically(out, rendered_page(templates::page, page));
}

}  // namespace

void write_html_report(const Results& results, const std::filesystem::path& results_folder,
                       const std::filesystem::path& out) {
  write_page(results, results_folder, out, data(false));
}

void write_live_html_report(const Results& results, const std::filesystem::path& results_folder,
                            const std::filesystem::path& out) {
  constexpr int seconds_between_loads = 3;
  write_page(results, results_folder, out, data(std::to_string(seconds_between_loads)));
}

}  // namespace photonproof::inline reports_page
