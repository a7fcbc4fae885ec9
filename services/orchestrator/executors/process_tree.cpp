#include "services/orchestrator/executors/process_tree.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <map>
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

/// Parent of a living process; 0 when it is gone or only a zombie.
pid_t parent_of(pid_t pid) {
    std::ifstream stream("/proc/" + std::to_string(pid) + "/stat");
    std::string line;
    if (!std::getline(stream, line)) return 0;
    const std::size_t after_name = line.rfind(')');  // the name may hold anything, even ")"
    if (after_name == std::string::npos) return 0;
    std::istringstream fields(line.substr(after_name + 1));
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

std::vector<pid_t> marked_processes(const std::string& attempt) {
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

}  // namespace breach::orchestrator
