// Drives the page's viewer, tables and plots by keys and pointer in a browser. The reference is 0.25 everywhere. The
// test is 0.25 on the left half and 0.5 on the right, with a NaN in the corner. Its FLIP map is 0 on the left half and
// (51 + row) / 255 on the right. The displayed value of 0.25 is round(255 (1.055 0.25^(1/2.4) - 0.055)) = 137, that of
// 0.5 is 188.

#include <cmath>
#include <limits>

#include "reports/page/html_report.h"
#include "reports/page/test_browser.h"
#include "reports/record/heatmap_magma.h"

namespace photonproof::inline reports_page {
namespace {

using namespace reports;
using nlohmann::json;

class ViewerInBrowser : public testing::Test {
 protected:
  ViewerInBrowser() : page(folder.path() / "report.html") {
    write_sample_pictures(folder.path());
    Image reference(8, 8), test(8, 8);
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) {
        for (int c = 0; c < 3; ++c) {
          reference.pixel(x, y)[c] = 0.25f;
          test.pixel(x, y)[c] = x < 4 ? 0.25f : 0.5f;
        }
      }
    }
    test.pixel(7, 7)[1] = std::numeric_limits<float>::quiet_NaN();
    write_exr((folder.path() / "ref.exr").string(), {reference, std::nullopt, {}});
    write_exr((folder.path() / "test.exr").string(), {test, std::nullopt, {}});
    PngRows flip((folder.path() / "box-flip.png").string(), 8, 8);
    std::vector<std::uint8_t> colours;
    for (int i = 0; i < 64; ++i)
      for (const int shift : {16, 8, 0})
        colours.push_back(static_cast<std::uint8_t>(magma_colours[i % 8 < 4 ? 0 : 51 + i / 8] >> shift));
    flip.add(8, colours.data());
    flip.finish();
    Results results = sample_conclusions();
    for (Result& result : results.results) {
      if (result.cell.engine == "path") result.image = "ref.exr";
      if (result.image == "box-photon.exr") result.image = "test.exr";
    }
    write_html_report(results, folder.path(), page);
  }

  /// Runs `steps`, which may use `box`, the scene's section, `viewer`, its viewer's root, `stage` and `canvases()`.
  /// `shade(canvas, x, y)` is red at a place from 0 to 1, and `button(text)` finds a button.
  json use(const std::string& steps) {
    std::vector<std::string> console;
    const json observed = drive(page, 1280, R"(
      const box = page.querySelector("[data-scene=box]");
      box.scrollIntoView();
      await until(() => box.querySelector(".viewer"));
      await drawn();
      const viewer = box.querySelector(".viewer"), stage = viewer.querySelector(".stage");
      const canvases = () => [...viewer.querySelectorAll(".pane canvas")];
      const copy = page.createElement("canvas").getContext("2d", {willReadFrequently: true});
      const color = (canvas, x, y) => {
        copy.drawImage(canvas, -Math.floor(x * canvas.width), -Math.floor(y * canvas.height));
        return [...copy.getImageData(0, 0, 1, 1).data];
      };
      const shade = (canvas, x, y) => color(canvas, x, y)[0];
      const checked = () => [...viewer.querySelectorAll("input:checked")].map((input) => input.value).join(" ");
      stage.focus();
    )" + steps,
                                &console);
    for (const std::string& line : console) ADD_FAILURE() << line;
    EXPECT_FALSE(observed.contains("thrown")) << observed;
    return observed;
  }

  TemporaryFolder folder;
  std::filesystem::path page;
};

