// Writes a run as a page: `report RUN --output F`.
#pragma once

#include "services/report/chapters/chapters.hpp"

namespace breach::report {

/// The content of the page. Throws IoError or BadInput.
Document document_of(const Run& run, const Choice& choice);

enum class Files { beside_the_page, none };
/// Writes the page. With files, also each figure as SVG, PNG and CSV and each table as CSV into a
/// folder beside it ("report.html": "report_files"); without rsvg-convert the PNGs are missing and
/// the page says so. Throws IoError.
void write_report(Document document, const std::filesystem::path& page,
                  Files files = Files::beside_the_page);

}  // namespace breach::report
