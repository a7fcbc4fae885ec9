// HDF5 is written to a file and read back, because core/exchange publishes files only. alone(): one
// thread at a time uses the library.
#include "services/orchestrator/http/results_file.hpp"

#include <algorithm>
#include <limits>
#include <ranges>

#include "core/exchange/archive.hpp"
#include "services/orchestrator/http/http_routes.hpp"
#include "services/orchestrator/records/identity.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

constexpr std::int64_t not_known = -1;

double as_real(const json& value) {
    return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

/// A value as one line of a column of text.
std::string as_line(const json& value) {
    std::string line = value.is_null()    ? ""
                       : value.is_array() ? codes_of(value)
                                          : value.get<std::string>();
    // A line per row is the format; a reason may have several.
    std::ranges::replace(line, '\n', ' ');
    return line + "\n";
}

void add_column(exchange::Archive& archive, const ResultTable& table, std::size_t place) {
    const ResultColumn& column = table.columns[place];
    const auto values =
        table.rows |
        std::views::transform([&](const ResultRow& row) -> const json& { return row[place]; });
    if (*column.unit != '\0') archive.units[column.name] = column.unit;
    switch (column.kind) {
        case ColumnKind::number:
            for (auto& reals = archive.reals[column.name]; const json& each : values)
                reals.push_back(as_real(each));
            return;
        case ColumnKind::yes_no:
            for (auto& integers = archive.integers[column.name]; const json& each : values)
                integers.push_back(each.is_null() ? not_known : std::int64_t{each.get<bool>()});
            return;
        case ColumnKind::word:
        case ColumnKind::flags:
            for (auto& text = archive.texts[column.name]; const json& each : values)
                text += as_line(each);
            return;
    }
}

exchange::Archive archive_of(const ResultTable& table, const std::string& run) {
    exchange::Archive archive{.kind = table.kind,
                              .version = 1,
                              .reals = {},
                              .integers = {},
                              .texts = {{"run", run}},
                              .units = {}};
    for (std::size_t i = 0; i < table.columns.size(); ++i) add_column(archive, table, i);
    return archive;
}

}  // namespace

std::string as_hdf5(const ResultTable& table, const std::string& run, const std::string& scene,
                    FrameReader& hdf5, const std::filesystem::path& scratch) {
    const auto file = scratch / (new_run_id() + ".h5");
    hdf5.alone([&] {
        exchange::Provenance provenance;
        provenance.phase = "breachline";
        provenance.scene = scene;
        exchange::write_archive(file, archive_of(table, run), provenance);
    });
    std::string bytes = whole_text(file);
    std::filesystem::remove(file);
    return bytes;
}

}  // namespace breach::orchestrator
