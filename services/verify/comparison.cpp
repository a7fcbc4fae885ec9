#include "services/verify/comparison.hpp"

#include <atomic>
#include <cmath>
#include <fstream>
#include <limits>
#include <mutex>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "core/command/command.hpp"
#include "core/fault/fault.hpp"
#include "core/phases/phases.hpp"

namespace breach::verify {

using nlohmann::json;
namespace fs = std::filesystem;

double Found::used() const {
    if (!value || !std::isfinite(*value)) return std::numeric_limits<double>::infinity();
    const double scale = quantity->relative ? std::abs(quantity->right) : 1.0;
    return std::abs(difference()) / (quantity->allowed * scale);
}

namespace {

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
        text.replace(at, what.size(), by);
    return text;
}

/// Runs the program with its output in log.txt. No exit code: it cannot be started.
command::Result run_program(std::vector<std::string> words, const fs::path& folder) {
    constexpr auto longest = std::chrono::hours(2);
    command::Result result;
    try {
        result = command::run(std::move(words), "", longest);
    } catch (const fault::IoError& error) {
        result.err = error.what();
    }
    std::ofstream(folder / "log.txt", std::ios::app) << result.out << result.err;
    return result;
}

std::optional<double> number_in(const json& document, const std::string& pointer) {
    const json::json_pointer at(pointer);
    if (!document.contains(at) || !document.at(at).is_number()) return std::nullopt;
    return document.at(at).get<double>();
}

/// (key, value) of each line that has both.
std::vector<std::pair<double, double>> lines_in(const fs::path& file, const Place& place) {
    std::vector<std::pair<double, double>> found;
    std::ifstream stream(file);
    std::vector<std::string> heads;
    for (std::string line; std::getline(stream, line);) {
        if (line.empty() || line.front() == '#') continue;
        if (file.extension() == ".csv") {
            std::vector<std::string> cells;
            std::istringstream each(line);
            for (std::string cell; std::getline(each, cell, ',');) cells.push_back(cell);
            if (heads.empty()) {
                heads = cells;
                continue;
            }
            std::optional<double> key = place.key.empty() ? std::optional(0.0) : std::nullopt,
                                  value;
            for (std::size_t k = 0; k < std::min(heads.size(), cells.size()); ++k) {
                char* end = nullptr;
                const double number = std::strtod(cells[k].c_str(), &end);
                if (end == cells[k].c_str()) continue;
                if (heads[k] == place.key) key = number;
                if (heads[k] == place.at) value = number;
            }
            if (key && value) found.emplace_back(*key, *value);
        } else {
            const json document = json::parse(line, nullptr, false);
            if (!document.is_object()) continue;
            const auto key =
                place.key.empty() ? std::optional(0.0) : number_in(document, place.key);
            if (const auto value = number_in(document, place.at); key && value)
                found.emplace_back(*key, *value);
        }
    }
    return found;
}

/// Interpolates between the first two lines that enclose the key; without a key, the last line.
std::optional<double> at_key(const std::vector<std::pair<double, double>>& lines,
                             const Place& place) {
    if (lines.empty()) return std::nullopt;
    if (place.key.empty()) return lines.back().second;
    for (std::size_t k = 0; k < lines.size(); ++k) {
        const double near = 1e-9 * std::max(std::abs(place.value), 1e-12);
        if (std::abs(lines[k].first - place.value) <= near) return lines[k].second;
        if (k == 0) continue;
        const auto [a, u] = lines[k - 1];
        const auto [b, v] = lines[k];
        if ((a - place.value) * (b - place.value) < 0.0)
            return u + (v - u) * (place.value - a) / (b - a);
    }
    return std::nullopt;
}

Found found_in(const fs::path& folder, const Quantity& quantity) {
    Found found{&quantity};
    const fs::path file = folder / quantity.place.file;
    if (!fs::exists(file)) {
        found.problem = "no " + quantity.place.file;
    } else if (file.extension() == ".json") {
        std::ifstream stream(file);
        found.value = number_in(json::parse(stream, nullptr, false), quantity.place.at);
    } else {
        found.value = at_key(lines_in(file, quantity.place), quantity.place);
    }
    if (found.value)
        *found.value *= quantity.scale;
    else if (found.problem.empty())
        found.problem = "no number at " + quantity.place.at + " in " + quantity.place.file;
    return found;
}

/// The slope of log |error| over log size, by least squares.
Found order_in(const fs::path& folder, const Case& of, const Quantity& quantity) {
    const auto n = static_cast<double>(of.levels.size());
    double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (std::size_t k = 0; k < of.levels.size(); ++k) {
        const Found found = found_in(folder / std::to_string(k), quantity);
        if (!found.value) return found;
        const double size = std::log(of.levels[k].size);
        const double error = std::log(std::abs(*found.value - *quantity.limit));
        x += size, y += error, xx += size * size, xy += size * error;
    }
    return {&quantity, (n * xy - x * y) / (n * xx - x * x), ""};
}

/// The exit code, if the message contains the required words.
Found refusal_in(const fs::path& folder, const Case& of, int exit_code) {
    const Quantity* quantity = &of.quantities.front();
    std::ifstream stream(folder / "log.txt");
    const std::string log{std::istreambuf_iterator<char>(stream), {}};
    for (const std::string& each : of.refusal->says)
        if (log.find(each) == std::string::npos)
            return {quantity, {}, "does not say \"" + each + "\""};
    return {quantity, exit_code};
}

struct Ran {
    std::string broke = {};            ///< error of the programs; empty: none
    std::optional<int> exit_code = 0;  ///< of the command that ended the case
};

Ran run_commands(const Case& of, const std::vector<std::string>& set, const fs::path& folder,
                 const Settings& settings, double& cpu_seconds) {
    fs::create_directories(folder);
    for (std::vector<std::string> words : of.commands) {
        for (const std::string& each : set) words.insert(words.end(), {"--set", each});
        for (std::string& each : words)
            each =
                replaced(replaced(each, "{input}", of.scene.string()), "{output}", folder.string());
        const std::string program = words.front();
        words.front() = (settings.programs / program).string();
        const command::Result ran = run_program(std::move(words), folder);
        cpu_seconds += ran.cpu_seconds;
        if (ran.exit_code == 0) continue;
        const std::string how = ran.exit_code
                                    ? " ended with exit code " + std::to_string(*ran.exit_code)
                                    : " was stopped";
        return {program + how + ": " + (folder / "log.txt").string(), ran.exit_code};
    }
    return {};
}

Outcome outcome_of(const Case& of, const Settings& settings) {
    const fs::path folder = settings.output / "cases" / of.id;
    fs::remove_all(folder);
    Outcome outcome{&of};
    Ran ran;
    if (of.levels.empty()) ran = run_commands(of, {}, folder, settings, outcome.cpu_seconds);
    for (std::size_t k = 0; k < of.levels.size() && ran.broke.empty(); ++k)
        ran = run_commands(of, of.levels[k].set, folder / std::to_string(k), settings,
                           outcome.cpu_seconds);
    if (of.refusal && ran.exit_code) {
        outcome.found.push_back(refusal_in(folder, of, *ran.exit_code));
        return outcome;
    }
    for (const Quantity& each : of.quantities)
        outcome.found.push_back(!ran.broke.empty() ? Found{&each, {}, ran.broke}
                                : each.limit       ? order_in(folder, of, each)
                                                   : found_in(folder, each));
    return outcome;
}

}  // namespace

