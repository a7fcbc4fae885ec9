// What a run of a phase holds from its first step to its last: output folder, telemetry, flags,
// progress, provenance and times. simulate() in phase.cpp creates one; --measure has one of its own
// in a folder that is removed.
#include "core/process/session.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <iostream>
#include <limits>
#include <string_view>

#include "core/exchange/publish.hpp"
#include "core/phases/files.hpp"
#include "core/phases/phases.hpp"
#include "core/process/signals.hpp"
#include "core/telemetry/lines.hpp"
#include "core/version/version.hpp"

namespace breach::process {

using nlohmann::json;

namespace {

/// The service reads each line and stores none: four a second are enough for a bar that moves.
constexpr auto least_time_between_lines = std::chrono::milliseconds(250);
constexpr int bar_width = 30;

void draw_bar(double fraction, const std::string& message) {
    const int filled = static_cast<int>(fraction * bar_width);
    const std::string bar = std::string(filled, '#') + std::string(bar_width - filled, '.');
    std::fprintf(stderr, "\r[%s] %3.0f %%  %s\033[K", bar.c_str(), 100.0 * fraction,
                 message.c_str());
    if (fraction >= 1.0) std::fputc('\n', stderr);
    std::fflush(stderr);
}

/// Whether a warning is about a part that this phase reads. Variants of a study share the results
/// of other phases and must not share this scene's flags about them.
bool concerns(const std::string& phase, const std::string& pointer) {
    const std::string_view part = std::string_view(pointer).substr(0, pointer.find('/', 1));
    for (const phases::Phase& each : phases::all)
        if (part.starts_with('/') && part.substr(1) == each.part)
            return phase.starts_with(each.program);
    return true;
}

}  // namespace

Session::Session(SessionSettings settings, scene::Scene scene)
    : settings_(std::move(settings)),
      scene_(std::move(scene)),
      began_(std::chrono::steady_clock::now()) {
    for (const auto& input : settings_.inputs) {
        digests_.push_back({input.string(), exchange::sha256_of_file(input)});
    }
    const auto file = output(phases::files::telemetry);
    if (settings_.start == Start::resume && std::filesystem::exists(file)) {
        // except for an incomplete last line
        truncate_telemetry(std::numeric_limits<std::int64_t>::max());
    } else {
        telemetry_.open(file, std::ios::trunc);
    }
    if (!telemetry_) throw fault::IoError(file.string() + ": cannot be written");
    for (const fault::Flag& each : scene_.warnings) {
        if (concerns(settings_.phase, each.pointer)) flag(each);
    }
}

Session::~Session() = default;

exchange::Provenance Session::provenance() const {
    return {.phase = settings_.phase,
            .version = breach::version(),
            .scene = scene_.completed,
            .overrides = settings_.overrides,
            .inputs = digests_,
            .threads = settings_.threads,
            .spent = spent()};
}

double Session::wall_seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
}

double Session::cpu_seconds() {
    timespec used{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
    return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

exchange::Spent Session::spent() const {
    return {earlier_.wall + wall_seconds(), earlier_.cpu + cpu_seconds()};
}

std::optional<double> Session::peak_memory() const {
    // Not getrusage: ru_maxrss starts with the value of the parent process.
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        constexpr std::string_view high_water = "VmHWM:";
        if (line.starts_with(high_water))
            return std::stod(line.substr(high_water.size())) * 1024.0 / 1e6;  // given in KiB
    }
    return std::nullopt;
}

void Session::progress(double fraction, const std::string& message) {
    if (settings_.progress == ProgressStyle::none) return;
    const auto now = std::chrono::steady_clock::now();
    if (fraction < 1.0 && now - shown_ < least_time_between_lines) return;
    shown_ = now;
    fraction = std::clamp(fraction, 0.0, 1.0);
    if (settings_.progress == ProgressStyle::bar) {
        draw_bar(fraction, message);
    } else {
        emit({{"event", "progress"}, {"fraction", fraction}, {"message", message}});
    }
}

void Session::telemetry(const json& line) {
    telemetry_ << line.dump() << '\n';
    telemetry_.flush();
    if (!telemetry_) {
        throw fault::IoError(output(phases::files::telemetry).string() +
                             ": cannot be written (disk full?)");
    }
    ++telemetry_lines_;
}

std::int64_t Session::truncate_telemetry(std::int64_t lines) {
    const auto file = output(phases::files::telemetry);
    telemetry_.close();
    telemetry::LineWalk old(file);
    std::string kept;
    std::int64_t count = 0;
    for (; count < lines && old.next(); ++count) kept += old.text() + '\n';
    exchange::publish_text(file, kept);
    telemetry_.clear();
    telemetry_.open(file, std::ios::app);
    if (!telemetry_) throw fault::IoError(file.string() + ": cannot be written");
    telemetry_lines_ = count;
    return count;
}

void Session::flag(fault::Flag flag) {
    spdlog::warn("{}{}{}", flag.severity == fault::Severity::questionable ? "questionable: " : "",
                 flag.pointer.empty() ? "" : flag.pointer + ": ", flag.message);
    const auto same = std::ranges::find_if(flags_, [&](const fault::Flag& each) {
        return each.code == flag.code && each.pointer == flag.pointer;
    });
    if (same == flags_.end()) {
        flags_.push_back(std::move(flag));
    } else {
        *same = std::move(flag);
    }
}

void Session::announce(const std::filesystem::path& file, const json& what) {
    spdlog::info("wrote {}", file.filename().string());
    if (settings_.progress != ProgressStyle::json) return;
    json line = what;
    line["event"] = "artifact";
    line["file"] = file.filename().string();
    emit(line);
}

void Session::announce_frame(const std::string& name, const std::string& prefix, double time) {
    if (!series_)
        series_ = settings_.start == Start::resume
                      ? Series::going_on(settings_.output, prefix, time)
                      : Series(settings_.output);
    series_->add(name, time);
    announce(output(name), {{"time", time}});
}

bool Session::stop_requested() const { return stop_was_requested(); }

void Session::emit(const json& line) { std::cout << line.dump() << std::endl; }

}  // namespace breach::process
