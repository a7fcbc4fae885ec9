// Replaces fem_solver in trigger tests that need a slow one: 56 steps of 0.05 s simulated and 20 ms
// real time, telemetry written in two halves, snapshots at times, at an interval and on request.
// While a file `gate` exists in the sandbox (above the folder of the programs), it ignores
// requests; if a file `exit_code` exists there, it ends with that code after 1.35 s.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

using nlohmann::json;
namespace fs = std::filesystem;

namespace {

constexpr double dt = 0.05;
constexpr int steps = 56;

std::string spelt(double time) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6f", time);
    return text;
}

void publish(const fs::path& file, const std::string& text) {
    const fs::path temporary = file.string() + ".part";
    std::ofstream(temporary) << text;
    fs::rename(temporary, file);
}

struct Options {
    fs::path output;
    std::vector<double> times;
    double interval = 0.0;
};

Options options_from(int argc, char** argv) {
    Options options;
    for (int i = 1; i + 1 < argc; ++i) {
        const std::string word = argv[i], next = argv[i + 1];
        if (word == "--output") options.output = next;
        const auto value = [&](const std::string& key) {
            return word == "--set" && next.starts_with(key) ? json::parse(next.substr(key.size()))
                                                            : json();
        };
        if (const json times = value("/fem/snapshot_times="); !times.is_null())
            options.times = times.get<std::vector<double>>();
        if (const json interval = value("/fem/snapshot_interval="); !interval.is_null())
            options.interval = interval;
    }
    return options;
}

/// jacobian_least_avg falls below 0.97 after 0.6 s; epsilon_q_max is high only from 0.5 to 0.6 s.
json line_at(int step) {
    const double t = dt * step;
    return {{"time", t},
            {"step", step},
            {"jacobian_least_avg", 1 - 0.05 * t},
            {"crest_displacement", t * t},
            {"epsilon_q_max", step >= 10 && step <= 12 ? 1.0 : 0.0},
            {"kinetic_energy", std::exp(2 * t)}};
}

/// 0: success.
int code_at(const fs::path& sandbox, int step) {
    int code = 0;
    if (dt * step > 1.38) std::ifstream(sandbox / "exit_code") >> code;
    return code;
}

bool take_request(const fs::path& sandbox, const fs::path& output) {
    return !fs::exists(sandbox / "gate") && fs::remove(output / "snapshot_request");
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 2 && argv[1] == std::string("--version")) {
        std::cout << "fem_solver 0\nnumerics 1\n";
        return 0;
    }
    const Options options = options_from(argc, argv);
    const fs::path sandbox = fs::path(argv[0]).parent_path().parent_path();
    std::ofstream telemetry(options.output / "telemetry.jsonl");
    const auto pause = [] { std::this_thread::sleep_for(std::chrono::milliseconds(10)); };
    for (int step = 1; step <= steps; ++step) {
        const double t = dt * step;
        if (const int code = code_at(sandbox, step)) {
            std::cerr << "fem_solver: the disk is full\n";
            return code;
        }
        const std::string line = line_at(step).dump() + "\n";
        telemetry << line.substr(0, line.size() / 2) << std::flush;  // incomplete
        pause();
        telemetry << line.substr(line.size() / 2) << std::flush;
        bool due = step == steps || take_request(sandbox, options.output);
        for (const double each : options.times) due = due || std::abs(each - t) < 0.5 * dt;
        const auto count = [&](double time) { return std::floor(time / options.interval + 1e-9); };
        due = due || (options.interval > 0.0 && count(t) > count(t - dt));
        if (due) publish(options.output / ("snapshot_" + spelt(t) + ".vtkhdf"), spelt(t));
        pause();
    }
    publish(options.output / "frames.vtkhdf.series", "{}");
    publish(options.output / "result.json", R"({"phase":"fem_solver"})");
    return 0;
}
