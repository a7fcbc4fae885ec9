// A run as a page: `report RUN --output F`.
#pragma once

#include "services/report/chapters/chapters.hpp"

namespace breach::report {

/// The content of the page. Throws IoError or BadInput.
Document document_of(const Run& run, const Choice& choice);

enum class Files { beside_the_page, none };
/// Writes the page, and beside it, in a folder named after it ("report.html": "report_files"), each
/// figure as SVG, PNG and CSV and each table as CSV. Without rsvg-convert the PNGs are left out and
/// the page says so; or the page alone. Throws IoError.
void write_report(Document document, const std::filesystem::path& page,
                  Files files = Files::beside_the_page);

}  // namespace breach::report
