#include "tests/faults/service_under_test.hpp"

#include <fcntl.h>
#include <httplib.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace breach::testing {

using nlohmann::json;
namespace fs = std::filesystem;

namespace {

std::string text_of(const fs::path& file) {
    std::ifstream stream(file);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

Answer answer_of(const httplib::Result& result) {
    Answer answer;
    if (!result) return answer;
    answer.status = result->status;
    answer.text = result->body;
    answer.body = json::parse(result->body, nullptr, false);
    for (const auto& [name, value] : result->headers) answer.headers.emplace(name, value);
    return answer;
}

/// Folder of the programs; BREACH_BIN in the environment takes precedence over the build's.
fs::path built_programs() {
    const char* elsewhere = std::getenv("BREACH_BIN");
    return elsewhere == nullptr ? BREACH_BIN : elsewhere;
}

httplib::Client client(int port) {
    httplib::Client made("127.0.0.1", port);
    made.set_read_timeout(60);
    return made;
}

}  // namespace

Sandbox::Sandbox() {
    std::string pattern = fs::temp_directory_path() / "breachline-test-XXXXXX";
    root_ = mkdtemp(pattern.data());
    fs::create_directories(bin());
    for (const char* phase : {"lem_tool", "fem_solver", "transfer_tool", "mpm_solver"})
        fs::create_symlink(built_programs() / "fake_phase", bin() / phase);
}

Sandbox::~Sandbox() {
    if (std::getenv("BREACH_KEEP_SANDBOX") != nullptr) return;
    std::error_code error;
    fs::remove_all(root_, error);
}

std::map<std::string, int> Sandbox::successes() const {
    std::map<std::string, int> counts;
    std::istringstream lines(text_of(root_ / "ledger"));
    for (std::string line; std::getline(lines, line);) ++counts[line];
    return counts;
}

Service::Service(const Sandbox& sandbox, std::vector<std::string> more_arguments,
                 std::vector<std::string> more_environment) {
    std::vector<std::string> words{built_programs() / "breachline",
                                   "serve",
                                   "--data",
                                   sandbox.data(),
                                   "--bin",
                                   sandbox.bin(),
                                   "--port",
                                   "0",
                                   "--slots",
                                   "3",
                                   "--grace",
                                   "0.3",
                                   "--retry-delay",
                                   "0.05"};
    words.insert(words.end(), more_arguments.begin(), more_arguments.end());
    std::vector<char*> arguments;
    for (std::string& each : words) arguments.push_back(each.data());
    arguments.push_back(nullptr);
    std::vector<char*> environment;
    for (std::string& each : more_environment) environment.push_back(each.data());
    for (char** each = environ; *each != nullptr; ++each) environment.push_back(*each);
    environment.push_back(nullptr);

    const fs::path log = sandbox.root() / "service.log";
    fs::remove(log);
    std::array<int, 2> pipe_ends{};
    if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("pipe");
    posix_spawn_file_actions_t actions{};
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, log.c_str(), O_WRONLY | O_CREAT,
                                     0644);
    posix_spawn(&pid_, words[0].c_str(), &actions, nullptr, arguments.data(), environment.data());
    posix_spawn_file_actions_destroy(&actions);
    close(pipe_ends[1]);
    std::string line;
    for (char each = 0; read(pipe_ends[0], &each, 1) == 1 && each != '\n';) line += each;
    close(pipe_ends[0]);
    const json said = json::parse(line, nullptr, false);
    if (said.is_object()) {
        port_ = said.at("port");
        return;
    }
    end_with(0);
    complaint_ = text_of(log);
}

Service::~Service() {
    if (pid_ > 0) terminate();
}

void Service::end_with(int signal) {
    if (signal != 0) kill(pid_, signal);
    int status = 0;
    waitpid(pid_, &status, 0);
    if (WIFEXITED(status)) exit_code_ = WEXITSTATUS(status);
    pid_ = -1;
}

void Service::kill_at_once() { end_with(SIGKILL); }
void Service::terminate() { end_with(SIGTERM); }

Answer Service::get(const std::string& path,
                    const std::multimap<std::string, std::string>& headers) {
    return answer_of(client(port_).Get(path, httplib::Headers(headers.begin(), headers.end())));
}

Answer Service::post(const std::string& path, const std::string& body, const std::string& type,
                     const std::multimap<std::string, std::string>& headers) {
    return answer_of(
        client(port_).Post(path, httplib::Headers(headers.begin(), headers.end()), body, type));
}

Answer Service::ask(const std::string& method, const std::string& path) {
    auto http = client(port_);
    httplib::Request request;
    request.method = method;
    request.path = path;
    return answer_of(http.send(request));
}

std::string Service::submit(const json& study) {
    const Answer answer = post("/v1/runs", study.dump());
    if (answer.status != 202)
        throw std::runtime_error("submit: " + std::to_string(answer.status) + " " + answer.text);
    return answer.body.at("id");
}

json Service::wait_for_end(const std::string& run, double seconds) {
    json body;
    eventually(
        [&] {
            const Answer answer = get("/v1/runs/" + run);
            if (answer.status == 200) body = answer.body;
            return body.is_object() && !body.at("finished").is_null();
        },
        seconds);
    return body;
}

json Service::table(const std::string& run) {
    json rows = get("/v1/runs/" + run + "/results").body.at("rows");
    for (json& row : rows) {
        row.erase("transfer_task");
        row.erase("mpm_task");
    }
    return rows;
}

bool eventually(const std::function<bool()>& condition, double seconds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return true;
}

json study(const std::string& title, const std::vector<double>& times) {
    json scene = json::parse(text_of(fs::path(BREACH_ROOT) / "workflows/scenes/slope.json"));
    scene["title"] = title;
    return {{"format", "breachline-study/1"},
            {"name", "test"},
            {"title", "a study of the tests"},
            {"scene", scene},
            {"transfer_times", times}};
}

const json& task_labelled(const json& run, const std::string& label) {
    for (const json& task : run.at("tasks"))
        if (task.at("label") == label) return task;
    throw std::runtime_error("no task " + label + " in " + run.dump());
}

namespace {

std::string program_of(const std::string& pid) {
    const std::string command = text_of("/proc/" + pid + "/cmdline");
    return command.substr(0, command.find('\0'));
}

/// Text after the name in /proc/PID/stat, "state parent ..."; empty without such a process.
std::string status_of(const std::string& pid) {
    const std::string stat = text_of("/proc/" + pid + "/stat");
    const auto after_name = stat.rfind(')');
    return after_name == std::string::npos ? "" : stat.substr(after_name + 2);
}

/// A process may temporarily have a copy: the leak checker's.
bool is_twin(const std::string& pid) {
    const std::string status = status_of(pid);
    if (status.empty()) return false;
    const std::string parent = status.substr(2, status.find(' ', 2) - 2);
    return program_of(parent) == program_of(pid);
}

}  // namespace

std::vector<pid_t> phases_alive(const Sandbox& sandbox, const std::string& phase) {
    std::vector<pid_t> found;
    const std::string program = sandbox.bin() / phase;
    for (const auto& entry : fs::directory_iterator("/proc")) {
        const std::string name = entry.path().filename();
        if (name.find_first_not_of("0123456789") != std::string::npos) continue;
        if (program_of(name) == program && !is_twin(name)) found.push_back(std::stoi(name));
    }
    return found;
}

bool is_alive(pid_t pid) {
    const std::string status = status_of(std::to_string(pid));
    return !status.empty() && status.front() != 'Z';
}

}  // namespace breach::testing
