#pragma once

// Runs the program in a process of its own, as a user or a script does, and returns its output and exit
// status.

#include "tests/images/temporary_folder.h"

#include <fcntl.h>
#include <pty.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace cli_test {

using images_test::read_bytes;
using images_test::TemporaryFolder;
using images_test::write_bytes;
using Arguments = std::vector<std::string>;

inline std::string scene_file(const std::string& name)
{
    return (std::filesystem::path(PLUMBLINE_SOURCE_DIR) / "scenes" / (name + ".dae")).string();
}

inline Arguments operator+(Arguments a, const Arguments& b)
{
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

struct Outcome {
    int status; // exit status, or minus the signal that ended the process
    std::string out;
    std::string err;
};

/// How the process is started.
struct Surroundings {
    bool terminal = false;                // stdout and stderr are a terminal; Outcome::out holds both
    std::optional<rlim_t> largest_file{}; // bytes; larger files fail as on a full disk
    enum class Output { file, closed_pipe, full_disk, closed } output = Output::file; // stdout
    std::string program = PLUMBLINE_PROGRAM;
};

/// Waits until `condition` is true, for about 30 seconds, enough for a slow machine. Returns whether it
/// became true.
template <class Condition>
bool eventually(Condition condition)
{
    for (int i = 0; i < 3000; ++i) {
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
}

class Process {
public:
    explicit Process(const Arguments& arguments, const Surroundings& surroundings = {})
    {
        std::string program = surroundings.program;
        std::vector<std::string> texts = arguments;
        std::vector<char*> argv = {program.data()};
        for (std::string& text : texts) argv.push_back(text.data());
        argv.push_back(nullptr);
        const std::string out = (folder_ / "out").string();
        const std::string err = (folder_ / "err").string();

        pid_ = surroundings.terminal ? forkpty(&terminal_, nullptr, nullptr, nullptr) : fork();
        if (pid_ < 0) throw std::runtime_error("cannot start a process");
        if (pid_ > 0) {
            if (terminal_ >= 0) fcntl(terminal_, F_SETFL, O_NONBLOCK);
            return;
        }
        if (!surroundings.terminal) {
            dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
            dup2(open_output(surroundings.output, out), STDOUT_FILENO);
            dup2(open(err.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
            if (surroundings.output == Surroundings::Output::closed) close(STDOUT_FILENO);
        }
        if (surroundings.largest_file) {
            const rlimit limit{*surroundings.largest_file, *surroundings.largest_file};
            setrlimit(RLIMIT_FSIZE, &limit);
            std::signal(SIGXFSZ, SIG_IGN); // write() fails instead, as it does on a full disk
        }
        execv(program.c_str(), argv.data());
        _exit(127);
    }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;
    ~Process()
    {
        if (pid_ > 0) kill(pid_, SIGKILL), waitpid(pid_, nullptr, 0);
        if (terminal_ >= 0) close(terminal_);
    }

    void send(int signal) const { kill(pid_, signal); }

    /// Whether the process has installed a handler for `signal`.
    [[nodiscard]] bool catches(int signal) const { return has("SigCgt:", signal); }

    /// Whether `signal` is in this set of signals of the process (Linux: proc(5), status).
    [[nodiscard]] bool has(const std::string& set, int signal) const
    {
        std::ifstream status("/proc/" + std::to_string(pid_) + "/status");
        for (std::string word; status >> word;)
            if (word == set && status >> word)
                return (std::stoull(word, nullptr, 16) >> (signal - 1) & 1) != 0;
        return false;
    }

    /// CPU time of the process in user mode, in clock ticks (Linux: proc(5), utime).
    [[nodiscard]] long long used() const
    {
        std::ifstream stat("/proc/" + std::to_string(pid_) + "/stat");
        std::string word;
        for (int i = 0; i < 13; ++i) stat >> word; // the second field, the name, has no spaces
        long long ticks = 0;
        stat >> ticks;
        return ticks;
    }

    /// The text that was printed on the terminal so far.
    const std::string& printed()
    {
        std::array<char, 4096> some{};
        for (ssize_t n = 0; (n = read(terminal_, some.data(), some.size())) > 0;)
            on_terminal_.append(some.data(), static_cast<std::size_t>(n));
        return on_terminal_;
    }

    /// Waits until the process ends.
    Outcome finish()
    {
        int status = 0;
        if (terminal_ >= 0) // a terminal that is not read blocks the process that writes to it
            eventually([&] { return printed(), waitpid(pid_, &status, WNOHANG) != 0; });
        else
            waitpid(pid_, &status, 0);
        pid_ = 0;
        const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
        if (terminal_ >= 0) return {code, printed(), ""};
        const bool kept = std::filesystem::exists(folder_ / "out");
        return {code, kept ? read_bytes(folder_ / "out") : "", read_bytes(folder_ / "err")};
    }

private:
    /// The file descriptor for stdout. Called in the new process.
    static int open_output(Surroundings::Output output, const std::string& file)
    {
        if (output == Surroundings::Output::full_disk) return open("/dev/full", O_WRONLY);
        if (output != Surroundings::Output::closed_pipe)
            return open(file.c_str(), O_WRONLY | O_CREAT, 0600);
        std::array<int, 2> ends{}; // read, write
        if (pipe(ends.data()) != 0) _exit(127);
        close(ends[0]);
        return ends[1];
    }

    TemporaryFolder folder_;
    pid_t pid_ = 0;
    int terminal_ = -1;
    std::string on_terminal_;
};

inline Outcome run(const Arguments& arguments, const Surroundings& surroundings = {})
{
    return Process(arguments, surroundings).finish();
}

} // namespace cli_test
