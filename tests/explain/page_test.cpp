// The drawing and the page of a sample, as text and in a real browser.

#include "explain/drawing.h"
#include "explain/factors.h"
#include "explain/page.h"
#include "explain/search.h"
#include "tests/browser.h"
#include "tests/images/temporary_folder.h"
#include "tests/page_text.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

#include <fstream>

namespace {

using explain::Sample;
using explain::Strategy;

struct Explained {
    scenes::Scene scene;
    ref::World world;

    explicit Explained(const std::string& name)
        : scene(transport_test::our_scene(name)), world(scene, 30, 20)
    {}

    [[nodiscard]] Sample sample(images::Integrator integrator, std::uint32_t pixel, std::uint32_t number,
                                int max_edges = 6) const
    {
        return explain::explain_sample(world, integrator, {.seed = 1, .max_edges = max_edges},
                                       {1, pixel, number});
    }
};

// A factor has at most some 20 roundings, and there are at most 5: 1e-13 is far more.
TEST(ExplainFactors, MultiplyToTheValue)
{
    std::size_t compared = 0;
    for (const char* name : {"cornell_glass", "all_emitters"}) {
        const Explained explained(name);
        for (const auto integrator :
             {images::Integrator::path, images::Integrator::bdpt, images::Integrator::light})
            for (std::uint32_t i = 0; i < 150; ++i) {
                const Sample sample = explained.sample(integrator, i * 4, i);
                for (const Strategy& strategy : sample.strategies) {
                    if (!strategy.made) continue;
                    ref::Rgb product(1.0);
                    for (const auto& factor : factors(explained.world, sample, strategy))
                        product = factor.divides ? product / factor.value : product * factor.value;
                    for (int c = 0; c < 3; ++c)
                        ASSERT_NEAR(product[c], strategy.made->value[c],
                                    1e-13 * std::abs(strategy.made->value[c]));
                    ++compared;
                }
            }
    }
    EXPECT_GT(compared, 1000u);
}

TEST(ExplainDrawing, ShowsBlockedAndFreeLinesDifferently)
{
    const Explained explained("cornell_glass");
    bool stopped = false;
    images::RenderOptions options{.integrator = images::Integrator::bdpt, .seed = 1, .max_edges = 6};
    const auto found =
        find_first(explained.world, options, {4}, explain::Condition("obstacle=blocked"), {}, stopped);
    ASSERT_TRUE(found);
    const Sample sample = explained.sample(images::Integrator::bdpt, found->id.pixel, found->id.sample);
    std::size_t blocked = 0;
    std::size_t free = 0;
    std::size_t whole = 0;
    for (const Strategy& strategy : sample.strategies) {
        blocked += strategy.blocker ? 1 : 0;
        free += strategy.made && strategy.s > 0 ? 1 : 0;
        whole += static_cast<int>(strategy.path.size()) == strategy.s + strategy.t ? 1 : 0;
    }
    const std::string picture = drawing(explained.world, sample);
    // In each of the three views, and once in the legend.
    EXPECT_EQ(page_text::count(picture, "class='blocked'"), 3 * blocked + 1);
    EXPECT_EQ(page_text::count(picture, "class='join'"), 3 * free + 1);
    EXPECT_EQ(page_text::count(picture, "class='path'"), 0u);
    const std::string with_paths = drawing(explained.world, sample, explain::Paths::hidden);
    EXPECT_EQ(page_text::count(with_paths, "class='path'"), 3 * whole);
    EXPECT_EQ(page_text::count(picture, "nan"), 0u);
    EXPECT_EQ(page_text::count(picture, "inf"), 0u);
}

// Names are about 18 wide and 16 high. The two walks of paths of at most 3 edges have 7 vertices.
TEST(ExplainDrawing, NamesOfVerticesDoNotCoverEachOther)
{
    const Explained explained("cornell_diffuse");
    std::size_t names = 0;
    for (std::uint32_t i = 0; i < 20; ++i) {
        const std::string picture =
            drawing(explained.world, explained.sample(images::Integrator::bdpt, 31 * i, i, 3));
        std::vector<std::pair<double, double>> places; // of the names in one panel
        for (std::size_t at = picture.find("<svg x="); at != std::string::npos;) {
            const std::string name = "<text class='vertex' x='";
            const std::size_t next_panel = picture.find("<svg x=", at + 1);
            at = picture.find(name, at + 1);
            if (at > next_panel) {
                places.clear();
                at = next_panel;
                continue;
            }
            if (at == std::string::npos) break;
            const double x = std::stod(picture.substr(at + name.size()));
            const double y = std::stod(picture.substr(picture.find("y='", at) + 3));
            for (const auto& [other_x, other_y] : places)
                EXPECT_TRUE(std::abs(x - other_x) >= 17.9 || std::abs(y - other_y) >= 15.9) << picture;
            places.emplace_back(x, y);
            ++names;
        }
    }
    EXPECT_GT(names, 200u);
}

/// Runs in the page after its own scripts.
const std::string explain_probe = R"probe(<script>
const found = {};
const shown = () => [...document.querySelectorAll("#drawing .path")].filter(p => p.style.display !== "none").map(p => p.dataset.strategy);
try {
  found.rows = document.querySelectorAll("#strategies tbody tr").length;
  found.vertices = document.querySelectorAll("#walks tbody tr").length;
  found.first = new Set(shown()).size;
  const button = [...document.querySelectorAll("#strategies tr:not(.nothing) button")].pop();
  button.click();
  found.chosen = button.dataset.strategy;
  found.shown = shown();
  found.detail = document.getElementById("detail").innerText;
  document.querySelector("#strategies tr.nothing button").click();
  found.nothing = document.getElementById("detail").innerText.includes("It contributes nothing: ");
  found.strange = /NaN|undefined|\[object/.test(document.body.innerText);
} catch (error) { errors.push(String(error)); }
found.errors = errors;
document.title = "found " + JSON.stringify(found);
</script>)probe";

TEST(ExplainPage, NeedsNoOtherFile)
{
    const Explained explained("all_emitters");
    const std::string page =
        explain::page(explained.world, explained.sample(images::Integrator::bdpt, 310, 2));
    // The name space of SVG is an address that nobody looks up.
    std::string rest = page;
    const std::string space = "http://www.w3.org/2000/svg";
    for (auto at = rest.find(space); at != std::string::npos; at = rest.find(space))
        rest.erase(at, space.size());
    EXPECT_EQ(page_text::reference_to_a_file(rest), "");
}

TEST(ExplainPage, ShowsTheStrategyThatIsChosen)
{
    const std::string browser = browser_test::browser();
    if (browser.empty()) GTEST_SKIP() << "no browser is installed";
    const Explained explained("cornell_glass");
    const Sample sample = explained.sample(images::Integrator::bdpt, 400, 1);
    std::string page = explain::page(explained.world, sample);
    page.insert(page.find("</body>"), explain_probe);
    const images_test::TemporaryFolder folder;
    images_test::write_bytes(folder / "page.html", page);
    const std::string title =
        browser_test::title_in_browser(browser, folder / "page.html", folder / "profile");
    ASSERT_EQ(title.rfind("found ", 0), 0u) << title;
    const auto found = nlohmann::json::parse(title.substr(6));
    EXPECT_EQ(found["errors"].size(), 0u) << title;
    EXPECT_FALSE(found["strange"]);
    EXPECT_EQ(found["rows"], sample.strategies.size());
    EXPECT_EQ(found["vertices"], sample.eye.steps.size() + sample.light.steps.size());
    EXPECT_EQ(found["first"], 1);
    EXPECT_EQ(found["shown"], nlohmann::json({found["chosen"], found["chosen"], found["chosen"]}));
    EXPECT_TRUE(found["nothing"]);
    // The line that it names computes what it says.
    const std::string detail = found["detail"];
    const std::size_t at = detail.find("ref/transport/connect.cpp:");
    ASSERT_NE(at, std::string::npos) << detail;
    std::ifstream source(std::filesystem::path(PLUMBLINE_SOURCE_DIR) / "ref/transport/connect.cpp");
    std::string line;
    for (int i = std::stoi(detail.substr(at + 26)); i > 0; --i) std::getline(source, line);
    EXPECT_NE(line.find("last.alpha * "), std::string::npos) << line;
}

} // namespace
