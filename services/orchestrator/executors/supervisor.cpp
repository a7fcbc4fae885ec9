// The process between executor and phase, started as `breachline supervise FOLDER` by the local
// executor or a Slurm script. It holds the attempt's lock, takes the task's fence, starts the
// phase, passes a stop on, ends all that the phase leaves, and writes the exit record last. If it
// is killed, the phase dies with it (PDEATHSIG), no record appears, and the executor counts the
// attempt as lost.
#include "services/orchestrator/executors/supervisor.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <optional>
#include <thread>

#include "core/fault/fault.hpp"
#include "services/orchestrator/executors/order.hpp"
#include "services/orchestrator/executors/process_tree.hpp"
#include "services/orchestrator/files/failpoint.hpp"
#include "services/orchestrator/files/folder_watch.hpp"

namespace breach::orchestrator {

namespace {

using Clock = std::chrono::steady_clock;

/// The shell's exit code for a command that is not found.
constexpr int cannot_execute = 127;
constexpr auto pause = std::chrono::milliseconds(20);
constexpr auto heartbeat_interval = std::chrono::seconds(2);
constexpr std::uintmax_t least_free_bytes = 1 << 16;  // a phase stops with less

/// Every process of the attempt inherits the lock and holds it until the last one ends.
FileLock held_by_all_below(FileLock lock) {
    fcntl(lock.descriptor(), F_SETFD, 0);
    return lock;
}

class Supervision {
  public:
    explicit Supervision(AttemptFolder folder)
        : folder_(std::move(folder)), order_(read_order(folder_)), began_(Clock::now()) {
        prctl(PR_SET_CHILD_SUBREAPER, 1);  // adopt daemonised descendants
        sigemptyset(&signals_);
        for (const int signal : {SIGCHLD, SIGTERM, SIGINT, SIGHUP}) sigaddset(&signals_, signal);
        sigprocmask(SIG_BLOCK, &signals_, nullptr);
        signal_descriptor_ = signalfd(-1, &signals_, SFD_CLOEXEC | SFD_NONBLOCK);
        watch_.add(folder_.root, Notice::published_files);
    }

    void run() {
        if (!wait_for_fence()) return give_back();
        pass_failpoint("supervisor_before_phase");
        start();
        while (!phase_ended_) {
            beat();
            look_for_stop();
            send_signals();
            wait_a_little();
            reap();
        }
        // Before the record: whoever reads it may start the next attempt in the same output
        // folder.
        kill_the_rest();
        pass_failpoint("supervisor_after_phase");
        record_exit();
        pass_failpoint("supervisor_after_record");
    }

  private:
    /// Ensures one phase of a task at a time, even if an earlier attempt seemed to be over.
    /// False: a stop was requested before.
    bool wait_for_fence() {
        while (true) {
            beat();
            record_.stopped = asked_to_stop();
            if (record_.stopped) return false;
            if (auto fence = FileLock::try_take(folder_.fence())) {
                fence_ = held_by_all_below(std::move(*fence));
                return true;
            }
            wait_a_little();
        }
    }

    /// For a phase that was not started. An abandoned attempt gets no record.
    void give_back() {
        if (record_.stopped != StopReason::revoked) record_exit();
    }

    /// Heartbeat for a service on another machine, where locks may be invisible; it also records
    /// the cost of an attempt that is lost.
    void beat() {
        if (Clock::now() < next_beat_) return;
        next_beat_ = Clock::now() + heartbeat_interval;
        const Usage usage = phase_ > 0 ? usage_of(phase_) : Usage{};
        write_heartbeat(folder_, {.host = host_name(),
                                  .pid = std::max<std::int64_t>(phase_, 0),
                                  .cpu_seconds = usage.cpu_seconds,
                                  .memory_mb = usage.memory_mb});
    }

    void start() {
        phase_ = fork();
        if (phase_ == 0) become_the_phase();
        if (phase_ > 0) return;
        std::cerr << "supervise: fork: " << std::strerror(errno) << "\n";
        record_.exit_code = static_cast<int>(fault::ExitCode::try_again);
        phase_ended_ = true;
    }

