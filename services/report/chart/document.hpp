// The content of a report before it is written: chapters of figures and tables, and omissions.
#pragma once

#include <string>
#include <vector>

#include "services/report/chart/figure.hpp"

namespace breach::report {

struct Table {
    std::string name;  ///< of its CSV file
    std::string title;
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;
    std::string caption = {};
};

struct Chapter {
    std::string title;
    std::string text = {};
    std::vector<Figure> figures = {};
    std::vector<Table> tables = {};
    std::string drawing = {};  ///< SVG above everything else, not numbered; empty: none
    std::vector<std::string> cautions = {};  ///< shown first, below the text
    bool opens_page = false;                 ///< starts a new page in print
};

/// A figure of a full report that is missing here.
struct LeftOut {
    std::string what;
    std::string why;
};

/// Cautions to read before the numbers, in sentences.
struct Verdict {
    std::string word = {};                   ///< "questionable"; empty: only the sentences
    bool usable = true;                      ///< false: no number is usable
    std::vector<std::string> cautions = {};  ///< a number is a bound, is wrong or cannot be trusted
    std::vector<std::string> notes = {};     ///< other remarks, or that there are none
};

/// The first page, for signature: the question, the result, and its limits.
struct Front {
    std::string of = {};  ///< "run ... of scene ... by version ..."
    std::vector<std::pair<std::string, std::string>> people = {};  ///< "client" and the name
    std::string headline = {};               ///< the run's result in one sentence
    std::vector<Figure> pictures = {};       ///< the section before and after
    std::vector<std::string> asked = {};     ///< in sentences
    Table found = {};                        ///< without rows: there is no result
    Table gauges = {};                       ///< of the governing runout, one column each
    std::vector<std::string> limits = {};    ///< of the model, in sentences
    std::string author = {}, reviewer = {};  ///< the signatories
};

struct Document {
    std::string title;
    std::vector<std::string> remarks;  ///< shown first, beside the limits
    std::vector<Chapter> chapters;
    std::vector<LeftOut> left_out;
    Verdict verdict = {};  ///< above the remarks; empty: not shown
    Front front = {};      ///< above everything else; empty parts are not shown
};

/// Comma-separated, heads first; every cell that is not a number is quoted. Throws
/// std::invalid_argument when a row and the heads differ in length.
std::string as_csv(const Table& table);

}  // namespace breach::report
