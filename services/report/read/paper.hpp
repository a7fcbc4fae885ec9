// The published numbers that a scene is compared with. They live in paper.json, which is built into
// the program; nothing of them is in code.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "services/report/chart/document.hpp"

namespace breach::report {

struct PaperValue {
    std::string key;   ///< names the same quantity of ours: measures.hpp
    std::string what;  ///< in words
    std::string unit;
    double value;
    std::string first_time = {};           ///< the condition of which ours is the first time
    std::optional<double> runout_at = {};  ///< the transfer time of which ours is the runout [s]
};

/// Something that holds for the paper's case alone, said below a table.
struct PaperNote {
    std::string table;
    std::string text;
    std::string entry;  ///< of the first phase's result in that table: "/slices"
    double value;       ///< that the entry must have for the note to hold
};

/// Points that stand in a figure beside ours.
struct PaperPoints {
    std::string figure;
    Series series;
};

struct Paper {
    std::string source;
    std::vector<std::string> remarks;  ///< what must be said wherever a result is shown
    std::vector<PaperValue> values;
    std::vector<PaperPoints> points;
    std::vector<PaperNote> notes;
    std::string case_history_runout;  ///< as it is told: "> 800"
};

/// The paper of a scene; nothing when its name is not one of the paper's case.
std::optional<Paper> paper_for(const std::string& scene_name);

/// Adds the paper's points to the figure of that name.
void add_points(const std::optional<Paper>& paper, Figure& figure);

/// paper.json.
const char* paper_text();

}  // namespace breach::report