TEST_F(ViewerInBrowser, keys_choose_the_view_and_space_flips) {
  const json seen = use(R"(
    const seen = {};
    await key(stage, "f");
    seen.flip = [checked(), canvases().length, shade(canvases()[0], 0.8, 0.3)];
    await key(stage, " ");
    seen.flipped = shade(canvases()[0], 0.8, 0.3);
    await key(stage, " ");
    seen.back = shade(canvases()[0], 0.8, 0.3);
    await key(stage, "s");
    seen.split = [checked(), shade(canvases()[0], 0.3, 0.3), shade(canvases()[0], 0.8, 0.3)];
    for (let i = 0; i < 8; ++i) await key(stage, "]");
    seen.moved = [shade(canvases()[0], 0.8, 0.3), viewer.querySelector(".divider").getAttribute("aria-valuenow")];
    await key(stage, "d");
    seen.side = [checked(), ...canvases().map((canvas) => shade(canvas, 0.8, 0.3))];
    await key(stage, "a");
    seen.all = [checked(), canvases().length];
    await key(stage, "f", {ctrlKey: true});
    seen.browsersOwn = checked();
    return seen;)");
  EXPECT_EQ(seen["flip"], (json{"flip image", 1, 188}));
  EXPECT_EQ(seen["flipped"], 137);
  EXPECT_EQ(seen["back"], 188);
  EXPECT_EQ(seen["split"], (json{"split image", 137, 188}));  // the reference left of the divider
  EXPECT_EQ(seen["moved"], (json{137, "90"}));                // the divider moved from 50 to 90 %
  EXPECT_EQ(seen["side"], (json{"side image", 137, 188}));
  EXPECT_EQ(seen["all"], (json{"all image", 2}));  // povray has no image in the sample
  EXPECT_EQ(seen["browsersOwn"], "all image");
}

TEST_F(ViewerInBrowser, exposure_and_layers_show_what_they_say) {
  const json seen = use(R"(
    const seen = {}, ev = () => viewer.querySelector(".exposure output").textContent;
    await key(stage, "d");
    await key(stage, "e"); await key(stage, "e");
    seen.brighter = [ev(), shade(canvases()[0], 0.3, 0.3)];
    await key(stage, "E", {shiftKey: true});
    seen.less = ev();
    await key(stage, "r");
    seen.reset = [ev(), shade(canvases()[0], 0.3, 0.3)];
    await key(stage, "x");
    seen.error = [checked(), shade(canvases()[1], 0.3, 0.3), shade(canvases()[1], 0.8, 0.3)];
    seen.notFinite = color(canvases()[1], 0.97, 0.97);
    await key(stage, "m");
    seen.flip = checked();
    const slider = viewer.querySelector(".exposure input");
    slider.value = -2;
    slider.dispatchEvent(new window.Event("input"));
    await drawn();
    seen.slider = ev();
    return seen;)");
  EXPECT_EQ(seen["brighter"], (json{"+1 EV", 188}));  // twice 0.25 is 0.5
  EXPECT_EQ(seen["less"], "+0.5 EV");
  EXPECT_EQ(seen["reset"], (json{"0 EV", 137}));
  // No error is the neutral grey 236; 0.25 / sqrt(0.25² + 0.01) = 0.9285 lies 0.7854 of the way from 179 to 80: 101.
  EXPECT_EQ(seen["error"], (json{"side error", 236, 101}));
  EXPECT_EQ(seen["notFinite"], (json{255, 0, 255, 255}));
  EXPECT_EQ(seen["flip"], "side flip");
  EXPECT_EQ(seen["slider"], "−2 EV");
}

