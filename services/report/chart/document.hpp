// What a report consists of before it is written: chapters of figures and tables, and what is left
// out.
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
    std::string drawing = {};  ///< SVG above all else, without numbers of its own; empty: none
    std::vector<std::string> cautions = {};  ///< what is to be known first, below the text
    bool opens_page = false;                 ///< when it is printed
};

/// A figure that a full report has and this one has not.
struct LeftOut {
    std::string what;
    std::string why;
};

/// What must be known before the numbers are believed, in sentences.
struct Verdict {
    std::string word = {};                   ///< "questionable"; empty: the sentences say it all
    bool usable = true;                      ///< false: no number of it can be used
    std::vector<std::string> cautions = {};  ///< a number is a bound, is wrong or cannot be trusted
    std::vector<std::string> notes = {};     ///< all else, and that there is nothing
};

/// The first page, which a reader can sign: what was asked, what comes out, and within which limits.
struct Front {
    std::string of = {};  ///< which run of which scene by which version
    std::vector<std::pair<std::string, std::string>> people = {};  ///< "client" and who that is
    std::string headline = {};               ///< what comes out, in one sentence
    std::vector<Figure> pictures = {};       ///< the section before and after
    std::vector<std::string> asked = {};     ///< in sentences
    Table found = {};                        ///< without rows: nothing came out
    Table gauges = {};                       ///< of the governing runout, one column each
    std::vector<std::string> limits = {};    ///< of the model, in sentences
    std::string author = {}, reviewer = {};  ///< who sign
};

struct Document {
    std::string title;
    std::vector<std::string> remarks;  ///< what everybody must know first, beside the limits
    std::vector<Chapter> chapters;
    std::vector<LeftOut> left_out;
    Verdict verdict = {};  ///< above the remarks; empty: nothing is said
    Front front = {};      ///< above all else; what is empty of it is not shown
};

/// Comma-separated, heads first; every cell quoted that is not a number. Throws
/// std::invalid_argument when a row is not as long as the heads.
std::string as_csv(const Table& table);

}  // namespace breach::report
