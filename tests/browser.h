#pragma once

// Pages in a real browser without a screen.

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace browser_test {

/// The name of a browser that is installed here, or "".
inline std::string browser()
{
    for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
        if (std::system(("command -v " + std::string(name) + " >/dev/null").c_str()) == 0) return name;
    return "";
}

/// The page's <title> after its scripts have run. `profile` is a folder for the browser; `options` are
/// added to its command line.
inline std::string title_in_browser(const std::string& browser, const std::filesystem::path& page,
                                    const std::filesystem::path& profile,
                                    const std::string& options = "")
{
    // A browser reserves more addresses than a limit of memory allows, and uses few of them.
    const std::string command = "ulimit -S -v unlimited 2>/dev/null; timeout 120 " + browser +
                                " --headless --no-sandbox --disable-gpu --disable-dev-shm-usage"
                                " --user-data-dir='" +
                                profile.string() + "' --virtual-time-budget=10000 " + options +
                                " --dump-dom 'file://" + page.string() + "' 2>/dev/null";
    std::FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) return "";
    std::string text;
    std::array<char, 4096> some{};
    for (std::size_t n = 0; (n = std::fread(some.data(), 1, some.size(), pipe)) > 0;)
        text.append(some.data(), n);
    pclose(pipe);
    const std::size_t begin = text.find("<title>");
    if (begin == std::string::npos) return "";
    return text.substr(begin + 7, text.find("</title>", begin) - begin - 7);
}

} // namespace browser_test
