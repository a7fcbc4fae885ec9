// Reads the comparisons of `verify`: with closed forms, published tables, independent programs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace breach::verify {

/// Location of a number in a program's output folder.
struct Place {
    std::string file;    ///< result.json, telemetry.jsonl, or a CSV file
    std::string at;      ///< JSON pointer; of a CSV file its column
    std::string key;     ///< entry (JSON lines) or column (CSV) that selects the line; empty: none
    double value = 0.0;  ///< of the key; interpolated between two lines
};

struct Quantity {
    std::string what;
    Place place;
    double right;
    double allowed;       ///< largest |difference|
    bool relative;        ///< `allowed` is a share of |right|
    std::string because;  ///< reason for this tolerance
    double scale = 1.0;   ///< factor on the programs' number before the comparison
    /// Limit of the number: compares the order of its error over the case's levels.
    std::optional<double> limit = {};
};

/// One run of a series for an order of convergence.
struct Level {
    double size;  ///< the refined size, in any unit
    std::vector<std::string> set;
};

/// The expected refusal or stop of a case.
struct Refusal {
    int exit_code;
    std::vector<std::string> says;  ///< words of its message
};

struct Case {
    std::string id;
    std::string question;
    std::string source;
    std::string kind;                                ///< closed form, published, program
    std::filesystem::path scene;                     ///< empty: no scene, such as an element test
    std::vector<std::vector<std::string>> commands;  ///< {input} and {output} stand for files
    std::vector<Level> levels;  ///< from coarse to fine; empty: one run with the scene unchanged
    bool slow = false;          ///< left out of --quick
    std::vector<Quantity> quantities;
    std::optional<Refusal> refusal = {};  ///< its exit code is the only quantity
};

struct Topic {
    std::string id;  ///< name of its file
    std::string title;
    std::string text;
    std::vector<Case> cases;
};

/// Every *.json of the folder, by name. Throws BadInput where an entry lacks its source, expected
/// value or tolerance with a reason, or where two cases have the same id.
std::vector<Topic> catalogue_in(const std::filesystem::path& folder);

}  // namespace breach::verify