TEST_F(ViewerInBrowser, zoom_and_pan_are_linked_over_the_panes) {
  const json seen = use(R"(
    const seen = {}, zoom = () => viewer.querySelector(".zoom").textContent;
    const middle = (canvas) => { const b = canvas.getBoundingClientRect(); return [b.left + b.width / 2, b.top + b.height / 2, b.width]; };
    await key(stage, "d");
    await key(stage, "+"); await key(stage, "+"); await key(stage, "+"); await key(stage, "+");
    seen.keys = [zoom(), shade(canvases()[1], 0.45, 0.3), shade(canvases()[1], 0.55, 0.3)];
    for (let i = 0; i < 4; ++i) await key(stage, "ArrowRight");
    seen.right = [shade(canvases()[1], 0.1, 0.3), shade(canvases()[0], 0.1, 0.3)];
    for (let i = 0; i < 9; ++i) await key(stage, "ArrowLeft");
    seen.left = shade(canvases()[1], 0.9, 0.3);
    let [x, y, width] = middle(canvases()[0]);
    await pointer(canvases()[0], "pointerdown", x, y);
    await pointer(canvases()[0], "pointermove", x - width, y);
    await pointer(canvases()[0], "pointermove", x - 2 * width, y);
    await pointer(canvases()[0], "pointerup", x - 2 * width, y);
    seen.dragged = shade(canvases()[1], 0.1, 0.3);
    await key(stage, "r");
    seen.reset = zoom();
    await pointer(canvases()[0], "wheel", x, y, {deltaY: -240});
    seen.wheel = zoom();
    stage.blur();
    await pointer(canvases()[0], "wheel", x, y, {deltaY: -240});
    seen.wheelElsewhere = zoom();
    [...viewer.querySelectorAll("button")].find((b) => b.textContent === "−").click();
    await drawn();
    seen.button = zoom();
    await key(stage, "s");
    [x, y, width] = middle(canvases()[0]);
    await pointer(canvases()[0], "pointerdown", x, y);
    await pointer(canvases()[0], "pointermove", x - 0.25 * width, y);
    await pointer(canvases()[0], "pointerup", x - 0.25 * width, y);
    seen.divider = viewer.querySelector(".divider").getAttribute("aria-valuenow");
    await key(viewer.querySelector(".divider"), "ArrowRight");
    seen.dividerKey = viewer.querySelector(".divider").getAttribute("aria-valuenow");
    return seen;)");
  EXPECT_EQ(seen["keys"], (json{"4×", 137, 188}));  // four times √2; the middle stays in the middle
  EXPECT_EQ(seen["right"], (json{188, 137}));       // both panes moved into the right half: the test is bright there
  EXPECT_EQ(seen["left"], 137);
  EXPECT_EQ(seen["dragged"], 188);  // the first pane was dragged to the left, the second went with it
  EXPECT_EQ(seen["reset"], "1×");
  EXPECT_EQ(seen["wheel"], "2×");
  EXPECT_EQ(seen["wheelElsewhere"], "2×");  // without the focus the page scrolls
  EXPECT_EQ(seen["button"], "1×");
  EXPECT_EQ(seen["divider"], "25");
  EXPECT_EQ(seen["dividerKey"], "27");
}

TEST_F(ViewerInBrowser, the_loupe_says_the_pixels_values) {
  const json seen = use(R"(
    const seen = {};
    const text = () => [viewer.querySelector(".where").textContent,
        ...[...viewer.querySelectorAll(".loupe-values tbody tr")].map((row) => [...row.cells].map((cell) => cell.textContent.trim()).join("|"))];
    await key(stage, "d");
    const b = canvases()[1].getBoundingClientRect();
    await pointer(canvases()[1], "pointermove", b.left + b.width * 0.7, b.top + b.height * 0.3);
    seen.pointed = text();
    await key(stage, "ArrowLeft", {shiftKey: true}); await key(stage, "ArrowLeft", {shiftKey: true});
    seen.keys = text();
    for (let i = 0; i < 9; ++i) { await key(stage, "ArrowRight", {shiftKey: true}); await key(stage, "ArrowDown", {shiftKey: true}); }
    seen.corner = text();
    seen.views = viewer.querySelectorAll(".loupe-views canvas").length;
    return seen;)");
  // FLIP: (51 + 2) / 255 = 0.208 in row 2, (51 + 7) / 255 = 0.227 in row 7, 0 on the left.
  EXPECT_EQ(seen["pointed"],
            (json{"Pixel 5, 2", "reference|0.250|0.250|0.250||", "photon mapper|0.500|0.500|0.500|+92.8 %|0.21"}));
  EXPECT_EQ(seen["keys"],
            (json{"Pixel 3, 2", "reference|0.250|0.250|0.250||", "photon mapper|0.250|0.250|0.250|+0.00 %|0.00"}));
  EXPECT_EQ(seen["corner"],
            (json{"Pixel 7, 7", "reference|0.250|0.250|0.250||", "photon mapper|0.500|NaN|0.500|NaN|0.23"}));
  EXPECT_EQ(seen["views"], 2);
}

