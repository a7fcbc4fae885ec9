#include "services/orchestrator/records/mean_columns.hpp"

#include <deque>

namespace breach::orchestrator {

namespace {

using enum ColumnKind;

/// Columns with names that are made here.
class MeanColumns {
  public:
    MeanColumns() {
        add({"transfer_time", "", number, "s", "t_T", "transfer time"});
        add({"variant", "", word, "", "variant", "of the study; empty: it has none"});
        add({"state", "", word, "", "state",
             "running: draws are open; partial: a draw has no result; questionable: one is not to "
             "be relied on; else as that of the draws"});
        add({"draws", "", number, "1", "draws", "draws that were asked for"});
        add({"draws_done", "", number, "1", "done",
             "draws that have a result: the mean is theirs"});
        for (const ResultColumn* each : averaged_columns()) {
            add({each->name, "", number, each->unit, each->title,
                 text("mean over the draws: " + std::string(each->meaning))});
            add({text(deviation_of(each->name)), "", number, each->unit, *each->title ? "+-" : "",
                 text("standard deviation over the draws; null: fewer than two have a result")});
        }
        add({"missing_draws", "", word, "", "",
             "draws without a result, with their states; the mean is without them"});
        add({"questionable_draws", "", word, "", "",
             "draws whose results are not to be relied on; the mean has them in it"});
        add({"lower_bound", "", yes_no, "", "",
             "soil of a draw still moved at the end: mean distances and areas are lower bounds"});
        add({"runout_error", "", number, "m", "",
             "how far the mean runout is off: the bias that an accuracy study of an equal scene "
             "tells, "
             "if there is one, and t s / sqrt(draws), Student's 90 % for so few of them; null: "
             "nothing tells it"});
        add({"runout_error_from", "", word, "", "", "what tells the error, or why nothing does"});
    }

    std::span<const ResultColumn> columns() const { return columns_; }

  private:
    void add(const ResultColumn& column) { columns_.push_back(column); }
    const char* text(std::string made) { return texts_.emplace_back(std::move(made)).c_str(); }

    std::deque<std::string> texts_;  // whose addresses stay
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
