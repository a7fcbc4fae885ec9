// Runs another program to its end with a time limit; returns its exit code and output.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace breach::command {

/// Time limit for a phase's --plan or --version.
constexpr auto longest_answer = std::chrono::seconds(20);

struct Result {
    std::optional<int> exit_code;  ///< empty: killed, also after the time limit
    std::string out;
    std::string err;
    double cpu_seconds = 0.0;
};

/// `words`: the program (found on PATH if it has no slash) and its arguments. `input`: at most
/// 60,000 bytes, written to the pipe at once. Throws IoError if the program cannot be started.
Result run(std::vector<std::string> words, const std::string& input,
           std::chrono::milliseconds longest);

}  // namespace breach::command
