// The published numbers for comparison with a scene. They are in paper.json, which is built into
// the program; none of them is in the code.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "services/report/chart/document.hpp"

namespace breach::report {

struct PaperValue {
    std::string key;   ///< key of the run's quantity: measures.hpp
    std::string what;  ///< in words
    std::string unit;
    double value;
    std::string first_time = {};           ///< the condition; compared with the run's first time
    std::optional<double> runout_at = {};  ///< the transfer time of the run's runout [s]
};

/// A note that applies to the paper's case only, below a table.
struct PaperNote {
    std::string table;
    std::string text;
    std::string entry;  ///< of the first phase's result in that table: "/slices"
    double value;       ///< value of the entry for which the note applies
};

/// Points of a figure beside the run's.
struct PaperPoints {
    std::string figure;
    Series series;
};

struct Paper {
    std::string source;
    std::vector<std::string> remarks;  ///< to be shown with every result
    std::vector<PaperValue> values;
    std::vector<PaperPoints> points;
    std::vector<PaperNote> notes;
    std::string case_history_runout;  ///< as published: "> 800"
};

/// The paper of a scene; nothing when its name is not one of the paper's case.
std::optional<Paper> paper_for(const std::string& scene_name);

/// Adds the paper's points to the figure of that name.
void add_points(const std::optional<Paper>& paper, Figure& figure);

/// paper.json.
const char* paper_text();

}  // namespace breach::report
