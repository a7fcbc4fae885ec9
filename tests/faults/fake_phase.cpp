// Replaces all four phases in tests of the orchestrator. Follows a phase's interface, with results
// that take no time, and misbehaves according to words "name=value" in the scene's title:
//
//     fem_steps, mpm_steps   number of steps of 20 ms
//     entangle_at=T          the FEM ends regularly, entangled, before time T
//     breakdown_at=T         the FEM ends with 70 before time T
//     damage=T               the snapshot at T is damaged
//     deaf=1                 the MPM ignores TERM and leaves a daemon
//     try_again=1            the MPM's first attempt ends with 75
//     crash=1                the MPM ends by SIGKILL if it started from the beginning
//     always_crash=1         the MPM never succeeds
//     moving_from=T          the MPM of transfers at T and later still moves at its end
//     fails_above=S          the MPM of a lattice shifted by more than S ends with 70
//     moving_above=S         the MPM of such a lattice still moves at its end
//     by_cell=1              the runout grows with the square of the MPM's cells, the cost with
//                            their number, and a moved lattice changes the runout
//     linear=1, ishigami=1   the runout beyond the toe is that function of /mpm/cfl,
//                            /mpm/blending_rate and /mpm/gimp_half_size (drawn_result)
//     breaks_from=X          the MPM with a cfl of X or more ends with 70
//     by_stiffness=1         the runout grows with the square of the MPM's stiffness_scale
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

using nlohmann::json;
namespace fs = std::filesystem;

namespace {

volatile std::sig_atomic_t stop = 0;
void note_stop(int signal) { stop = signal; }

struct Order {
    std::string phase;
    fs::path bin;  ///< folder of the program: the sandbox's
    fs::path scene;
    fs::path input;
    fs::path output;
    std::vector<std::string> overrides;
    bool resume = false;
    bool plan = false;
    bool version = false;
};

Order order_from(int argc, char** argv) {
    Order order;
    order.phase = fs::path(argv[0]).filename();
    order.bin = fs::path(argv[0]).parent_path();
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--input")
            order.input = argv[++i];
        else if (word == "--output")
            order.output = argv[++i];
        else if (word == "--set")
            order.overrides.emplace_back(argv[++i]);
        else if (word == "--progress" || word == "--threads")
            ++i;
        else if (word == "--resume")
            order.resume = true;
        else if (word == "--version")
            order.version = true;
        else if (word == "--plan")
            order.plan = true;
        else
            order.scene = word;
    }
    return order;
}

std::string text_of(const fs::path& file) {
    std::ifstream stream(file);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

void publish(const fs::path& file, const std::string& text) {
    const fs::path temporary = file.string() + ".part";
    std::ofstream stream(temporary);
    stream << text;
    stream.close();
    if (!stream) {
        std::error_code ignored;
        fs::remove(temporary, ignored);
        std::cerr << file.string() << ": cannot be written\n";
        std::exit(74);
    }
    fs::rename(temporary, file);
}

/// Misbehaviour requested by the scene's title.
std::map<std::string, double> settings(const json& scene) {
    std::map<std::string, double> found;
    std::istringstream words(scene.value("title", ""));
    for (std::string word; words >> word;) {
        const auto equals = word.find('=');
        if (equals != std::string::npos)
            found[word.substr(0, equals)] = std::stod(word.substr(equals + 1));
    }
    return found;
}

double setting(const std::map<std::string, double>& wanted, const std::string& name,
               double otherwise) {
    const auto found = wanted.find(name);
    return found == wanted.end() ? otherwise : found->second;
}

void say(const json& line) { std::cout << line.dump() << std::endl; }

[[noreturn]] void end_with_fault(const Order& order, int code, const std::string& summary) {
    publish(order.output / "fault.json", json{{"exit_code", code}, {"summary", summary}}.dump());
    std::cerr << order.phase << ": " << summary << "\n";
    std::exit(code);
}

[[noreturn]] void end_well(const Order& order, const json& result) {
    publish(order.output / "result.json", result.dump());
    say({{"event", "result"}, {"result", result}});
    // A record outside the service: one line per success.
    std::ofstream(order.bin / "../ledger", std::ios::app) << order.output.string() + "\n"
                                                          << std::flush;
    std::exit(0);
}

fs::path checkpoint_of(const Order& order) { return order.output / "checkpoint.h5"; }

int steps_done_before(const Order& order) {
    const fs::path checkpoint = checkpoint_of(order);
    if (!order.resume || !fs::exists(checkpoint)) return 0;
    try {
        return std::stoi(text_of(checkpoint));
    } catch (const std::invalid_argument&) {
        end_with_fault(order, 65, "the checkpoint is of another version");
    }
}

/// Steps of 20 ms with a checkpoint after each; a resumed phase continues at the last one.
template <class Step>
void walk(const Order& order, int steps, Step step) {
    const fs::path checkpoint = checkpoint_of(order);
    int done = steps_done_before(order);
    for (; done < steps; ++done) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        step(done);
        publish(checkpoint, std::to_string(done + 1));
        say({{"event", "progress"}, {"fraction", (done + 1.0) / steps}, {"message", "step"}});
        std::ofstream(order.output / "telemetry.jsonl", std::ios::app)
            << json{{"time", done}, {"speed", 0.5 * done}}.dump() + "\n";
        if (stop != 0) std::exit(128 + static_cast<int>(stop));
    }
}

