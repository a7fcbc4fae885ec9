#include "core/command/command.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <csignal>
#include <cstring>
#include <thread>
#include <utility>

#include "core/fault/fault.hpp"

namespace breach::command {

using Clock = std::chrono::steady_clock;

namespace {

constexpr std::size_t most_bytes = 64 << 20;  // enough for the queue of a busy cluster

/// A pipe that other child processes do not inherit.
struct Pipe {
    std::array<int, 2> ends{-1, -1};
    Pipe() {
        if (pipe2(ends.data(), O_CLOEXEC) != 0)
            throw fault::IoError(std::string("pipe: ") + std::strerror(errno));
    }
    ~Pipe() {
        for (std::size_t i = 0; i < ends.size(); ++i) shut(i);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    void shut(std::size_t end) {
        if (ends[end] >= 0) close(std::exchange(ends[end], -1));
    }
};

/// Starts the program in its own process group, to kill its children with it.
pid_t start(std::vector<std::string>& words, const Pipe& in, const Pipe& out, const Pipe& err) {
    posix_spawn_file_actions_t actions{};
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, in.ends[0], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, out.ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, err.ends[1], STDERR_FILENO);
    posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);
    posix_spawnattr_t attributes{};
    posix_spawnattr_init(&attributes);
    sigset_t none{};
    sigemptyset(&none);
    sigset_t all{};
    sigfillset(&all);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(
        &attributes,
        static_cast<short>(POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF));
    std::vector<char*> arguments;
    for (std::string& each : words) arguments.push_back(each.data());
    arguments.push_back(nullptr);
    pid_t pid = 0;
    const int code =
        posix_spawnp(&pid, words[0].c_str(), &actions, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (code != 0) throw fault::IoError(words[0] + ": cannot be started: " + std::strerror(code));
    return pid;
}

/// Reads what is available; closes the pipe at its end.
void drain(Pipe& pipe, short happened, std::string& text) {
    if ((happened & (POLLIN | POLLHUP | POLLERR)) == 0) return;
    std::array<char, 1 << 16> buffer{};
    const ssize_t size = read(pipe.ends[0], buffer.data(), buffer.size());
    if (size <= 0) return pipe.shut(0);
    text.append(buffer.data(), static_cast<std::size_t>(size));
}

struct End {
    int status = 0;
    rusage spent{};
};

/// Waits for the process until the deadline, then kills its process group: a process that has
/// closed its output may still run.
End end_of(pid_t pid, Clock::time_point deadline) {
    constexpr auto pause = std::chrono::milliseconds(2);
    End end;
    while (true) {
        const pid_t ended = wait4(pid, &end.status, WNOHANG, &end.spent);
        if (ended == pid) return end;
        if (Clock::now() >= deadline) break;
        std::this_thread::sleep_for(pause);
    }
    kill(-pid, SIGKILL);
    wait4(pid, &end.status, 0, &end.spent);
    return end;
}

double seconds(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

Result run(std::vector<std::string> words, const std::string& input,
           std::chrono::milliseconds longest) {
    assert(input.size() <= 60000);
    Pipe in, out, err;
    const pid_t pid = start(words, in, out, err);
    in.shut(0);
    out.shut(1);
    err.shut(1);
    if (!input.empty() && write(in.ends[1], input.data(), input.size()) < 0) {
        // The process closed its input: its output and exit code say why.
    }
    in.shut(1);

    Result result;
    const auto deadline = Clock::now() + longest;
    while (out.ends[0] >= 0 || err.ends[0] >= 0) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
        if (left.count() <= 0 || result.out.size() + result.err.size() > most_bytes) break;
        pollfd wanted[] = {{out.ends[0], POLLIN, 0}, {err.ends[0], POLLIN, 0}};
        if (poll(wanted, 2, static_cast<int>(left.count())) <= 0) continue;
        drain(out, wanted[0].revents, result.out);
        drain(err, wanted[1].revents, result.err);
    }
    const bool silent = out.ends[0] < 0 && err.ends[0] < 0;
    const auto [status, spent] = end_of(pid, silent ? deadline : Clock::now());
    if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
    result.cpu_seconds = seconds(spent.ru_utime) + seconds(spent.ru_stime);
    return result;
}

}  // namespace breach::command