    /// Between fork and exec: own process group, dies with the supervisor, output into its files.
    [[noreturn]] void become_the_phase() {
        setpgid(0, 0);
        // Does not reach the phase's own children: these the executor finds by their mark.
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        sigprocmask(SIG_UNBLOCK, &signals_, nullptr);
        const int lines =
            open(folder_.lines().c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
        dup2(lines, STDOUT_FILENO);
        std::vector<char*> arguments{const_cast<char*>(order_.program.c_str())};
        for (std::string& each : order_.arguments) arguments.push_back(each.data());
        arguments.push_back(nullptr);
        execv(order_.program.c_str(), arguments.data());
        std::fprintf(stderr, "%s: cannot be started: %s\n", order_.program.c_str(),
                     std::strerror(errno));
        _exit(cannot_execute);
    }

    /// The stop file has the reason; a signal alone has none.
    std::optional<StopReason> asked_to_stop() const {
        const auto reason = read_stop(folder_);
        if (reason || !asked_by_signal_) return reason;
        return StopReason::signal;
    }

    void look_for_stop() {
        if (record_.stopped) return;
        record_.stopped = asked_to_stop();
        if (record_.stopped)
            kill_at_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                          std::chrono::duration<double>(order_.grace_seconds));
    }

    /// Sends TERM once to the phase's group, and KILL to all descendants after the grace time.
    void send_signals() {
        if (!record_.stopped) return;
        if (!termed_) {
            kill(-phase_, SIGTERM);
            kill(-phase_, SIGCONT);  // a stopped process must continue to end
            termed_ = true;
        } else if (Clock::now() >= kill_at_) {
            for (const pid_t each : descendants(getpid())) kill(each, SIGKILL);
        }
    }

    void wait_a_little() {
        pollfd wanted[] = {{signal_descriptor_, POLLIN, 0}, {watch_.descriptor(), POLLIN, 0}};
        poll(wanted, 2, record_.stopped || !fence_ ? 50 : 1000);
        signalfd_siginfo info{};
        while (read(signal_descriptor_, &info, sizeof info) == sizeof info) {
            if (info.ssi_signo != SIGCHLD) asked_by_signal_ = true;
        }
        watch_.changes();
    }

    void reap() {
        int status = 0;
        rusage used{};
        pid_t pid = 0;
        while ((pid = wait4(-1, &status, WNOHANG, &used)) > 0) {
            if (pid != phase_) continue;
            phase_ended_ = true;
            if (WIFEXITED(status)) record_.exit_code = WEXITSTATUS(status);
            if (WIFSIGNALED(status)) record_.signal = WTERMSIG(status);
            record_.cpu_seconds = seconds(used.ru_utime) + seconds(used.ru_stime);
        }
    }

    static double seconds(const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    }

    /// Ends everything that the phase left running.
    void kill_the_rest() {
        while (true) {
            for (const pid_t each : descendants(getpid())) kill(each, SIGKILL);
            int status = 0;
            const pid_t pid = waitpid(-1, &status, WNOHANG);
            if (pid < 0) return;
            if (pid == 0) std::this_thread::sleep_for(pause);
        }
    }

    /// A full disk must not lose the exit record: retries with the lock held. The record keeps the
    /// cause, which the log cannot hold: its last line is cut off. A deleted folder gets no record.
    void record_exit() {
        record_.attempt = order_.attempt;
        record_.wall_seconds = std::chrono::duration<double>(Clock::now() - began_).count();
        std::error_code error;
        const auto space = std::filesystem::space(folder_.root, error);
        if (!error && space.available < least_free_bytes)
            record_.disk = "the disk of " + folder_.root.string() + " is full";
        while (std::filesystem::exists(folder_.root)) {
            try {
                write_exit_record(folder_, record_);
                return;
            } catch (const fault::IoError& failure) {
                record_.disk = failure.what();
                std::cerr << "supervise: " << failure.what() << "; trying again\n";
                std::this_thread::sleep_for(std::chrono::seconds(1));
            }
        }
    }

    AttemptFolder folder_;
    Order order_;
    Clock::time_point began_;
    sigset_t signals_{};
    int signal_descriptor_ = -1;
    FolderWatch watch_;
    pid_t phase_ = -1;
    bool phase_ended_ = false;
    bool asked_by_signal_ = false;
    bool termed_ = false;
    Clock::time_point kill_at_{};
    Clock::time_point next_beat_{};
    std::optional<FileLock> fence_;
    ExitRecord record_;
};

}  // namespace

int supervise(const std::filesystem::path& root, AttemptLock wanted) {
    try {
        const AttemptFolder folder{root};
        std::optional<FileLock> lock;
        if (wanted == AttemptLock::to_be_taken) {
            lock = FileLock::try_take(folder.lock());
            if (!lock || std::filesystem::exists(folder.exit_record())) return 0;
            lock = held_by_all_below(std::move(*lock));
        }
        Supervision(folder).run();
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "supervise: " << error.what() << "\n";
        return static_cast<int>(fault::ExitCode::io);
    }
}

void end_strays(const std::filesystem::path& root) {
    const AttemptFolder folder{root};
    kill_marked_processes(read_order(folder).attempt);
}

}  // namespace breach::orchestrator