/// Waits while a file `gate` exists in the sandbox (above the folder of the programs).
void wait_at_the_gate(const Order& order) {
    while (fs::exists(order.bin / "../gate")) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        if (stop != 0) std::exit(128 + static_cast<int>(stop));
    }
}

std::string spelt(double time) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6f", time);
    return text;
}

void fem(const Order& order, const std::map<std::string, double>& wanted) {
    std::vector<double> times;
    const std::string key = "/fem/snapshot_times=";
    for (const std::string& each : order.overrides) {
        if (each.starts_with(key))
            times = json::parse(each.substr(key.size())).get<std::vector<double>>();
    }
    const double end = 3.0;
    const int steps = static_cast<int>(setting(wanted, "fem_steps", 10));
    const double entangled = setting(wanted, "entangle_at", 1e9);
    const double breakdown = setting(wanted, "breakdown_at", 1e9);
    walk(order, steps, [&](int done) {
        const double from = end * done / steps;
        const double to = end * (done + 1) / steps;
        if (to > breakdown) end_with_fault(order, 70, "no convergence at " + spelt(from) + " s");
        if (to > entangled) {
            end_well(order, {{"phase", "fem_solver"},
                             {"ended", "entangled"},
                             {"end_time", from},
                             {"flags",
                              {{{"code", "entangled"},
                                {"severity", "warning"},
                                {"message", "the mesh folded"},
                                {"pointer", ""}}}},
                             {"questionable", false}});
        }
        for (const double time : times) {
            if (time < from || (time >= to && done + 1 < steps)) continue;
            const bool damaged = std::abs(time - setting(wanted, "damage", -1)) < 1e-9;
            publish(order.output / ("snapshot_" + spelt(time) + ".vtkhdf"),
                    damaged ? "" : spelt(time));
        }
    });
    wait_at_the_gate(order);
    end_well(order, {{"phase", "fem_solver"}, {"ended", "complete"}, {"end_time", end}});
}

/// The scene with its overrides.
json changed(json scene, const std::vector<std::string>& overrides) {
    for (const std::string& each : overrides) {
        const auto equals = each.find('=');
        scene[json::json_pointer(each.substr(0, equals))] =
            json::parse(each.substr(equals + 1), nullptr, false);
    }
    return scene;
}

/// The points: time of the snapshot and shift of the lattice.
void transfer(const Order& order, const json& scene) {
    const std::string snapshot = text_of(order.input);
    if (snapshot.empty())
        end_with_fault(order, 65, order.input.filename().string() + ": is truncated");
    const json moved = changed(scene, order.overrides)["transfer"].value("point_shift", json{0, 0});
    publish(order.output / "particles.vtkhdf", snapshot + " " + moved.at(0).dump());
    end_well(order, {{"phase", "transfer_tool"}});
}

/// A daemon outside the phase's session and process group that ignores TERM.
void leave_a_daemon(const fs::path& pid_file) {
    if (fork() != 0) return;
    setsid();
    if (fork() != 0) _exit(0);
    std::signal(SIGTERM, SIG_IGN);
    publish(pid_file, std::to_string(getpid()));
    while (true) sleep(1);
}

/// Flags of the result.
void add_judgement(json& result, bool moves) {
    result["ended"] = moves ? "duration" : "at_rest";
    result["kinetic_share"] = moves ? 0.15 : 0.001;
    result["end_time"] = 8.0;
    result["questionable"] = moves;
    result["flags"] = json::array({{{"code", "implausible"},
                                    {"severity", "warning"},
                                    {"message", "a density of 1.9 kg/m3"},
                                    {"pointer", "/materials/slope_soil/density"}}});
    if (moves)
        result["flags"].push_back({{"code", "still_moving"},
                                   {"severity", "questionable"},
                                   {"message", "15 % of the energy was left; a lower bound"},
                                   {"pointer", "/mpm/duration"}});
}

/// As the real phases write it (core/scene/softening.hpp).
json softening_in(const json& scene) {
    json soils = json::array();
    bool has_length = false;
    for (const auto& [name, soil] : scene.at("materials").items()) {
        if (!soil.at("law").value("softening", json()).is_object()) continue;
        soils.push_back(name);
        has_length |= soil.contains("nonlocal_length");
    }
    return soils.empty() ? json() : json{{"soils", soils}, {"has_length", has_length}};
}

