#include "cli/words_after_dashes.h"

#include <algorithm>
#include <string_view>

namespace cli {

namespace {

std::vector<std::string>& kept_words()
{
    static std::vector<std::string> words;
    return words;
}

} // namespace

void take_words_after_dashes(int& argc, char** argv, const std::string& name)
{
    if (argc < 2 || name != argv[1]) return;
    char** const end = argv + argc;
    char** const dashes = std::find(argv, end, std::string_view("--"));
    if (dashes == end) return;
    kept_words().assign(dashes + 1, end);
    argc = static_cast<int>(dashes - argv);
}

const std::vector<std::string>& words_after_dashes()
{
    return kept_words();
}

} // namespace cli
