// `breach logs`: reads an attempt's log in parts and follows it. It asks for more than once per
// read, because the server limits the size of an answer.
#include "services/cli/logs.hpp"

#include <charconv>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "services/cli/views.hpp"

namespace breach::cli {

using fault::ExitCode;
using nlohmann::json;

namespace {

/// Logs have no long poll, unlike events: following one means asking.
constexpr auto time_between_looks = std::chrono::milliseconds(500);

/// The log beyond `offset`, which is advanced. The server may send it in parts.
std::string more_of(Server& server, const std::string& task, std::int64_t attempt,
                    std::int64_t& offset) {
    std::string text;
    for (;;) {
        const TextAnswer answer =
            server.get_text(path_of({"tasks", task, "attempts", std::to_string(attempt), "log"}) +
                            query_of({{"offset", std::to_string(offset)}}));
        if (answer.body.empty()) return text;
        text += answer.body;
        std::int64_t next = offset + static_cast<std::int64_t>(answer.body.size());
        if (answer.next_offset) {
            const std::string& digits = *answer.next_offset;
            std::from_chars(digits.data(), digits.data() + digits.size(), next);
        }
        // Otherwise an answer without progress would be asked for without end.
        if (next <= offset) return text;
        offset = next;
    }
}

/// Attempts are in their order; a task that waits has none.
std::int64_t newest_attempt(const json& task) {
    if (task.at("attempts").empty())
        throw Refused(404, "the task has not been started: it has no log", {});
    return task["attempts"].back().at("number");
}

}  // namespace

std::string_view last_lines(std::string_view text, std::size_t count) {
    if (count == 0 || text.empty()) return text;
    // The last line break ends a line; it does not begin an empty one.
    std::size_t begin = text.ends_with('\n') ? text.size() - 1 : text.size();
    for (std::size_t found = 0; found < count; ++found) {
        if (begin == 0) return text;
        begin = text.rfind('\n', begin - 1);
        if (begin == std::string_view::npos) return text;
    }
    return text.substr(begin + 1);
}

std::string read_log(Server& server, const std::string& task, std::int64_t attempt) {
    std::int64_t offset = 0;
    return more_of(server, task, attempt, offset);
}

/// With --attempt it stays with that attempt; else it goes on to the next one when a task is
/// retried.
ExitCode show_log(Server& server, const LogOptions& options, const Console& console) {
    const std::string path = path_of({"tasks", options.task});
    std::int64_t attempt = options.attempt ? *options.attempt : newest_attempt(server.get(path));
    std::int64_t offset = 0;
    console.out << last_lines(more_of(server, options.task, attempt, offset), options.lines)
                << std::flush;
    while (options.follow == Follow::until_the_end) {
        if (!console.out) throw fault::IoError("the output was closed");
        // Before the last read: everything written before the end is then shown.
        const json task = server.get(path);
        console.out << more_of(server, options.task, attempt, offset) << std::flush;
        const std::int64_t newest = newest_attempt(task);
        if (!options.attempt && newest > attempt) {
            console.notes << "attempt " << newest << "\n";
            attempt = newest;
            offset = 0;
            continue;
        }
        // With --attempt, a newer attempt means that this one has ended.
        if (is_final_task(task) || newest > attempt) break;
        std::this_thread::sleep_for(time_between_looks);
    }
    return ExitCode::done;
}

}  // namespace breach::cli
