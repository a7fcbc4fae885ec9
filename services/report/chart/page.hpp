// A document as one self-contained HTML page: figures inside, no script, no network.
#pragma once

#include <string>

#include "services/report/chart/document.hpp"

namespace breach::report {

/// `figures`: folder of the figures' and tables' files, relative to the page, for links to them;
/// empty: there are none.
std::string as_html(const Document& document, const std::string& figures);

}  // namespace breach::report
