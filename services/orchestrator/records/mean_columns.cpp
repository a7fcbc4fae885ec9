// Titles and meanings of the means follow from those of the single results. The lists live as long
// as the program: a ResultColumn points to texts that someone must own.
#include "services/orchestrator/records/mean_columns.hpp"

#include <deque>

namespace breach::orchestrator {

namespace {

using enum ColumnKind;

/// Columns with generated names.
class MeanColumns {
  public:
    MeanColumns() {
        add({"transfer_time", "", number, "s", "t_T", "transfer time"});
        add({"variant", "", word, "", "variant", "of the study; empty: it has none"});
        add({"state", "", word, "", "state",
             "running: repeats are open; partial: a repeat has no result; questionable: a repeat "
             "is "
             "questionable; else the state of the repeats"});
        add({"draws", "", number, "1", "repeats", "repeats of the study"});
        add({"draws_done", "", number, "1", "done",
             "repeats with a result, over which the mean is taken"});
        for (const ResultColumn* each : averaged_columns()) {
            add({each->name, "", number, each->unit, each->title,
                 text("mean over the repeats: " + std::string(each->meaning))});
            add({text(deviation_of(each->name)), "", number, each->unit, *each->title ? "+-" : "",
                 text("standard deviation over the repeats; null: fewer than two have a result")});
        }
        add({"missing_draws", "", word, "", "",
             "repeats without a result, with their states; the mean leaves them out"});
        add({"questionable_draws", "", word, "", "",
             "repeats with a questionable result; the mean includes them"});
        add({"lower_bound", "", yes_no, "", "",
             "soil of a repeat still moved at the end: mean distances and areas are lower bounds"});
        add({"runout_error", "", number, "m", "",
             "error of the mean runout: the bias, from an accuracy study of an equal scene or of "
             "the cells, and t s / sqrt(n) of the n repeats with Student's 90 %; null: fewer than "
             "two have a runout"});
        add({"runout_error_from", "", word, "", "", "source of the error, or why it is not known"});
    }

    std::span<const ResultColumn> columns() const { return columns_; }

  private:
    void add(const ResultColumn& column) { columns_.push_back(column); }
    const char* text(std::string made) { return texts_.emplace_back(std::move(made)).c_str(); }

    std::deque<std::string> texts_;  // a deque: addresses stay valid
    std::vector<ResultColumn> columns_;
};

}  // namespace

std::vector<const ResultColumn*> averaged_columns() {
    std::vector<const ResultColumn*> found;
    for (const ResultColumn& each : result_columns())
        if (each.kind == number && *each.pointer != '\0') found.push_back(&each);
    return found;
}

std::string deviation_of(std::string_view column) { return std::string(column) + "_deviation"; }

std::span<const ResultColumn> mean_columns() {
    static const MeanColumns made;
    return made.columns();
}

}  // namespace breach::orchestrator