TEST_F(ViewerInBrowser, help_digits_and_the_gallery_open_and_choose) {
  const json seen = use(R"(
    const seen = {}, menus = () => [...viewer.querySelectorAll("select")].map((select) => select.selectedOptions[0].text).join(" ");
    seen.before = [viewer.querySelector(".keys").hidden, menus()];
    await key(stage, "?", {shiftKey: true});
    seen.help = [viewer.querySelector(".keys").hidden, viewer.querySelector("[aria-expanded]").getAttribute("aria-expanded")];
    await key(stage, "1", {code: "Digit1"});
    seen.digit = menus();
    await key(stage, "@", {code: "Digit2", shiftKey: true});
    seen.shiftDigit = menus();
    await key(stage, "9", {code: "Digit9"});
    seen.tooFar = menus();
    const gallery = box.querySelector(".gallery"), shown = () => window.getComputedStyle(gallery).display;
    seen.hidden = shown();
    box.querySelector(".gallery-toggle").click();
    seen.shown = shown();
    return seen;)");
  EXPECT_EQ(seen["before"], (json{true, "reference photon mapper"}));
  EXPECT_EQ(seen["help"], (json{false, "true"}));
  EXPECT_EQ(seen["digit"], "reference reference");
  EXPECT_EQ(seen["shiftDigit"], "photon mapper reference");
  EXPECT_EQ(seen["tooFar"], "photon mapper reference");
  EXPECT_EQ(seen["hidden"], "none");
  EXPECT_EQ(seen["shown"], "flex");
}

TEST_F(ViewerInBrowser, a_failing_tiles_link_shows_it_beside_the_reference) {
  const json seen = use(R"(
    const hole = page.querySelector("[data-scene=hole]");
    page.querySelector("a[data-tile='1']").click();
    await until(() => hole.querySelector(".viewer"));
    await drawn();
    return {mode: hole.querySelector("input:checked").value, zoom: hole.querySelector(".zoom").textContent,
            images: [...hole.querySelectorAll(".pane .image-label")].map((node) => node.textContent.trim()),
            where: hole.querySelector(".where").textContent, focused: page.activeElement.className,
            top: Math.abs(hole.querySelector(".viewer").getBoundingClientRect().top) < 40};)");
  EXPECT_EQ(seen["mode"], "side");
  EXPECT_EQ(seen["zoom"], "1×");  // the tile is half of an image of 8 pixels: three times it is more than all
  EXPECT_EQ(seen["images"], (json{"reference", "hole-photon-agreement"}));
  EXPECT_EQ(seen["where"], "Pixel 6, 6");  // the middle of the tile at 4, 4
  EXPECT_EQ(seen["focused"], "stage");
  EXPECT_EQ(seen["top"], true);
}

