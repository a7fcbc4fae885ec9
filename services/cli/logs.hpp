// Prints a task's log, once or until the task ends.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "services/cli/commands.hpp"

namespace breach::cli {

enum class Follow { no, until_the_end };

struct LogOptions {
    std::string task;
    std::optional<std::int64_t> attempt;  ///< else the newest
    std::size_t lines = 0;                ///< only the last `lines`; 0: all
    Follow follow = Follow::no;
};

fault::ExitCode show_log(Server& server, const LogOptions& options, const Console& console);

/// The whole log of one attempt as it is now.
std::string read_log(Server& server, const std::string& task, std::int64_t attempt);

/// The last `count` lines of a text; 0: all of it.
std::string_view last_lines(std::string_view text, std::size_t count);

}  // namespace breach::cli
