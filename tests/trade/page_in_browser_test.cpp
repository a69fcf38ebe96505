// The page in a real browser: it opens without errors, draws every configuration, and its controls work.

#include "tests/browser.h"
#include "tests/images/temporary_folder.h"
#include "tests/trade/sample_results.h"
#include "trade/page.h"

#include <gtest/gtest.h>

namespace {

using namespace trade_test;
using images_test::TemporaryFolder;
using images_test::write_bytes;

/// Runs in the page after the page's own scripts. The results are written to the title of the page,
/// which the test reads.
const std::string trade_probe = R"probe(<script>
const found = {};
const text = (selector, within = document) => within.querySelector(selector)?.textContent ?? "";
const all_of = selector => [...document.querySelectorAll(selector)];
const first_column = () => all_of("#table tbody tr").map(row => row.cells[0].textContent);
try {
  found.symbols = all_of("#main-plot .symbol").length;
  found.kinds = ["unbiased", "biased", "undecided"].map(kind => all_of("#main-plot .symbol." + kind).length);
  found.ticks = all_of("#main-plot .axis text").length;
  found.front = all_of("#main-plot path.front").length;
  const plot = document.querySelector("#main-plot svg")?.getBoundingClientRect();
  found.outside = all_of("#main-plot text, #knobs text").filter(t => {
    const box = t.getBoundingClientRect(), svg = t.ownerSVGElement.getBoundingClientRect();
    return box.left < svg.left - 1 || box.right > svg.right + 1 || box.top < svg.top - 8 || box.bottom > svg.bottom + 1;
  }).map(t => t.textContent);
  const boxes = all_of("#main-plot .label").map(t => t.getBoundingClientRect());
  found.overlaps = boxes.flatMap((a, i) => boxes.slice(i + 1).filter(b =>
    a.left < b.right && b.left < a.right && a.top + 2 < b.bottom - 2 && b.top + 2 < a.bottom - 2)).length;
  found.not_numbers = all_of("svg *").filter(e => [...e.attributes].some(a => /NaN|undefined|Infinity/.test(a.value)) ||
    (e.children.length === 0 && /NaN|undefined|Infinity/.test(e.textContent))).length;
  found.strange_text = /NaN|undefined|\[object/.test(document.body.innerText);
  found.panels = all_of("#knobs .knob").length;
  found.pictures = all_of("#pictures img").length;
  found.bold = all_of("b").filter(b => b.textContent === "").length; // a name that became a tag
  found.color = plot ? getComputedStyle(document.querySelector("#main-plot .axis text")).fill : "";
  found.sections = all_of("section").filter(s => !s.hidden).map(s => s.id);
  found.notices = all_of(".notice").filter(n => !n.hidden && n.id).map(n => n.id);
  found.lead = text("#lead");

  // The numbers of a symbol, by the mouse and by the keyboard.
  const symbol = all_of("#main-plot .symbol").find(s => s.getAttribute("aria-label").startsWith("max-edges=3"));
  if (symbol) {
    const box = symbol.querySelector(".mark").getBoundingClientRect();
    const at = { clientX: (box.left + box.right) / 2, clientY: (box.top + box.bottom) / 2, bubbles: true };
    symbol.dispatchEvent(new MouseEvent("mousemove", at));
    found.pointed = [document.getElementById("tip").hidden, text("#tip strong"), text("#tip .mono")];
    const tip = document.getElementById("tip").getBoundingClientRect();
    found.tip_inside = tip.left >= plot.left - 1 && tip.right <= plot.right + 1;
    document.getElementById("main-plot").dispatchEvent(new MouseEvent("mouseleave"));
    found.left = document.getElementById("tip").hidden;
    symbol.focus();
    found.focused = text("#tip strong");
    symbol.blur();
  }

  // The table: as measured, then sorted by efficiency in both directions, then by a column with equal values.
  found.rows = first_column();
  const head = name => all_of("#table th").find(th => th.textContent === name);
  const sort_by = name => { head(name).querySelector("button").click(); return [head(name).getAttribute("aria-sort"), first_column()]; };
  if (found.rows.length) {
    found.up = sort_by("efficiency, 1/(relMSE s)");
    found.down = sort_by("efficiency, 1/(relMSE s)");
    found.equal = sort_by("batches");
    found.sorted_heads = all_of("#table th:not([aria-sort=none])").length;
  }
} catch (error) { errors.push(String(error)); }
found.errors = errors;
document.title = "found " + JSON.stringify(found);
</script>)probe";

/// What the probe finds in the page of `results`; null without a browser.
nlohmann::json probed(const Json& results, const std::string& options = "")
{
    TemporaryFolder folder;
    std::string html = trade::page(results);
    html.insert(html.rfind("</body>"), trade_probe);
    write_bytes(folder / "page.html", html);
    const std::string title = browser_test::title_in_browser(
        browser_test::browser(), folder / "page.html", folder / "profile", options);
    EXPECT_EQ(title.rfind("found ", 0), 0u) << title;
    return title.rfind("found ", 0) == 0 ? nlohmann::json::parse(title.substr(6)) : nlohmann::json();
}

class TradePageInABrowser : public testing::Test {
    void SetUp() override
    {
        if (browser_test::browser().empty())
            GTEST_SKIP() << "there is no chromium here (Debian's package chromium)";
    }
};

void expect_no_faults(const nlohmann::json& found)
{
    ASSERT_TRUE(found.is_object());
    EXPECT_TRUE(found.at("errors").empty()) << found.at("errors");
    EXPECT_EQ(found.at("not_numbers"), 0);
    EXPECT_EQ(found.at("strange_text"), false);
    EXPECT_TRUE(found.at("outside").empty()) << found.at("outside");
    EXPECT_EQ(found.at("overlaps"), 0);
    EXPECT_EQ(found.at("bold"), 0);
}

TEST_F(TradePageInABrowser, DrawsAllConfigurationsAndItsControlsWork)
{
    const Json results = sample_results();
    const nlohmann::json found = probed(results);
    ASSERT_NO_FATAL_FAILURE(expect_no_faults(found));
    EXPECT_EQ(found.at("symbols"), 19); // one of 20 could not be measured
    EXPECT_EQ(found.at("kinds"), nlohmann::json({13, 4, 2}));
    EXPECT_EQ(found.at("front"), 1);
    EXPECT_EQ(found.at("panels"), 7);
    EXPECT_EQ(found.at("pictures"), 19);
    EXPECT_TRUE(found.at("notices").empty()) << found.at("notices");
    EXPECT_EQ(found.at("pointed"),
              nlohmann::json({false, "max-edges=3", results["configurations"][2]["command"]}));
    EXPECT_EQ(found.at("tip_inside"), true);
    EXPECT_EQ(found.at("left"), true);
    EXPECT_EQ(found.at("focused"), "max-edges=3");
}

TEST_F(TradePageInABrowser, TheTableSortsByNumberAndKeepsTheOrderOfEqualRows)
{
    const Json results = sample_results();
    const nlohmann::json found = probed(results);
    ASSERT_TRUE(found.is_object());
    std::vector<Json> sorted;
    std::vector<std::string> names;
    for (const Json& c : results["configurations"])
        if (c["problem"].is_null()) {
            sorted.push_back(c);
            names.push_back(c["name"]);
        }
    EXPECT_EQ(found.at("rows").size(), 20u);
    EXPECT_EQ(found.at("rows").back(), "device=cuda"); // which could not be measured
    const auto efficiency = [](const Json& c) { return c["efficiency"]["value"].get<double>(); };
    const auto expect_order = [&](const nlohmann::json& order, const std::string& direction,
                                  std::vector<std::string> expected) {
        expected.emplace_back("device=cuda");
        EXPECT_EQ(order.at(0), direction);
        EXPECT_EQ(order.at(1), nlohmann::json(expected));
    };
    const auto names_of = [](const std::vector<Json>& all) {
        std::vector<std::string> of;
        for (const Json& c : all) of.push_back(c["name"]);
        return of;
    };
    std::stable_sort(sorted.begin(), sorted.end(),
                     [&](const Json& a, const Json& b) { return efficiency(a) < efficiency(b); });
    expect_order(found.at("up"), "ascending", names_of(sorted));
    std::stable_sort(sorted.begin(), sorted.end(),
                     [&](const Json& a, const Json& b) { return efficiency(a) > efficiency(b); });
    expect_order(found.at("down"), "descending", names_of(sorted));
    expect_order(found.at("equal"), "ascending", names); // all have as many batches
    EXPECT_EQ(found.at("sorted_heads"), 1);
}

TEST_F(TradePageInABrowser, TextIsLightOnDarkWhereDarkIsPreferred)
{
    const Json results = sample_results();
    const nlohmann::json dark = probed(results, "--blink-settings=preferredColorScheme=0");
    const nlohmann::json light = probed(results, "--blink-settings=preferredColorScheme=1");
    ASSERT_NO_FATAL_FAILURE(expect_no_faults(dark));
    const auto brightness = [](const std::string& color) {
        int r = -1;
        int g = -1;
        int b = -1;
        EXPECT_EQ(std::sscanf(color.c_str(), "rgb(%d, %d, %d)", &r, &g, &b), 3) << color;
        return r + g + b;
    };
    EXPECT_GT(brightness(dark.at("color")), 3 * 200);
    EXPECT_LT(brightness(light.at("color")), 3 * 60);
}

TEST_F(TradePageInABrowser, NamesCannotBecomeTags)
{
    const std::string evil = "</script><b></b><img src=x onerror='errors.push(1)'>";
    Json results = sample_results();
    results["scene"]["name"] = evil;
    results["command"] = evil;
    results["truth"]["source"] = evil;
    for (Json& c : results["configurations"])
        for (const char* field : {"name", "command", "value", "knob"})
            if (c[field] != "max-edges") c[field] = evil + c[field].get<std::string>();
    results["configurations"][17]["problem"] = evil;
    for (Json& knob : results["knobs"])
        for (const char* field : {"what", "sentence"}) knob[field] = evil;
    results["requirements"][0]["sentence"] = evil;
    const nlohmann::json found = probed(results);
    ASSERT_TRUE(found.is_object());
    EXPECT_TRUE(found.at("errors").empty()) << found.at("errors");
    EXPECT_EQ(found.at("bold"), 0);
    EXPECT_EQ(found.at("symbols"), 19);
}

TEST_F(TradePageInABrowser, FieldsMayBeMissing)
{
    Json results = sample_results();
    for (const char* field : {"knobs", "requirements"}) results[field] = Json::array();
    for (const char* field : {"front", "truth", "machine", "noise_of_machine"}) results[field] = nullptr;
    for (Json& c : results["configurations"])
        for (const char* field : {"bias_squared", "relmse_1s", "efficiency", "time_to_equal_noise",
                                  "speed", "memory", "picture"})
            c[field] = nullptr;
    for (const char* field : {"whole", "worst", "worst_region", "detectable"})
        results["configurations"][3]["bias"][field] = nullptr;
    results["configurations"][4]["bias"] = nullptr;
    results["configurations"][5]["build"]["wall"] = nullptr;
    const nlohmann::json found = probed(results);
    ASSERT_NO_FATAL_FAILURE(expect_no_faults(found));
    EXPECT_EQ(found.at("symbols"), 19);
    EXPECT_EQ(found.at("front"), 0);
    EXPECT_EQ(found.at("sections"), nlohmann::json({"main-section", "table-section"}));

    const nlohmann::json nothing = probed(Json::object());
    ASSERT_NO_FATAL_FAILURE(expect_no_faults(nothing));
    EXPECT_EQ(nothing.at("symbols"), 0);
}

TEST_F(TradePageInABrowser, OneConfigurationIsEnough)
{
    Json results = sample_results();
    results["configurations"] = Json::array({results["configurations"][0]});
    add_front(results);
    const nlohmann::json found = probed(results);
    ASSERT_NO_FATAL_FAILURE(expect_no_faults(found));
    EXPECT_EQ(found.at("symbols"), 1);
    EXPECT_EQ(found.at("front"), 1);
    EXPECT_GE(found.at("ticks"), 6); // two numbers at each axis, and the titles
    EXPECT_EQ(found.at("rows"), nlohmann::json({"base"}));
}

TEST_F(TradePageInABrowser, SaysWhenTheMeasurementIsNotGood)
{
    Json results = sample_results();
    results["noise_of_machine"]["half_width"] = 0.2;
    results["complete"] = false;
    for (Json& c : results["configurations"]) c["problem"] = "interrupted";
    const nlohmann::json found = probed(results);
    ASSERT_NO_FATAL_FAILURE(expect_no_faults(found));
    EXPECT_EQ(found.at("notices"), nlohmann::json({"interrupted", "too-noisy"}));
    EXPECT_EQ(found.at("symbols"), 0);
    EXPECT_EQ(found.at("rows").size(), 20u);
}

} // namespace