TEST_F(ViewerInBrowser, tables_sort_both_ways_and_remarks_stay_with_their_rows) {
  const json seen = use(R"(
    const table = box.querySelector(".measurements"), seen = {};
    const column = (index) => [...table.tBodies[0].rows].filter((row) => !row.classList.contains("remark")).map((row) => row.cells[index].textContent.trim());
    const header = [...table.tHead.rows[0].cells].find((cell) => cell.textContent === "relMSE");
    seen.before = column(4);
    header.querySelector("button").click();
    seen.up = [header.getAttribute("aria-sort"), ...column(4)];
    header.querySelector("button").click();
    seen.down = [header.getAttribute("aria-sort"), ...column(4)];
    seen.remarks = [...table.querySelectorAll(".remark")].map((row) => {
      const above = row.previousElementSibling;
      return above.cells[0].textContent.trim() + " " + above.cells[1].textContent + ": " + row.textContent.trim(); });
    table.tHead.rows[0].cells[0].querySelector("button").click();
    seen.names = [header.getAttribute("aria-sort"), ...column(0)];
    return seen;)");
  EXPECT_EQ(seen["before"], (json{"–", "0.0500", "0.0125", "0.250", "–"}));
  EXPECT_EQ(seen["up"], (json{"ascending", "0.0125", "0.0500", "0.250", "–", "–"}));
  EXPECT_EQ(seen["down"], (json{"descending", "0.250", "0.0500", "0.0125", "–", "–"}));
  EXPECT_EQ(seen["remarks"],
            (json{"POV-Ray quality 1: host was busy (load 3.1)", "POV-Ray quality 2: killed after 10 s (limit)"}));
  EXPECT_EQ(seen["names"], (json{nullptr, "path (reference)", "photon mapper", "photon mapper", "POV-Ray", "POV-Ray"}));
}

TEST_F(ViewerInBrowser, a_plots_points_say_their_numbers) {
  const json seen = use(R"(
    const plot = box.querySelector("figure.plot"), svg = plot.querySelector("svg"), tip = plot.querySelector(".tip"), seen = {};
    svg.scrollIntoView();
    seen.before = tip.hidden;
    const b = svg.querySelectorAll(".point")[1].getBoundingClientRect();
    await pointer(svg, "pointermove", b.left + b.width / 2 + 3, b.top + b.height / 2);
    seen.near = tip.textContent;
    await pointer(svg, "pointermove", b.left - 300, b.top - 100);
    seen.far = tip.hidden;
    await key(svg, "ArrowRight");
    seen.key = [tip.hidden, tip.textContent];
    return seen;)");
  EXPECT_EQ(seen["before"], true);
  EXPECT_EQ(seen["near"], "photon mapper, 20\u202F000 photons, 3 seeds: relMSE 0.0125 [0.0100, 0.0200] in 4.50 s");
  EXPECT_EQ(seen["far"], true);
  EXPECT_EQ(
      seen["key"],
      (json{false, "photon mapper, 2000 photons, 3 seeds: relMSE 0.0500 [0.0400, 0.0625] in 1.25 [1.20, 1.50] s"}));
}

TEST_F(ViewerInBrowser, a_script_that_is_not_the_pages_own_does_not_run) {
  std::string html = file_text(page);
  const std::string evil = "<script>document.title = 'broken into'</script>";
  html.insert(html.find("</main>"), evil);
  std::ofstream(page) << html;
  const BrowserOutcome outcome = browse(page);
  EXPECT_EQ(count(outcome.dom, "<title>broken into"), 0u);
  ASSERT_EQ(outcome.console.size(), 1u);  // the browser says that it refused
  EXPECT_NE(outcome.console[0].find("Content Security Policy"), std::string::npos) << outcome.console[0];
}

TEST_F(ViewerInBrowser, the_address_names_the_view_and_opens_it_again) {
  const json seen = use(R"(
    const look = () => [checked(), [...viewer.querySelectorAll("select")].map((menu) => menu.selectedOptions[0].textContent),
                        viewer.querySelector(".exposure output").textContent, viewer.querySelector(".zoom").textContent];
    const [first] = canvases();
    await key(stage, "d");
    await key(stage, "x");
    await key(stage, "e");
    await key(stage, "+");
    await key(stage, "+");
    await key(stage, "ArrowRight");
    await key(stage, "ArrowRight", {shiftKey: true});
    const changed = look();
    const link = new window.URL(viewer.querySelector(".view-link").href).hash;
    await until(() => window.location.hash === link);
    const fragment = window.location.hash;
    await key(stage, "r");
    await key(stage, "i");
    await key(stage, "f");
    await wait(300);
    const other = window.location.hash;
    page.activeElement.blur();
    window.location.hash = fragment;
    await until(() => String(look()) === String(changed));
    const again = new window.URL(viewer.querySelector(".view-link").href).hash;
    return {fragment, same: String(look()) === String(changed) && again === fragment, differs: other !== fragment, changed};)");
  EXPECT_EQ(seen["fragment"],
            "#scene=box&mode=side&layer=error&a=reference&b=photon+mapper&stops=0.5&zoom=2&at=4.5%2C4&pixel=5%2C4");
  EXPECT_TRUE(seen["same"]) << seen;
  EXPECT_TRUE(seen["differs"]) << seen;
  EXPECT_EQ(seen["changed"][3], "2×");
}

