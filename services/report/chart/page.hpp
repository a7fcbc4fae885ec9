// A document as one self-contained HTML page: figures inside, no script, no network.
#pragma once

#include <string>

#include "services/report/chart/document.hpp"

namespace breach::report {

/// `figures`: folder with the files of figures and tables, relative to the page, for links; empty:
/// no links.
std::string as_html(const Document& document, const std::string& figures);

}  // namespace breach::report
