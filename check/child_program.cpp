#include "check/child_program.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cctype>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <set>
#include <stdexcept>
#include <system_error>
#include <thread>

extern char** environ; // NOLINT(readability-redundant-declaration): of POSIX, in no header by its rules

namespace check {

namespace {

constexpr std::size_t kept_bytes = 2000;

bool is_name(std::string_view text)
{
    if (text.empty()) return false;
    for (const char c : text)
        if (c != '_' && std::islower(static_cast<unsigned char>(c)) == 0) return false;
    return true;
}

std::string filled_in_word(const std::string& word, const std::map<std::string, std::string>& values)
{
    std::string result;
    for (std::size_t i = 0; i < word.size();) {
        const std::size_t end = word[i] == '{' ? word.find('}', i) : std::string::npos;
        const std::string name = end == std::string::npos ? "" : word.substr(i + 1, end - i - 1);
        if (!is_name(name)) {
            result += word[i++];
            continue;
        }
        const auto value = values.find(name);
        if (value == values.end()) {
            std::string known;
            for (const auto& [key, _] : values) known += (known.empty() ? "{" : ", {") + key + "}";
            throw std::invalid_argument("{" + name +
                                        "} in the command has no value (those with one: " + known + ")");
        }
        result += value->second;
        i = end + 1;
    }
    return result;
}

/// The two ends of a pipe, closed at the end.
struct Pipe {
    std::array<int, 2> ends{}; // read, write
    Pipe()
    {
        if (pipe2(ends.data(), O_CLOEXEC) != 0)
            throw std::system_error(errno, std::generic_category(), "pipe");
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    ~Pipe()
    {
        close(ends[0]);
        close_write();
    }
    void close_write()
    {
        if (ends[1] >= 0) close(ends[1]);
        ends[1] = -1;
    }
};

/// Starts the program in a process group of its own, so that all its processes can be killed at once.
pid_t start(const std::vector<std::string>& words, int output)
{
    std::vector<std::string> texts = words;
    std::vector<char*> argv;
    for (std::string& text : texts) argv.push_back(text.data());
    argv.push_back(nullptr);

    posix_spawn_file_actions_t actions{};
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
    posix_spawnattr_t attributes{};
    posix_spawnattr_init(&attributes);
    sigset_t ignored_here{}; // a signal that is ignored stays so in the new program unless it is reset
    sigemptyset(&ignored_here);
    sigaddset(&ignored_here, SIGPIPE);
    posix_spawnattr_setsigdefault(&attributes, &ignored_here);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
    pid_t process = 0;
    const int failed = posix_spawnp(&process, argv[0], &actions, &attributes, argv.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0)
        throw std::runtime_error(words[0] +
                                 ": cannot be started: " + std::generic_category().message(failed));
    return process;
}

/// The process groups of the programs that are running.
struct Children {
    std::mutex mutex;
    std::set<pid_t> groups;
    bool are_over = false; // no other is started
};

/// Never destroyed: another thread may kill them while this program ends.
Children& all_children()
{
    static auto* const children = new Children;
    return *children;
}

/// A started program: among all_children() as long as it runs.
class RunningChild {
public:
    RunningChild(const std::vector<std::string>& words, int output)
    {
        const std::lock_guard lock(all_children().mutex);
        if (all_children().are_over) throw std::runtime_error(words[0] + ": interrupted");
        process_ = start(words, output);
        all_children().groups.insert(process_);
    }
    RunningChild(const RunningChild&) = delete;
    RunningChild& operator=(const RunningChild&) = delete;
    ~RunningChild()
    {
        const std::lock_guard lock(all_children().mutex);
        all_children().groups.erase(process_);
    }
    [[nodiscard]] pid_t process() const { return process_; }

private:
    pid_t process_;
};

/// Reads some bytes, and keeps the end of all. Returns how many: 0 at the end of the output, -1 if there
/// are none at present.
ssize_t read_some(int file, std::string& kept)
{
    std::array<char, 16384> some{};
    const ssize_t n = read(file, some.data(), some.size());
    if (n > 0) kept.append(some.data(), static_cast<std::size_t>(n));
    if (kept.size() > kept_bytes) kept.erase(0, kept.size() - kept_bytes);
    return n;
}

} // namespace

std::vector<std::string> filled_in(const std::vector<std::string>& words,
                                   const std::map<std::string, std::string>& values)
{
    std::vector<std::string> result;
    for (const std::string& word : words) result.push_back(filled_in_word(word, values));
    return result;
}

std::string describe(const ChildEnd& end)
{
    std::array<char, 64> text{};
    switch (end.how) {
    case ChildEnd::How::exited:
        return "exit status " + std::to_string(end.code);
    case ChildEnd::How::signalled:
        return "killed by signal " + std::to_string(end.code) + " (" + strsignal(end.code) + ")";
    case ChildEnd::How::timed_out:
        std::snprintf(text.data(), text.size(), "still running after %.3g s", end.seconds);
        return text.data();
    }
    throw std::logic_error("no such end");
}

ChildEnd run_child(const std::vector<std::string>& words, double limit_seconds,
                   const std::function<bool()>& stop)
{
    if (words.empty()) throw std::invalid_argument("there is no command to run");
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };

    Pipe output;
    const RunningChild child(words, output.ends[1]);
    const pid_t process = child.process();
    output.close_write();
    fcntl(output.ends[0], F_SETFL, O_NONBLOCK);

    ChildEnd end{ChildEnd::How::timed_out, 0, 0.0, ""};
    int status = 0;
    bool ended = false;
    for (bool open = true; !ended && seconds() < limit_seconds && !(stop && stop());) {
        // The end of the output is usually the end of the program: then it is seen at once.
        pollfd wait{output.ends[0], POLLIN, 0};
        if (open && poll(&wait, 1, 20) > 0)
            open = read_some(output.ends[0], end.last_lines) != 0;
        else if (!open)
            poll(nullptr, 0, 1);
        ended = waitpid(process, &status, WNOHANG) == process;
    }
    end.seconds = seconds();
    kill(-process, SIGKILL); // also what the program has left running
    if (!ended) waitpid(process, &status, 0);
    while (read_some(output.ends[0], end.last_lines) > 0) {
    } // all writers have been killed
    if (ended) {
        end.how = WIFEXITED(status) ? ChildEnd::How::exited : ChildEnd::How::signalled;
        end.code = WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status);
    }
    return end;
}

void kill_children()
{
    const std::lock_guard lock(all_children().mutex);
    all_children().are_over = true;
    for (const pid_t group : all_children().groups) {
        kill(-group, SIGKILL);
        // The group is there until the last of its processes has ended and run_child has asked for it.
        for (int i = 0; i < 1000 && kill(-group, 0) == 0; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

} // namespace check
