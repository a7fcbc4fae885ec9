// Attempts as processes of this machine. The supervisor holds the attempt's lock, which the
// kernel frees however it dies: whether an attempt lives is therefore asked of the lock, never of
// a process number, which another process may have by now. The calls come from the dispatcher's
// thread. Supervisors have a session of their own and outlive a killed service; the next one
// adopts them.
#include "services/orchestrator/executors/local_executor.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstring>

#include "core/fault/fault.hpp"
#include "services/orchestrator/executors/process_tree.hpp"

namespace breach::orchestrator {

namespace {

constexpr int lock_descriptor = 3;  // in the supervisor and its descendants

struct FileActions {
    posix_spawn_file_actions_t value{};
    FileActions() { posix_spawn_file_actions_init(&value); }
    ~FileActions() { posix_spawn_file_actions_destroy(&value); }
    FileActions(const FileActions&) = delete;
    FileActions& operator=(const FileActions&) = delete;
};

struct Attributes {
    posix_spawnattr_t value{};
    Attributes() { posix_spawnattr_init(&value); }
    ~Attributes() { posix_spawnattr_destroy(&value); }
    Attributes(const Attributes&) = delete;
    Attributes& operator=(const Attributes&) = delete;
};

/// The mark is inherited by every descendant, so that kill_marked_processes finds them even after
/// a supervisor was killed.
std::vector<std::string> marked_environment(const std::string& attempt) {
    std::vector<std::string> entries{std::string(attempt_mark) + "=" + attempt};
    for (char** entry = environ; *entry != nullptr; ++entry) {
        if (!std::string_view(*entry).starts_with(attempt_mark)) entries.emplace_back(*entry);
    }
    return entries;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> all;
    for (std::string& each : texts) all.push_back(each.data());
    all.push_back(nullptr);
    return all;
}

}  // namespace

LocalExecutor::LocalExecutor(std::filesystem::path self) : self_(std::move(self)) {}

void LocalExecutor::submit(const AttemptFolder& folder, const Order& order) {
    reap();
    std::filesystem::create_directories(folder.root);
    // The supervisor inherits this lock, so that the attempt is never started without a lock.
    const auto lock = FileLock::try_take(folder.lock());
    if (!lock)
        throw fault::IoError(folder.lock().string() + ": is held; the attempt was started before");
    // With the lock held, no supervisor writes there. A leftover exit record would be read as
    // this attempt's.
    remove_remains(folder);
    write_order(folder, order);

    FileActions actions;
    posix_spawn_file_actions_addopen(&actions.value, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions.value, STDOUT_FILENO, folder.log().c_str(),
                                     O_WRONLY | O_CREAT | O_APPEND, 0644);
    posix_spawn_file_actions_adddup2(&actions.value, STDOUT_FILENO, STDERR_FILENO);
    posix_spawn_file_actions_adddup2(&actions.value, lock->descriptor(), lock_descriptor);
    // Otherwise the supervisor would keep the database and sockets of the service open.
    posix_spawn_file_actions_addclosefrom_np(&actions.value, lock_descriptor + 1);

    Attributes attributes;
    sigset_t none{};
    sigemptyset(&none);
    sigset_t all{};
    sigfillset(&all);
    // The service blocks SIGINT and SIGTERM and ignores SIGPIPE; the phases need them.
    posix_spawnattr_setsigmask(&attributes.value, &none);
    posix_spawnattr_setsigdefault(&attributes.value, &all);
    posix_spawnattr_setflags(
        &attributes.value,
        static_cast<short>(POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF));

    std::vector<std::string> arguments{self_.string(), "supervise", folder.root.string()};
    std::vector<std::string> environment = marked_environment(order.attempt);
    pid_t pid = 0;
    const int code = posix_spawn(&pid, self_.c_str(), &actions.value, &attributes.value,
                                 pointers(arguments).data(), pointers(environment).data());
    if (code != 0)
        throw fault::IoError(self_.string() + ": cannot be started: " + std::strerror(code));
    supervisors_.push_back({pid, folder, order.attempt});
}

Vitals LocalExecutor::probe(const AttemptFolder& folder) {
    reap();
    if (std::filesystem::exists(folder.exit_record())) return {Life::ended};
    if (is_held(folder.lock())) return {Life::alive};
    // It may have ended after the probe of its lock.
    if (std::filesystem::exists(folder.exit_record())) return {Life::ended};
    return {Life::gone, "its process vanished without an exit record"};
}

void LocalExecutor::stop(const AttemptFolder& folder, StopReason reason) {
    write_stop(folder, reason);
}

void LocalExecutor::clear_away(const AttemptFolder&, const std::string& attempt) {
    kill_marked_processes(attempt);
}

void LocalExecutor::reap() {
    std::erase_if(supervisors_, [this](const Supervisor& each) {
        if (waitpid(each.pid, nullptr, WNOHANG) == 0) return false;
        // A killed supervisor leaves its phase's processes running.
        std::error_code error;
        if (!std::filesystem::exists(each.folder.exit_record(), error))
            clear_away(each.folder, each.attempt);
        return true;
    });
}

}  // namespace breach::orchestrator
