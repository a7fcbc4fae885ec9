// The motion applied by the FEM: acceleration, velocity, Arias intensity.
#include <array>
#include <cmath>
#include <numbers>

#include "core/motion/measures.hpp"
#include "core/motion/read_motion.hpp"
#include "core/phases/files.hpp"
#include "core/phases/phases.hpp"
#include "services/report/chapters/chapters.hpp"

namespace breach::report {

using nlohmann::json;

namespace {

constexpr double g = motion::standard_gravity;

/// A motion on the disk, and whether the FEM has already scaled and corrected it.
struct Found {
    std::filesystem::path file;
    enum class As { applied, recorded } as;
};

/// The FEM's copy; without it the reader's file, or the file beside the run's files that the scene
/// names.
std::optional<Found> motion_file(const Material& from, const PhaseFolder& fem,
                                 const std::string& named) {
    const std::filesystem::path kept = fem.files / phases::files::motion;
    if (std::filesystem::is_regular_file(kept)) return Found{kept, Found::As::applied};
    if (!from.choice.motion.empty()) return Found{from.choice.motion, Found::As::recorded};
    const std::filesystem::path file(named);
    for (const auto& each : {fem.files / file, fem.files / file.filename()}) {
        if (std::filesystem::is_regular_file(each)) return Found{each, Found::As::recorded};
    }
    return {};
}

/// Acceleration, scaled as in the scene; nothing for a recorded velocity.
std::optional<motion::Series> acceleration_of(const motion::Recording& recording, Found::As as,
                                              const json& wanted) {
    if (recording.quantity != motion::Quantity::acceleration) return {};
    if (as == Found::As::applied) return recording.series;
    motion::Series a = recording.series;
    if (wanted.value("baseline", "") == "corrected") a = motion::base_corrected(std::move(a));
    if (wanted.contains("scale_to_pga_g")) {
        a = motion::scaled_to_peak(std::move(a), wanted.at("scale_to_pga_g").get<double>() * g);
    }
    return a;
}

Figure figure_of(const std::string& name, const std::string& title, const std::string& label,
                 const motion::Series& series, double unit) {
    Series s{title, {}, {}};
    for (std::size_t k = 0; k < series.values.size(); ++k) {
        s.x.push_back(static_cast<double>(k) * series.dt);
        s.y.push_back(series.values[k] / unit);
    }
    return {name, {title, {"time [s]"}, {label}, {s}}, "From below the mesh, horizontal."};
}

Figure velocity_figure(const motion::Series& v) {
    return figure_of("motion_velocity", "Velocity", "velocity [cm/s]", v, 0.01);
}

/// pi / (2 g) times the integral of a^2 up to each time.
motion::Series arias_course(const motion::Series& a) {
    motion::Series squares = a;
    for (double& each : squares.values) each *= each * std::numbers::pi / (2.0 * g);
    return motion::integral(squares);
}

/// The FEM's end [s] if the record is longer; without a result the end of its telemetry.
std::optional<double> end_within(const motion::Series& record, const PhaseFolder& fem) {
    std::optional<double> end;
    if (fem.result.is_object() && fem.result.value("end_time", json()).is_number()) {
        end = fem.result.at("end_time").get<double>();
    } else if (has_telemetry(fem)) {
        const Telemetry telemetry(fem.files / phases::files::telemetry);
        if (!telemetry.lines().empty()) end = telemetry.lines().back().time;
    }
    const double last = static_cast<double>(record.values.size()) - 1.0;
    return end && *end < (last - 0.5) * record.dt ? end : std::nullopt;
}

/// Share of the record before the FEM's end.
std::string felt_of(const motion::Series& a, double end) {
    motion::Series felt = a;
    felt.values.resize(static_cast<std::size_t>(end / a.dt + 1e-9) + 1);
    const double whole = motion::arias_intensity(a);
    std::string text = " That is of the whole record. The finite elements ended at " +
                       short_number(end) + " s: until then PGA " +
                       rounded(motion::peak(felt) / g, 3) + " g";
    if (felt.values.size() > 1 && whole > 0.0)
        text += " and " + rounded(100.0 * motion::arias_intensity(felt) / whole, 3) +
                " % of the Arias intensity";
    return text + ".";
}

std::string facts_of(const motion::Series& a) {
    const motion::StrongPart strong = motion::strong_part(a);
    return "PGA " + rounded(motion::peak(a) / g, 3) + " g, PGV " +
           rounded(100.0 * motion::peak(motion::integral(a)), 3) + " cm/s, Arias intensity " +
           rounded(motion::arias_intensity(a), 3) + " m/s, strong shaking (5 to 95 % of it) from " +
           rounded(strong.begin, 3) + " to " + rounded(strong.end, 3) + " s.";
}

std::vector<Figure> figures_of(const motion::Series& a) {
    return {figure_of("motion_acceleration", "Acceleration", "acceleration [g]", a, g),
            velocity_figure(motion::integral(a)),
            figure_of("motion_arias", "Arias intensity", "Arias intensity [m/s]", arias_course(a),
                      1.0)};
}

/// Intensity measures from the FEM's result, by place.
Table measures_table(const json& motions) {
    Table table{"motions", "What the motion is measured by", {""}, {}};
    table.caption =
        "PGD with the baseline corrected; MASI: integral of the 5 % pseudo-acceleration over "
        "periods of 0.1 to 2 s. The crest's is until the analysis ended.";
    for (const auto& [place, all] : motions.items()) table.columns.push_back(place);
    for (const motion::NamedMeasure& each : motion::named_measures) {
        table.rows.push_back({std::string(each.title) + " [" + each.unit + "]"});
        for (const auto& [place, all] : motions.items())
            table.rows.back().push_back(rounded(all.at(each.name), 3));
    }
    return table;
}

Figure spectra_of(const json& motions) {
    Chart chart{"Response spectra",
                {"period [s]", Scale::logarithmic},
                {"pseudo-acceleration, 5 % [g]"},
                {}};
    for (const auto& [place, all] : motions.items()) {
        Series s{place, all.at("/spectrum/period"_json_pointer), {}};
        for (const double each : all.at("/spectrum/acceleration"_json_pointer))
            s.y.push_back(each / g);
        chart.series.push_back(std::move(s));
    }
    return {"motion_spectra", std::move(chart), "Horizontal, of 5 % damping."};
}

}  // namespace

void add_motion(const Material& from, Document& document) {
    const std::string what = "acceleration, velocity and Arias intensity of the motion";
    const PhaseFolder* fem = phase_shown(from.run, phases::fem.program);
    const json wanted =
        fem && fem->scene.contains("fem") ? fem->scene.at("fem").value("motion", json()) : json();
    if (!wanted.is_object()) {
        document.left_out.push_back({what, "the scene has no motion (/fem/motion)"});
        return;
    }
    const std::string named = wanted.at("file");
    const auto found = motion_file(from, *fem, named);
    if (!found) {
        document.left_out.push_back(
            {what, "the run's folder does not hold " + named + "; give it with --motion"});
        return;
    }
    const motion::Recording recording = motion::read_motion(found->file);
    const std::string name = std::filesystem::path(named).filename();
    Chapter chapter{"Motion"};
    const auto end = end_within(recording.series, *fem);
    if (const auto a = acceleration_of(recording, found->as, wanted)) {
        chapter.text = name + ", as the FEM took it: " + facts_of(*a);
        if (end) chapter.text += felt_of(*a, *end);
        chapter.figures = figures_of(*a);
    } else {
        chapter.text = name + ", a velocity: PGV " +
                       rounded(100.0 * motion::peak(recording.series), 3) + " cm/s.";
        if (end)
            chapter.text += " That is of the whole record; the finite elements ended at " +
                            short_number(*end) + " s.";
        chapter.figures = {velocity_figure(recording.series)};
        document.left_out.push_back(
            {"acceleration and Arias intensity of the motion",
             "the scene gives its velocity (" + found->file.string() + ")"});
    }
    const json motions = fem->result.is_object() ? fem->result.value("motions", json()) : json();
    if (end)
        for (Figure& each : chapter.figures)
            each.chart.marks.push_back({Mark::At::x, *end, "finite elements end"});
    if (motions.is_object()) {
        chapter.tables.push_back(measures_table(motions));
        chapter.figures.push_back(spectra_of(motions));
    }
    document.chapters.push_back(std::move(chapter));
}

}  // namespace breach::report
