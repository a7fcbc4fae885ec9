// Reads /proc. The supervisor uses descendants() and usage_of(); the local executor and
// `supervise --end-strays` use the mark in the environment, which is the only trace of an attempt
// whose supervisor is gone and whose processes init has adopted.
#include "services/orchestrator/executors/process_tree.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <thread>

#include "services/orchestrator/executors/order.hpp"

namespace breach::orchestrator {

namespace {

std::vector<pid_t> all_processes() {
    std::vector<pid_t> found;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator("/proc", error)) {
        const std::string name = entry.path().filename();
        pid_t pid = 0;
        const auto parsed = std::from_chars(name.data(), name.data() + name.size(), pid);
        if (parsed.ec == std::errc{} && parsed.ptr == name.data() + name.size())
            found.push_back(pid);
    }
    return found;
}

/// The fields after the name in /proc/PID/stat; nothing: the process is gone.
std::istringstream stat_of(pid_t pid) {
    std::ifstream stream("/proc/" + std::to_string(pid) + "/stat");
    std::string line;
    std::getline(stream, line);
    const std::size_t after_name = line.rfind(')');  // the name may contain ")"
    return std::istringstream(after_name == std::string::npos ? "" : line.substr(after_name + 1));
}

/// Parent of a living process; 0 when it is gone or only a zombie.
pid_t parent_of(pid_t pid) {
    std::istringstream fields = stat_of(pid);
    char state = 'Z';
    pid_t parent = 0;
    fields >> state >> parent;
    return state == 'Z' || state == 'X' ? 0 : parent;
}

}  // namespace

std::vector<pid_t> descendants(pid_t root) {
    std::multimap<pid_t, pid_t> children;
    for (const pid_t pid : all_processes()) children.emplace(parent_of(pid), pid);
    std::vector<pid_t> found;
    std::vector<pid_t> open{root};
    while (!open.empty()) {
        const auto [first, last] = children.equal_range(open.back());
        open.pop_back();
        for (auto child = first; child != last; ++child) {
            found.push_back(child->second);
            open.push_back(child->second);
        }
    }
    return found;
}

Usage usage_of(pid_t pid) {
    constexpr int before_utime = 11;  // fields after the name (proc(5))
    constexpr int before_rss = 8;     // between stime and rss
    std::istringstream fields = stat_of(pid);
    std::string skipped;
    double user = 0.0;
    double kernel = 0.0;
    double pages = 0.0;
    for (int i = 0; i < before_utime; ++i) fields >> skipped;
    fields >> user >> kernel;
    for (int i = 0; i < before_rss; ++i) fields >> skipped;
    fields >> pages;
    if (!fields) return {};
    return {.cpu_seconds = (user + kernel) / static_cast<double>(sysconf(_SC_CLK_TCK)),
            .memory_mb = static_cast<std::int64_t>(1e-6 * pages *
                                                   static_cast<double>(sysconf(_SC_PAGESIZE)))};
}

std::string host_name() {
    std::array<char, 256> name{};
    if (gethostname(name.data(), name.size() - 1) != 0) return "";
    return name.data();
}

namespace {

struct Marked {
    std::vector<pid_t> processes;
    bool unsure = false;  ///< a process could not be examined
};

/// A process in the middle of exec shows no environment but has a program; a kernel thread has
/// neither.
bool is_between_programs(pid_t pid) {
    std::error_code error;
    const auto program =
        std::filesystem::read_symlink("/proc/" + std::to_string(pid) + "/exe", error);
    return !program.empty() && parent_of(pid) != 0;
}

Marked marked_processes(const std::string& attempt) {
    const std::string mark = std::string(attempt_mark) + "=" + attempt;
    Marked found;
    for (const pid_t pid : all_processes()) {
        std::ifstream stream("/proc/" + std::to_string(pid) + "/environ", std::ios::binary);
        std::string entry;
        bool has_any = !stream.is_open();  // not readable: another user's, or gone
        while (std::getline(stream, entry, '\0')) {
            has_any = true;
            if (entry != mark) continue;
            found.processes.push_back(pid);
            break;
        }
        if (!has_any && is_between_programs(pid)) found.unsure = true;
    }
    return found;
}

}  // namespace

void kill_marked_processes(const std::string& attempt) {
    constexpr int most_waits = 100;  // limit for a process without any environment
    constexpr auto wait = std::chrono::milliseconds(1);
    // Itself first: `--end-strays` carries the mark of the attempt that it ends.
    std::set<pid_t> killed{getpid()};
    // A process may fork before it is killed: repeat until there are no new ones.
    int waits = 0;
    for (bool again = true; again;) {
        again = false;
        const Marked marked = marked_processes(attempt);
        for (const pid_t pid : marked.processes) {
            if (!killed.insert(pid).second) continue;
            kill(pid, SIGKILL);
            again = true;
        }
        if (again || !marked.unsure || waits++ == most_waits) continue;
        std::this_thread::sleep_for(wait);
        again = true;
    }
}

}  // namespace breach::orchestrator
