// Published numbers for comparison with a scene. They come from paper.json, which is built into the
// program.
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
    std::string first_time = {};           ///< condition whose first time is compared
    std::optional<double> runout_at = {};  ///< the transfer time of the run's runout [s]
};

/// A note below a table that applies to the paper's case only.
struct PaperNote {
    std::string table;
    std::string text;
    std::string entry;  ///< of the first phase's result in that table: "/slices"
    double value;       ///< value of the entry for which the note applies
};

/// Points to draw beside the run's in a figure.
struct PaperPoints {
    std::string figure;
    Series series;
};

struct Paper {
    std::string source;
    std::vector<std::string> remarks;  ///< shown with every result
    std::vector<PaperValue> values;
    std::vector<PaperPoints> points;
    std::vector<PaperNote> notes;
    std::string case_history_runout;  ///< as published: "> 800"
};

/// The paper of a scene; nothing: the scene's name is not one of the paper's cases.
std::optional<Paper> paper_for(const std::string& scene_name);

/// Adds the paper's points to the figure of that name.
void add_points(const std::optional<Paper>& paper, Figure& figure);

const char* paper_text();

}  // namespace breach::report
