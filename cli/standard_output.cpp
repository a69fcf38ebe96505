#include "cli/standard_output.h"

#include <csignal>
#include <cstdio>
#include <iostream>

namespace cli {

void expect_closed_pipes()
{
    std::signal(SIGPIPE, SIG_IGN);
}

bool flush_standard_output()
{
    std::cout.flush();
    const bool flushed = std::fflush(stdout) == 0;
    return flushed && std::cout.good() && std::ferror(stdout) == 0;
}

} // namespace cli
