// The motion as the FEM took it: acceleration, velocity, Arias intensity.
#include <cmath>
#include <numbers>

#include "core/motion/read_motion.hpp"
#include "services/report/chapters.hpp"

namespace breach::report {

using nlohmann::json;

namespace {

constexpr double g = motion::standard_gravity;

/// Given by the reader, or where the scene says, beside the run's files; empty when it is nowhere.
std::filesystem::path motion_file(const Material& from, const PhaseFolder& fem,
                                  const std::string& named) {
    if (!from.choice.motion.empty()) return from.choice.motion;
    const std::filesystem::path file(named);
    for (const auto& each : {fem.files / file, fem.files / file.filename()}) {
        if (std::filesystem::is_regular_file(each)) return each;
    }
    return {};
}

/// Acceleration as the scene scales it; of a recorded velocity its differences are not taken.
std::optional<motion::Series> acceleration_of(const motion::Recording& recording,
                                              const json& wanted) {
    if (recording.quantity != motion::Quantity::acceleration) return {};
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
    return {name, {title, {"time [s]"}, {label}, {s}}};
}

/// pi / (2 g) times the integral of a^2 up to each time.
motion::Series arias_course(const motion::Series& a) {
    motion::Series squares = a;
    for (double& each : squares.values) each *= each * std::numbers::pi / (2.0 * g);
    return motion::integral(squares);
}

}  // namespace

void add_motion(const Material& from, Document& document) {
    const std::string what = "acceleration, velocity and Arias intensity of the motion";
    const PhaseFolder* fem = phase_named(from.run, "fem_solver");
    const json wanted =
        fem && fem->scene.contains("fem") ? fem->scene.at("fem").value("motion", json()) : json();
    if (!wanted.is_object()) {
        document.left_out.push_back({what, "the scene has no motion (/fem/motion)"});
        return;
    }
    const auto file = motion_file(from, *fem, wanted.at("file"));
    if (file.empty()) {
        document.left_out.push_back({what, "the run's folder does not hold " +
                                               wanted.at("file").get<std::string>() +
                                               "; give it with --motion"});
        return;
    }
    const motion::Recording recording = motion::read_motion(file);
    const auto a = acceleration_of(recording, wanted);
    if (!a) {
        document.left_out.push_back({what, file.string() + " is not an acceleration"});
        return;
    }
    const motion::Series v = motion::integral(*a);
    const motion::StrongPart strong = motion::strong_part(*a);
    Chapter chapter{"Motion", recording.title + ", as the FEM took it: PGA " +
                                  rounded(motion::peak(*a) / g, 3) + " g, PGV " +
                                  rounded(100.0 * motion::peak(v), 3) + " cm/s, Arias intensity " +
                                  rounded(motion::arias_intensity(*a), 3) +
                                  " m/s, strong shaking (5 to 95 % of it) from " +
                                  rounded(strong.begin, 3) + " to " + rounded(strong.end, 3) +
                                  " s."};
    chapter.figures = {figure_of("motion_acceleration", "acceleration", "acceleration [g]", *a, g),
                       figure_of("motion_velocity", "velocity", "velocity [cm/s]", v, 0.01),
                       figure_of("motion_arias", "Arias intensity", "Arias intensity [m/s]",
                                 arias_course(*a), 1.0)};
    document.chapters.push_back(std::move(chapter));
}

}  // namespace breach::report