/// The page, whose address has this fragment before its own script runs.
std::filesystem::path page_at(const std::filesystem::path& page, const std::string& fragment,
                              const std::string& more = {}) {
  std::string text = file_text(page);
  const std::size_t policy = text.find("<meta http-equiv");  // it forbids scripts of others
  text.erase(policy, text.find('\n', policy) - policy);
  const std::size_t body = text.find('>', text.find("<body")) + 1;
  text.insert(body, "<script>" + more + "location.hash = \"" + fragment + "\";</script>");
  const std::filesystem::path out = page.parent_path() / "linked.html";
  std::ofstream(out) << text;
  return out;
}

TEST_F(ViewerInBrowser, a_page_opened_by_a_link_shows_its_view) {
  const std::string link =
      "#scene=box&mode=flip&layer=flip&a=reference&b=photon+mapper&shows=a&stops=-1&zoom=4&at=2,2&pixel=3,1";
  const auto seen = drive(page_at(page, link), 1280, R"(
    const box = page.querySelector("[data-scene=box]"), told = () => box.querySelector(".viewer .status")?.textContent;
    await until(() => told());
    await drawn();
    return [told(), [...box.querySelectorAll(".viewer input:checked")].map((input) => input.value),
            box.querySelector(".viewer .zoom").textContent, Math.abs(box.querySelector(".viewer").getBoundingClientRect().top) < 50];)");
  EXPECT_EQ(seen, (json{"Flip: reference", {"flip", "flip"}, "4×", true}));
}

TEST_F(ViewerInBrowser, a_link_that_makes_no_sense_is_a_page_all_the_same) {
  for (const char* link :
       {"#scene=nobody", "#scene=box&mode=x&layer=y&a=z&zoom=1e999&at=1&pixel=a,b&stops=", "#scene=box&pixel=-5,99"}) {
    const auto seen = drive(page_at(page, link), 1280, R"(
      const box = page.querySelector("[data-scene=box]");
      box.scrollIntoView();
      return [await until(() => (box.querySelector(".viewer .status")?.textContent ?? "") !== "")];)");
    EXPECT_EQ(seen, (json{true})) << link;
  }
}

// The reload is a browser's own; what the page does before and after it is seen here.
TEST_F(ViewerInBrowser, a_live_page_loads_itself_again_and_keeps_its_place) {
  const std::filesystem::path live = folder.path() / "live.html";
  write_live_html_report(sample_conclusions(), folder.path(), live);
  EXPECT_EQ(count(file_text(live), "data-live=\"3\""), 1u);
  EXPECT_EQ(count(file_text(page), "data-live=\""), 0u);
  const std::string kept = "sessionStorage.setItem(`photonproof scroll ${location.pathname}`, 321);";
  const auto seen = drive(page_at(live, "", kept), 1280, R"(
    await until(() => window.scrollY > 0);
    const before = window.scrollY;
    let loads = 0;
    page.defaultView.addEventListener("pagehide", () => ++loads);
    await until(() => loads > 0);
    return [before, loads > 0];)");
  EXPECT_EQ(seen, (json{321, true}));
}

}  // namespace
}  // namespace photonproof::inline reports_page
