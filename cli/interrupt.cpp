#include "cli/interrupt.h"

#include "check/child_program.h"
#include "images/temporary_folder.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <thread>

namespace cli {

namespace {

std::atomic<bool> requested = false;
std::atomic<int> wake_up = -1; // the end of a pipe, to write the second signal to
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "a signal handler may touch nothing else");

void on_both(void (*handler)(int))
{
    struct sigaction action = {};
    action.sa_handler = handler;
    for (const int signal : {SIGINT, SIGTERM}) sigaddset(&action.sa_mask, signal);
    for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
}

/// Calls only what a signal handler may call (signal-safety(7)).
void handle(int signal)
{
    if (!requested.exchange(true)) return;
    on_both(SIG_IGN);
    alarm(5); // its signal ends the program
    const auto byte = static_cast<char>(signal);
    if (write(wake_up, &byte, 1) != 1) _exit(128 + signal);
}

/// Waits for the second signal, in a thread of its own: a signal handler could remove no folder.
void end_at_second_signal(int pipe)
{
    char signal = 0;
    while (read(pipe, &signal, 1) != 1) {
    }
    check::kill_children();
    images::remove_temporary_folders();
    std::signal(signal, SIG_DFL); // the shell sees by which signal the program has ended
    kill(getpid(), signal);
}

} // namespace

void catch_interrupts()
{
    std::array<int, 2> ends{}; // read, write
    if (pipe2(ends.data(), O_CLOEXEC) == 0) {
        wake_up = ends[1];
        std::thread(end_at_second_signal, ends[0]).detach();
    }
    on_both(handle);
}

bool interrupt_requested()
{
    return requested;
}

} // namespace cli
