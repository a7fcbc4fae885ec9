#include "services/orchestrator/executors/process_tree.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

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

/// What stands behind the name in /proc/PID/stat; nothing when it is gone.
std::istringstream stat_of(pid_t pid) {
    std::ifstream stream("/proc/" + std::to_string(pid) + "/stat");
    std::string line;
    std::getline(stream, line);
    const std::size_t after_name = line.rfind(')');  // the name may hold anything, even ")"
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
    constexpr int before_utime = 11;  // of what stands behind the name (proc(5))
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

static std::vector<pid_t> marked_processes(const std::string& attempt) {
    const std::string mark = std::string(attempt_mark) + "=" + attempt;
    std::vector<pid_t> found;
    for (const pid_t pid : all_processes()) {
        std::ifstream stream("/proc/" + std::to_string(pid) + "/environ", std::ios::binary);
        std::string entry;
        while (std::getline(stream, entry, '\0')) {
            if (entry != mark) continue;
            found.push_back(pid);
            break;
        }
    }
    return found;
}

void kill_marked_processes(const std::string& attempt) {
    std::set<pid_t> killed{getpid()};
    // Who is killed may have forked after the look that found it: looked again until nobody is new.
    for (bool again = true; again;) {
        again = false;
        for (const pid_t pid : marked_processes(attempt)) {
            if (!killed.insert(pid).second) continue;
            kill(pid, SIGKILL);
            again = true;
        }
    }
}

}  // namespace breach::orchestrator
