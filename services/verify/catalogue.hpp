// What the programs are compared with: closed forms, published tables, independent programs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace breach::verify {

/// Where a number stands in a folder that programs have left.
struct Place {
    std::string file;    ///< result.json, telemetry.jsonl, or a CSV file
    std::string at;      ///< JSON pointer; of a CSV file its column
    std::string key;     ///< entry (JSON lines) or column (CSV) that chooses the line; empty: none
    double value = 0.0;  ///< that it has there, between two lines by a straight line
};

struct Quantity {
    std::string what;
    Place place;
    double right;
    double allowed;       ///< largest |difference|
    bool relative;        ///< `allowed` is a share of |right|
    std::string because;  ///< why so much is allowed
    double scale = 1.0;   ///< the programs' number times this is what is compared
    /// What the number converges to: the order of its error over the case's levels is compared.
    std::optional<double> limit = {};
};

/// One of the runs whose errors tell an order of convergence.
struct Level {
    double size;  ///< that is refined, in any unit
    std::vector<std::string> set;
};

/// The right answer of a case that must be refused or stopped.
struct Refusal {
    int exit_code;
    std::vector<std::string> says;  ///< words of its message
};

struct Case {
    std::string id;
    std::string question;
    std::string source;
    std::string kind;                                ///< closed form, published, program
    std::filesystem::path scene;                     ///< empty: an element test or the like
    std::vector<std::vector<std::string>> commands;  ///< {input} and {output} stand for files
    std::vector<Level> levels;  ///< from coarse to fine; empty: one run as the scene is
    bool slow = false;          ///< left out of --quick
    std::vector<Quantity> quantities;
    std::optional<Refusal> refusal = {};  ///< its exit code is the one quantity
};

struct Topic {
    std::string id;  ///< name of its file
    std::string title;
    std::string text;
    std::vector<Case> cases;
};

/// Every *.json of the folder, by name. Throws BadInput where an entry lacks its source, right value or
/// tolerance with a reason, or two cases have one id.
std::vector<Topic> catalogue_in(const std::filesystem::path& folder);

}  // namespace breach::verify
