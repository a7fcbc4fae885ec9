// Faults of input and files, and their exit codes. Expected outcomes (not converged, mesh
// entangled) are return values of the phases, not exceptions.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace breach::fault {

/// Exit codes of every phase; the only input of the scheduler's retry rule.
enum class ExitCode : int {
    done = 0,
    usage = 2,
    bad_input = 65,
    breakdown = 70,
    io = 74,
    try_again = 75,
    interrupted = 130,
    terminated = 143,
};

/// One error of an input: where (JSON pointer or dataset path), why, and what to write instead.
struct Fault {
    std::string pointer;
    std::string cause;
    std::string remedy;
};

/// An unusable input, with all its faults. Exit code 65.
class BadInput : public std::runtime_error {
  public:
    BadInput(std::string file, std::vector<Fault> faults);
    const std::string& file() const { return file_; }
    const std::vector<Fault>& faults() const { return faults_; }

  private:
    std::string file_;
    std::vector<Fault> faults_;
};

/// A file that cannot be read or written (missing, damaged, disk full). Exit code 74.
class IoError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The computation failed. The message says what, where and when; the last good state is saved.
/// Exit code 70.
class Breakdown : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace breach::fault
