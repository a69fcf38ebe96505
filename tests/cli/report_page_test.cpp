// The report in a real browser: it opens without errors, and its controls work.

#include "tests/browser.h"
#include "tests/cli/run_program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace {

using namespace browser_test;
using namespace cli_test;

/// Runs in the page after the page's own script. The results are written to the title of the page, which
/// the test reads.
const std::string probe = R"(<script>
const found = {};
const move = (id, value) => {
  document.getElementById(id).value = value;
  document.getElementById(id).dispatchEvent(new Event("input"));
};
const canvas = document.getElementById("golden");
const sum = () => canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data
  .reduce((a, b) => a + b, 0);
try {
  found.size = [canvas.width, canvas.height];
  move("slider", 50); found.middle = document.getElementById("candidate").style.clipPath;
  move("slider", 80); found.moved = document.getElementById("candidate").style.clipPath;
  move("zoom", 1); const narrow = parseInt(canvas.style.width);
  move("zoom", 4); found.zoomed = parseInt(canvas.style.width) / narrow;
  move("exposure", 0); const as_is = sum();
  move("exposure", 2); found.brighter = sum() > as_is;
  found.tile_maps = document.querySelectorAll("#tiles canvas").length;
  found.bars = document.querySelectorAll("#histogram rect").length;
  found.rows = document.querySelectorAll("#findings table")[0].rows.length;
  const canvas_box = canvas.getBoundingClientRect();
  document.getElementById("pair").dispatchEvent(new MouseEvent("mousemove",
    { clientX: canvas_box.left + 1, clientY: canvas_box.top + 1, bubbles: true }));
  found.probe = document.getElementById("probe").textContent;
  const rest = document.querySelector("#findings details");
  rest.open = true; rest.dispatchEvent(new Event("toggle"));
  found.all_rows = rest.querySelector("table").rows.length;
} catch (error) { errors.push(String(error)); }
found.errors = errors;
document.title = "found " + JSON.stringify(found);
</script>)";

TEST(ReportPage, OpensInABrowserAndItsControlsMove)
{
    const std::string chromium = browser();
    if (chromium.empty()) GTEST_SKIP() << "there is no chromium here (Debian's package chromium)";
    TemporaryFolder folder;
    const Arguments size = {"--size", "16x12", "-s", "256"};
    ASSERT_EQ(run(Arguments{"golden", scene_file("cornell_glass"), "--folder", folder.path().string(),
                            "--batch", "4", "--pilot", "8"} +
                  size)
                  .status,
              0);
    const std::string candidate = (folder / "candidate.exr").string();
    ASSERT_EQ(run(Arguments{"render", scene_file("cornell_glass"), "-o", candidate, "--integrator",
                            "bdpt", "--max-edges", "6", "--keep-batches"} +
                  size)
                  .status,
              0);
    const std::string page = (folder / "report.html").string();
    EXPECT_NE(
        run({"compare", candidate, (folder / "cornell_glass.exr").string(), "--report", page}).status,
        2);

    std::string html = read_bytes(page);
    const std::size_t head = html.find("<style>");
    ASSERT_NE(head, std::string::npos);
    html.insert(head, "<script>const errors = []; window.onerror = m => errors.push(m);</script>");
    html.insert(html.rfind("</body>"), probe);
    write_bytes(page, html);
    const std::string title = title_in_browser(chromium, page, folder / "profile");
    ASSERT_EQ(title.rfind("found ", 0), 0u) << title;
    const auto found = nlohmann::json::parse(title.substr(6));
    EXPECT_TRUE(found.at("errors").empty()) << found.at("errors");
    EXPECT_EQ(found.at("size"), nlohmann::json({16, 12}));
    EXPECT_EQ(found.at("middle"), "inset(0px 0px 0px 50%)");
    EXPECT_EQ(found.at("moved"), "inset(0px 0px 0px 20%)");
    EXPECT_EQ(found.at("zoomed"), 4);
    EXPECT_EQ(found.at("brighter"), true);
    EXPECT_EQ(found.at("tile_maps"), 3);
    EXPECT_EQ(found.at("bars"), 20);
    EXPECT_EQ(found.at("rows"), 13); // the header row and twelve findings
    EXPECT_GT(found.at("all_rows").get<int>(), 100);
    EXPECT_EQ(found.at("probe").get<std::string>().rfind("(0, 0)", 0), 0u) << found.at("probe");
}

} // namespace
