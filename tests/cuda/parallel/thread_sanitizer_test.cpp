// Tests that ThreadSanitizer reports a refit that is known to be wrong. Otherwise, the absence of a
// report on the right one would prove nothing.

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <string>

#include <sys/wait.h>

namespace {

struct Ended {
    int status;
    std::string output;
};

Ended run_refit(const std::string& how)
{
    std::FILE* const pipe = popen((PLUMBLINE_RELAXED_REFIT " " + how + " 2>&1").c_str(), "r");
    std::string output;
    std::array<char, 4096> block{};
    while (const std::size_t bytes = std::fread(block.data(), 1, block.size(), pipe))
        output.append(block.data(), bytes);
    const int status = pclose(pipe);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, output};
}

TEST(ThreadSanitizer, HasNothingToSayAboutTheRefit)
{
    const Ended ended = run_refit("right");
    EXPECT_EQ(ended.status, 0) << ended.output;
    EXPECT_EQ(ended.output, "");
}

TEST(ThreadSanitizer, ReportsARefitWhoseArrivalsAreRelaxed)
{
#if !defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "needs ThreadSanitizer: ./run sanitize builds with it";
#endif
    const Ended ended = run_refit("relaxed");
    EXPECT_NE(ended.status, 0);
    EXPECT_NE(ended.output.find("ThreadSanitizer: data race"), std::string::npos) << ended.output;
    EXPECT_NE(ended.output.find("RefitBounds"), std::string::npos) << ended.output;
}

} // namespace