/// A second-order method whose repeats scatter.
void add_cell_error(const json& scene, double shift, json& result) {
    const double h = scene.at("mpm").at("cell_size");
    result["runout"] = result["runout"].get<double>() + h * h + 0.02 * shift;
    result["cpu_seconds"] = 8.0 / (h * h);
    result["wall_seconds"] = 9.0 / (h * h);
    result["peak_memory_MB"] = 40.0 / h;
}

/// Functions with known percentiles and indices: 10 + 2 a + b + 0 c of standard normal numbers, and
/// Ishigami's function of numbers between -pi and pi. Entries are sampled with the mean and
/// standard deviation, or range, given here; a moved lattice adds a little.
double drawn_result(const json& scene, bool linear, double shift) {
    const json& mpm = scene.at("mpm");
    const double cfl = mpm.value("cfl", 0.4);
    const double rate = mpm.value("blending_rate", 2.0);
    const double size = mpm.value("gimp_half_size", 0.25);
    if (linear) return 10.0 + 2.0 * (cfl - 0.4) / 0.05 + (rate - 2.0) / 0.2 + 0.1 * shift;
    constexpr double pi = 3.14159265358979323846;
    const double a = pi * (cfl - 0.4) / 0.2;     // 0.2 to 0.6
    const double b = pi * (rate - 2.0);          // 1 to 3
    const double c = pi * (size - 0.25) / 0.15;  // 0.1 to 0.4
    return std::sin(a) * (1.0 + 0.1 * std::pow(c, 4)) + 7.0 * std::pow(std::sin(b), 2);
}

void mpm(const Order& order, const json& scene, const std::map<std::string, double>& wanted) {
    std::istringstream points(text_of(order.input));
    double time = 0.0;
    double shift = 0.0;
    points >> time >> shift;
    if (setting(wanted, "try_again", 0) > 0 && !order.resume)
        end_with_fault(order, 75, "not enough memory");
    if (setting(wanted, "deaf", 0) > 0) {
        std::signal(SIGTERM, SIG_IGN);
        leave_a_daemon(order.output / "daemon.pid");
    }
    // Independent of --resume: an attempt lost before its start has left no checkpoint.
    const bool crash = setting(wanted, "crash", 0) > 0 && steps_done_before(order) == 0;
    walk(order, static_cast<int>(setting(wanted, "mpm_steps", 5)), [&](int done) {
        if ((crash && done == 2) || setting(wanted, "always_crash", 0) > 0) raise(SIGKILL);
    });
    const json own = changed(scene, order.overrides);
    if (shift > setting(wanted, "fails_above", 1.0) ||
        own["mpm"].value("cfl", 0.4) >= setting(wanted, "breaks_from", 1.0))
        end_with_fault(order, 70, "the points have left the grid");
    const bool moves =
        time >= setting(wanted, "moving_from", 1e9) || shift > setting(wanted, "moving_above", 1.0);
    json result{{"phase", "mpm_solver"},     {"runout", 10 + time * time},
                {"runout_beyond_toe", time}, {"runout_largest", 12 + time},
                {"volume_ratio", 1.0},       {"energy", {{"numerical", {{"share", 0.01}}}}},
                {"cpu_seconds", 0.5},        {"at_rest", !moves}};
    result["cell_size"] = own.at("mpm").at("cell_size");
    if (const double area = setting(wanted, "area", 0); area > 0) result["area_beyond_toe"] = area;
    result["softening"] = softening_in(own);
    add_judgement(result, moves);
    if (setting(wanted, "by_cell", 0) > 0) add_cell_error(own, shift, result);
    const bool linear = setting(wanted, "linear", 0) > 0;
    if (linear || setting(wanted, "ishigami", 0) > 0)
        result["runout_beyond_toe"] = drawn_result(own, linear, shift);
    if (setting(wanted, "by_stiffness", 0) > 0) {
        const json& scale = own.at("mpm").at("stiffness_scale");
        const double s = scale.is_number() ? scale.get<double>() : 1.0;
        result["runout"] = result["runout"].get<double>() + s * s;
    }
    end_well(order, result);
}

}  // namespace

int main(int argc, char** argv) {
    const Order order = order_from(argc, argv);
    if (order.version) {
        std::cout << order.phase << " 0\nnumerics 1\n";
        return 0;
    }
    if (order.plan) {
        std::cout << "the fake " << order.phase << " needs nothing\n";
        return 0;
    }
    std::signal(SIGTERM, note_stop);
    const json scene = json::parse(text_of(order.scene));
    fs::create_directories(order.output);
    std::cerr << order.phase << " begins\n";
    const auto wanted = settings(scene);
    if (order.phase == "fem_solver") fem(order, wanted);
    if (order.phase == "transfer_tool") transfer(order, scene);
    if (order.phase == "mpm_solver") mpm(order, scene, wanted);
    end_well(order, {{"phase", order.phase}, {"safety", 1.2}});
}
