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

/// Limit of a refusal: users do not correct more at once, and a hostile document has millions.
inline constexpr std::size_t most_faults = 100;

/// Collects the first faults of a document and counts the others.
struct FirstFaults {
    std::vector<Fault> faults;
    std::size_t more = 0;  ///< faults beyond those

    /// If true, no texts are needed: count a further fault with add({}).
    bool is_full() const { return faults.size() >= most_faults; }
    void add(Fault fault) {
        if (is_full())
            ++more;
        else
            faults.push_back(std::move(fault));
    }
};

/// An unusable input, with its first faults. Exit code 65.
class BadInput : public std::runtime_error {
  public:
    /// Keeps at most most_faults, and so many that an answer stays below 100 kB; shortens long
    /// texts, which quote the input. more: faults beyond the given ones.
    BadInput(std::string file, std::vector<Fault> faults, std::size_t more = 0);
    const std::string& file() const { return file_; }
    const std::vector<Fault>& faults() const { return kept_.faults; }
    std::size_t more() const { return kept_.more; }
    /// "3 faults", "5000 faults, of which these are the first 100"
    std::string count() const;

  private:
    BadInput(std::string file, FirstFaults kept);
    std::string file_;
    FirstFaults kept_;
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
