// The page: as text, and in a real browser.

#include "extremes/page.h"
#include "tests/browser.h"
#include "tests/extremes/sample_walk.h"
#include "tests/images/temporary_folder.h"
#include "tests/page_text.h"

#include <gtest/gtest.h>

namespace extremes {

using namespace extremes_test;
using namespace page_text;

TEST(ExtremesPage, IsWholeAndNamesNoOtherFiles)
{
    const std::string text = page(sample_results());
    EXPECT_EQ(unfilled_mark(text), "");
    EXPECT_EQ(reference_to_a_file(text), "");
    EXPECT_EQ(data_of(text), sample_results());
    EXPECT_NE(text.find("Michael Bostock"), std::string::npos); // the licence of D3 asks for it
}

namespace {

const std::string extremes_probe = R"probe(<script>
const found = {};
const all_of = (selector, within = document) => [...within.querySelectorAll(selector)];
try {
  found.sections = all_of(".axis-section").map(s => [s.id, all_of("svg", s).length, all_of("svg > .curve", s).length, all_of(".bound", s).length]);
  found.rows = all_of(".method").map(m => [m.getAttribute("data-method"), all_of("rect:not(.track)", m).length, m.getAttribute("aria-label")]);
  found.limits = all_of("#limits tbody tr").length;
  found.legends = all_of(".legend").map(l => l.textContent);
  found.outside = all_of("svg text").filter(t => {
    const box = t.getBoundingClientRect(), svg = t.ownerSVGElement.getBoundingClientRect();
    return box.left < svg.left - 1 || box.right > svg.right + 1 || box.bottom > svg.bottom + 1;
  }).map(t => t.textContent);
  found.not_numbers = all_of("svg *").filter(e => [...e.attributes].some(a => /NaN|undefined|Infinity/.test(a.value))).length;
  found.notices = all_of(".notice").filter(n => !n.hidden && n.id).map(n => n.textContent);
  found.bold = all_of("b").filter(b => b.textContent === "").length;
  const details = document.querySelector("details");
  if (details) { details.open = true; details.dispatchEvent(new Event("toggle")); found.numbers = all_of("tbody tr", details).length; }
} catch (error) { errors.push(String(error)); }
found.errors = errors;
document.title = "found " + JSON.stringify(found);
</script>)probe";

} // namespace

class ExtremesPageInABrowser : public testing::Test {
    void SetUp() override
    {
        if (browser_test::browser().empty())
            GTEST_SKIP() << "there is no chromium here (Debian's package chromium)";
    }

protected:
    static nlohmann::json probed(const Json& results)
    {
        images_test::TemporaryFolder folder;
        std::string html = page(results);
        html.insert(html.rfind("</body>"), extremes_probe);
        images_test::write_bytes(folder / "page.html", html);
        const std::string title = browser_test::title_in_browser(
            browser_test::browser(), folder / "page.html", folder / "profile");
        EXPECT_EQ(title.rfind("found ", 0), 0u) << title;
        return title.rfind("found ", 0) == 0 ? nlohmann::json::parse(title.substr(6)) : nlohmann::json();
    }
};

TEST_F(ExtremesPageInABrowser, DrawsAxesMethodsAndLimits)
{
    const nlohmann::json found = probed(sample_results());
    ASSERT_TRUE(found.is_object());
    EXPECT_TRUE(found.at("errors").empty()) << found.at("errors");
    EXPECT_TRUE(found.at("outside").empty()) << found.at("outside");
    EXPECT_EQ(found.at("not_numbers"), 0);
    EXPECT_EQ(found.at("sections"),
              nlohmann::json::parse(R"([["axis-size",1,3,2],["axis-share",1,1,0]])"));
    EXPECT_EQ(found.at("rows").at(0), nlohmann::json({"ref", 0, "ref: no failure"}));
    EXPECT_EQ(found.at("rows").at(1),
              nlohmann::json({"host", 3, "host: leaked at 100, refused at 0.00100"}));
    EXPECT_EQ(found.at("limits"), 2);
    EXPECT_EQ(found.at("legends"), nlohmann::json({"leakedrefused"}));
    EXPECT_TRUE(found.at("notices").empty()) << found.at("notices");
    EXPECT_EQ(found.at("numbers"), 21);
}

TEST_F(ExtremesPageInABrowser, SaysWhatIsMissingOrWrong)
{
    Json results = sample_results();
    results["complete"] = false;
    results["axes"][0]["limits"][0]["contradiction"] = "3 of 100 cases fail";
    results["axes"][0]["methods"][2]["points"] = Json::array();
    const nlohmann::json found = probed(results);
    ASSERT_TRUE(found.is_object());
    EXPECT_TRUE(found.at("errors").empty()) << found.at("errors");
    EXPECT_EQ(found.at("notices").size(), 2u);
    EXPECT_EQ(found.at("notices").at(1), "A limit does not hold: size, ref: 3 of 100 cases fail");
}

TEST_F(ExtremesPageInABrowser, NamesCannotBecomeTagsAndFieldsMayBeMissing)
{
    const std::string evil = "</script><b></b><img src=x onerror='errors.push(1)'>";
    Json results = sample_results();
    results["axes"][0]["title"] = evil;
    results["axes"][0]["about"] = evil;
    results["axes"][0]["methods"][0]["name"] = evil;
    results["axes"][0]["limits"][0]["because"] = evil;
    results["axes"][1].erase("methods");
    results["axes"][1].erase("values");
    const nlohmann::json found = probed(results);
    ASSERT_TRUE(found.is_object());
    EXPECT_TRUE(found.at("errors").empty()) << found.at("errors");
    EXPECT_EQ(found.at("bold"), 0);
    const nlohmann::json nothing = probed(Json::object());
    ASSERT_TRUE(nothing.is_object());
    EXPECT_TRUE(nothing.at("errors").empty()) << nothing.at("errors");
}

} // namespace extremes
