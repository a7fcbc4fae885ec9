// Combines envelopes of samples column by column. Samples may have different grids: each is read
// at the x of the coarsest one. Where a flow did not arrive, depths count as 0 and times as
// never, so that a percentile of arrival is unknown unless enough samples arrived.
#include "services/outflow/envelopes.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

#include "core/fault/fault.hpp"

namespace breach::outflow {

using nlohmann::json;

namespace {

/// Sorts behind all times; the percentile turns it into unknown.
constexpr double never = std::numeric_limits<double>::infinity();
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
/// Must equal what mpm_solver writes: another header is another version, and its columns could
/// mean something else.
constexpr std::string_view header =
    "x_m,largest_depth_m,largest_velocity_m_per_s,largest_momentum_flux_m3_per_s2,arrival_s,"
    "time_of_peak_s,final_depth_m";
constexpr std::size_t columns = 7;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& cause) {
    throw fault::BadInput(file.string(), {{"", cause, "run mpm_solver again: it writes it"}});
}

std::string text_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    if (!stream) throw fault::IoError(file.string() + ": cannot be read");
    return std::move(text).str();
}

/// Numbers of a line; an empty cell is NaN. False: not such a line.
bool read_line(std::string_view line, std::array<double, columns>& values) {
    for (std::size_t c = 0; c < columns; ++c) {
        const std::string_view cell = line.substr(0, line.find(','));
        const bool last = cell.size() == line.size();
        if (last != (c + 1 == columns)) return false;
        values[c] = unknown;
        if (!cell.empty()) {
            const auto [end, error] =
                std::from_chars(cell.data(), cell.data() + cell.size(), values[c]);
            if (error != std::errc{} || end != cell.data() + cell.size()) return false;
        }
        if (!last) line.remove_prefix(cell.size() + 1);
    }
    return true;
}

bool is_a_time(std::string_view quantity) {
    return quantity == "arrival" || quantity == "time_of_peak";
}

/// Value of a sample at any x: linear between columns, for times only where both columns have one;
/// beyond the columns as where the flow never arrived.
double value_at(const std::vector<double>& x, const std::vector<double>& values, double at,
                bool time) {
    const double absent = time ? never : 0.0;
    if (x.empty() || at < x.front() || at > x.back()) return absent;
    const auto right = std::lower_bound(x.begin(), x.end(), at) - x.begin();
    const auto known = [&](std::ptrdiff_t k) { return std::isnan(values[k]) ? absent : values[k]; };
    if (x[right] == at) return known(right);
    const double a = known(right - 1);
    const double b = known(right);
    if (!std::isfinite(a) || !std::isfinite(b)) return absent;
    return a + (b - a) * (at - x[right - 1]) / (x[right] - x[right - 1]);
}

/// Not core/statistics' percentile, which refuses few samples and gives intervals: a band has no
/// room for either.
double percentile(const std::vector<double>& ascending, double share) {
    const double place = share * static_cast<double>(ascending.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const double rest = place - static_cast<double>(below);
    const double low = ascending[below];
    const double value = rest > 0.0 ? low + rest * (ascending[below + 1] - low) : low;
    return std::isfinite(value) ? value : unknown;
}

/// A finer grid would show steps of the coarser ones as if they were results.
const std::vector<double>& coarsest_x(std::span<const Envelope> samples) {
    const auto spacing = [](const Envelope& each) {
        return (each.x.back() - each.x.front()) / static_cast<double>(each.x.size() - 1);
    };
    return std::max_element(samples.begin(), samples.end(),
                            [&](const auto& a, const auto& b) { return spacing(a) < spacing(b); })
        ->x;
}

json numbers(const std::vector<double>& values) {
    json list = json::array();
    for (const double value : values) list.push_back(std::isnan(value) ? json() : json(value));
    return list;
}

}  // namespace

Envelope read_envelope(const std::filesystem::path& file) {
    const std::string text = text_of(file);
    std::string_view rest = text;
    const auto next = [&] {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(rest.size(), line.size() + 1));
        return line;
    };
    if (next() != header) refuse(file, "is no envelope of this version");
    Envelope envelope;
    std::array<double, columns> values{};
    while (!rest.empty()) {
        if (!read_line(next(), values)) refuse(file, "has a line that is not seven numbers");
        const bool ascends = envelope.x.empty() || values[0] > envelope.x.back();
        if (!ascends || std::isnan(values[0])) refuse(file, "has an x that does not ascend");
        envelope.x.push_back(values[0]);
        std::size_t c = 1;
        for_each_quantity(envelope,
                          [&](auto, auto, auto& quantity) { quantity.push_back(values[c++]); });
    }
    if (envelope.x.size() < 2) refuse(file, "has fewer than two columns of the grid");
    return envelope;
}

Ensemble ensemble_of(std::span<const Envelope> samples) {
    Ensemble ensemble;
    ensemble.samples = samples.size();
    if (samples.empty()) return ensemble;
    ensemble.x = coarsest_x(samples);
    ensemble.reached.assign(ensemble.x.size(), 0);
    for_each_quantity(samples.front(), [&](const char* name, const char* unit, const auto&) {
        ensemble.bands.push_back({name, unit, {}, {}, {}, {}});
    });
    // The same vector for all places: one value per sample, sorted anew for each quantity.
    std::vector<double> drawn(samples.size());
    for (std::size_t k = 0; k < ensemble.x.size(); ++k) {
        for (std::size_t b = 0; b < ensemble.bands.size(); ++b) {
            Band& band = ensemble.bands[b];
            for (std::size_t s = 0; s < samples.size(); ++s) {
                std::size_t q = 0;
                for_each_quantity(samples[s], [&](const char* name, auto, const auto& values) {
                    if (q++ == b)
                        drawn[s] = value_at(samples[s].x, values, ensemble.x[k], is_a_time(name));
                });
            }
            const auto finite = static_cast<std::size_t>(
                std::ranges::count_if(drawn, [](double v) { return std::isfinite(v); }));
            std::ranges::sort(drawn);
            band.p10.push_back(percentile(drawn, 0.1));
            band.p50.push_back(percentile(drawn, 0.5));
            band.p90.push_back(percentile(drawn, 0.9));
            band.rests_on.push_back(finite);
            // Depths are finite everywhere, also where nothing came; only an arrival says that it
            // did.
            if (band.quantity == "arrival") ensemble.reached[k] = finite;
        }
    }
    return ensemble;
}

json as_json(const Envelope& envelope) {
    json body{{"x", envelope.x}};
    for_each_quantity(envelope, [&](const char* name, const char* unit, const auto& values) {
        body[name] = {{"unit", unit}, {"values", numbers(values)}};
    });
    return body;
}

json as_json(const Ensemble& ensemble) {
    json bands = json::object();
    for (const Band& band : ensemble.bands)
        bands[band.quantity] = {{"unit", band.unit},
                                {"p10", numbers(band.p10)},
                                {"p50", numbers(band.p50)},
                                {"p90", numbers(band.p90)},
                                {"rests_on", band.rests_on}};
    return {{"samples", ensemble.samples},
            {"x", ensemble.x},
            {"reached", ensemble.reached},
            {"bands", bands}};
}

}  // namespace breach::outflow
