#include "cli/run_self.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>

extern char** environ; // NOLINT(readability-redundant-declaration): of POSIX, in no header by its rules

namespace cli {

std::optional<std::string> output_of_self(const std::vector<std::string>& arguments)
{
    std::vector<std::string> texts = {"plumbline"};
    texts.insert(texts.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& text : texts) argv.push_back(text.data());
    argv.push_back(nullptr);

    std::array<int, 2> ends{}; // read, write
    if (pipe2(ends.data(), O_CLOEXEC) != 0) return std::nullopt;
    posix_spawn_file_actions_t actions{};
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    pid_t process = 0;
    const int failed = posix_spawn(&process, "/proc/self/exe", &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);

    std::string output;
    std::array<char, 4096> some{};
    for (ssize_t n = 0; failed == 0 && (n = read(ends[0], some.data(), some.size())) > 0;)
        output.append(some.data(), static_cast<std::size_t>(n));
    close(ends[0]);
    int status = 0;
    if (failed != 0 || waitpid(process, &status, 0) != process) return std::nullopt;
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return std::nullopt;
    return output;
}

} // namespace cli
