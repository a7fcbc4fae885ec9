// The files by which service and supervisor talk: order, stop, heartbeat, exit record. Files
// rather than pipes, because each side may be killed and start again, and may be on another
// machine. The exit record is published by a rename: it is there as a whole or not at all, and
// decides that an attempt has ended.
#include "services/orchestrator/executors/order.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/exchange/publish.hpp"
#include "core/fault/fault.hpp"
#include "core/words/words.hpp"

namespace breach::orchestrator {

using nlohmann::json;

static constexpr auto words_of(StopReason) {
    using enum StopReason;
    return words::in_order<StopReason>(
        {{cancel, "cancel"}, {shutdown, "shutdown"}, {revoked, "revoked"}, {signal, "signal"}});
}

std::string_view name_of(StopReason reason) { return words::name_of(reason); }

namespace {

std::optional<std::string> text_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return std::nullopt;
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

}  // namespace

void remove_remains(const AttemptFolder& folder) {
    for (const auto& each : {folder.exit_record(), folder.slurm_job(), folder.stop(),
                             folder.heartbeat(), folder.lines()})
        std::filesystem::remove(each);
}

void write_order(const AttemptFolder& folder, const Order& order) {
    const json document{{"attempt", order.attempt},     {"program", order.program.string()},
                        {"arguments", order.arguments}, {"grace_seconds", order.grace_seconds},
                        {"cores", order.cores},         {"memory_MB", order.memory_mb},
                        {"priority", order.priority}};
    // No flush to the disk: it would delay every start, and a machine that crashes before the
    // supervisor reads the order loses the attempt anyway.
    std::ofstream stream(folder.order(), std::ios::binary);
    stream << document.dump(2) << "\n";
    if (!stream.flush())
        throw fault::IoError(folder.order().string() + ": cannot be written (disk full?)");
}

Order read_order(const AttemptFolder& folder) {
    const auto text = text_of(folder.order());
    if (!text) throw fault::IoError(folder.order().string() + ": cannot be read");
    const json document = json::parse(*text);
    return {.attempt = document.at("attempt"),
            .program = document.at("program").get<std::string>(),
            .arguments = document.at("arguments"),
            .grace_seconds = document.at("grace_seconds"),
            .cores = document.value("cores", std::int64_t{1}),
            .memory_mb = document.value("memory_MB", std::int64_t{0}),
            .priority = document.value("priority", std::int64_t{0})};
}

void write_exit_record(const AttemptFolder& folder, const ExitRecord& record) {
    json document{{"attempt", record.attempt},
                  {"wall_seconds", record.wall_seconds},
                  {"cpu_seconds", record.cpu_seconds}};
    if (record.exit_code) document["exit_code"] = *record.exit_code;
    if (record.signal) document["signal"] = *record.signal;
    if (!record.disk.empty()) document["disk"] = record.disk;
    if (record.stopped) document["stopped"] = words::name_of(*record.stopped);
    exchange::publish_text(folder.exit_record(), document.dump(2) + "\n");
}

std::optional<ExitRecord> read_exit_record(const AttemptFolder& folder) {
    const auto text = text_of(folder.exit_record());
    if (!text) return std::nullopt;
    const json document = json::parse(*text);
    ExitRecord record{.attempt = document.at("attempt"),
                      .exit_code = {},
                      .signal = {},
                      .stopped = words::find<StopReason>(document.value("stopped", "")),
                      .wall_seconds = document.at("wall_seconds"),
                      .cpu_seconds = document.at("cpu_seconds"),
                      .disk = document.value("disk", "")};
    if (document.contains("exit_code")) record.exit_code = document["exit_code"].get<int>();
    if (document.contains("signal")) record.signal = document["signal"].get<int>();
    return record;
}

void write_heartbeat(const AttemptFolder& folder, const Heartbeat& beat) {
    // In place rather than by a rename: it is written every two seconds, and only its time
    // matters for life. It must work on a full disk too, where the time still changes.
    const int file = open(folder.heartbeat().c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
    if (file < 0) return;
    const json document{{"host", beat.host},
                        {"pid", beat.pid},
                        {"cpu_seconds", beat.cpu_seconds},
                        {"memory_MB", beat.memory_mb}};
    const std::string text = document.dump();
    // If this fails, readers ignore the text.
    [[maybe_unused]] const bool whole =
        pwrite(file, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size()) &&
        ftruncate(file, static_cast<off_t>(text.size())) == 0;
    futimens(file, nullptr);
    close(file);
}

std::optional<Heartbeat> read_heartbeat(const AttemptFolder& folder) {
    const json said = json::parse(text_of(folder.heartbeat()).value_or(""), nullptr, false);
    if (!said.is_object()) return std::nullopt;
    return Heartbeat{.host = said.value("host", ""),
                     .pid = said.value("pid", std::int64_t{0}),
                     .cpu_seconds = said.value("cpu_seconds", 0.0),
                     .memory_mb = said.value("memory_MB", std::int64_t{0})};
}

/// The first reason stays: a shutdown after a cancel must not make the task continue at the next
/// start.
void write_stop(const AttemptFolder& folder, StopReason reason) {
    if (!std::filesystem::exists(folder.stop()))
        exchange::publish_text(folder.stop(), words::name_of(reason));
}

std::optional<StopReason> read_stop(const AttemptFolder& folder) {
    const auto text = text_of(folder.stop());
    if (!text) return std::nullopt;
    return words::find<StopReason>(*text);
}

}  // namespace breach::orchestrator