std::vector<Outcome> compare(const std::vector<Topic>& catalogue, const Settings& settings,
                             const std::function<void(const Outcome&, std::size_t of)>& said) {
    std::vector<Outcome> outcomes;
    for (const Topic& topic : catalogue)
        for (const Case& each : topic.cases)
            if (!settings.quick || !each.slow) outcomes.push_back({&each});
    std::atomic<std::size_t> next = 0;
    std::mutex saying;
    std::exception_ptr failed;
    const auto work = [&] {
        for (std::size_t k; (k = next++) < outcomes.size();) {
            try {
                outcomes[k] = outcome_of(*outcomes[k].of, settings);
                const std::lock_guard lock(saying);
                said(outcomes[k], outcomes.size());
            } catch (...) {
                const std::lock_guard lock(saying);
                failed = std::current_exception();
                next = outcomes.size();
            }
        }
    };
    {
        std::vector<std::jthread> workers;
        for (unsigned k = 0; k < std::max(1U, settings.slots); ++k) workers.emplace_back(work);
    }
    if (failed) std::rethrow_exception(failed);
    return outcomes;
}

std::string versions_of(const Settings& settings) {
    std::string versions;
    for (const phases::Phase& each : phases::all) {
        const command::Result told =
            command::run({(settings.programs / each.program).string(), "--version"}, "",
                         command::longest_answer);
        if (told.exit_code != 0)
            throw fault::IoError((settings.programs / each.program).string() + ": cannot be run");
        std::istringstream said(told.out);
        std::string version, numerics;
        std::getline(said, version);
        std::getline(said, numerics);
        versions += (versions.empty() ? "" : ", ") + version + " (" + numerics + ")";
    }
    return versions;
}

}  // namespace breach::verify
