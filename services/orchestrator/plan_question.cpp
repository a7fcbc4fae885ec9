#include "services/orchestrator/plan_question.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>
#include <utility>

#include "core/exchange/publish.hpp"
#include "core/fault/fault.hpp"
#include "services/orchestrator/identity.hpp"

namespace breach::orchestrator {

using Clock = std::chrono::steady_clock;

namespace {

constexpr auto longest_answer = std::chrono::seconds(20);
constexpr std::size_t most_bytes = 1 << 20;

constexpr std::array<std::pair<const char*, const char*>, 4> phases_by_part{
    {{"lem", "lem_tool"},
     {"fem", "fem_solver"},
     {"transfer", "transfer_tool"},
     {"mpm", "mpm_solver"}}};

/// A pipe whose reading end does not leak into children.
struct Pipe {
    std::array<int, 2> ends{-1, -1};
    Pipe() {
        if (pipe2(ends.data(), O_CLOEXEC) != 0)
            throw fault::IoError(std::string("pipe: ") + std::strerror(errno));
    }
    ~Pipe() {
        for (const int end : ends) {
            if (end >= 0) close(end);
        }
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    void close_writing_end() { close(std::exchange(ends[1], -1)); }
};

pid_t start(const std::filesystem::path& program, const std::filesystem::path& scene, int output) {
    posix_spawn_file_actions_t actions{};
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);
    std::array<std::string, 3> words{program.string(), scene.string(), "--plan"};
    std::array<char*, 4> arguments{words[0].data(), words[1].data(), words[2].data(), nullptr};
    pid_t pid = 0;
    const int code =
        posix_spawn(&pid, program.c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (code != 0)
        throw fault::IoError(program.string() + ": cannot be started: " + std::strerror(code));
    return pid;
}

/// What the program prints until it ends; killed when it takes or says too much.
std::string answer_of(const std::filesystem::path& program, const std::filesystem::path& scene) {
    Pipe pipe;
    const pid_t pid = start(program, scene, pipe.ends[1]);
    pipe.close_writing_end();
    const auto deadline = Clock::now() + longest_answer;
    std::string text;
    bool ended = false;
    while (!ended && Clock::now() < deadline && text.size() < most_bytes) {
        pollfd wanted{pipe.ends[0], POLLIN, 0};
        if (poll(&wanted, 1, 200) <= 0) continue;
        std::array<char, 4096> buffer{};
        const ssize_t size = read(pipe.ends[0], buffer.data(), buffer.size());
        ended = size <= 0;
        if (size > 0) text.append(buffer.data(), static_cast<std::size_t>(size));
    }
    if (!ended) kill(pid, SIGKILL);
    int status = 0;
    waitpid(pid, &status, 0);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        throw fault::IoError(program.filename().string() + " --plan did not answer");
    return text;
}

struct ScratchFile {
    std::filesystem::path path;
    ~ScratchFile() {
        std::error_code error;
        std::filesystem::remove(path, error);
    }
};

}  // namespace

nlohmann::json plans_of(const nlohmann::json& scene, const std::filesystem::path& bin,
                        const std::filesystem::path& scratch) {
    const ScratchFile file{scratch / (new_run_id() + ".json")};
    exchange::publish_text(file.path, scene.dump());
    nlohmann::json plans = nlohmann::json::object();
    for (const auto& [part, phase] : phases_by_part) {
        if (scene.contains(part)) plans[phase] = answer_of(bin / phase, file.path);
    }
    return plans;
}

}  // namespace breach::orchestrator
