// `breach motion`: an engineer's first look at records, before a scene uses them, and a study made
// of a folder of them. The measures are computed here by core/motion, as fem_solver computes them,
// so that no server is needed; only the comparison of a finished study (--of) asks one.
#include "services/cli/motion.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ranges>

#include "core/check/applied_motion.hpp"
#include "core/fault/flag.hpp"
#include "core/motion/measures.hpp"
#include "core/motion/plausibility.hpp"
#include "services/cli/table.hpp"

namespace breach::cli {

using nlohmann::json;

namespace {

/// Read and scaled by the same code as a scene's motion (core/check), so that the measures are
/// those of the run.
motion::Recording acceleration_in(const std::filesystem::path& file, const MotionOptions& options) {
    motion::Recording motion =
        check::applied_motion({.file = file,
                               .scale_to_pga_g = options.scale_to_pga_g,
                               .baseline = options.corrected ? scene::Baseline::corrected
                                                             : scene::Baseline::as_recorded});
    if (motion.quantity == motion::Quantity::acceleration) return motion;
    throw fault::BadInput(file.string(),
                          {{"", "is no acceleration", "give the acceleration of the record"}});
}

/// Prints the warnings of a scene's check about this motion, scaled as the study scales it. Returns
/// whether the motion is possible.
bool tell_warnings(const std::filesystem::path& file, motion::Recording motion,
                   const MotionOptions& options, const Console& console) {
    if (!options.pga_g.empty())
        motion.series = motion::scaled_to_peak(std::move(motion.series),
                                               options.pga_g.front() * motion::standard_gravity);
    const auto flags = motion::warnings_about(motion, "");
    for (const fault::Flag& each : flags)
        console.notes << harmless(file.filename().string() + ": " + fault::name_of(each.severity) +
                                  ": " + each.message)
                      << "\n";
    return !fault::is_questionable(flags);
}

/// One record: its measures, then its response spectrum.
std::string as_text(const json& all) {
    const std::vector<Cells> rows{
        {"PGA", cell(all, "pga_g"), "g"},
        {"PGV", cell(all, "pgv"), "m/s"},
        {"PGD", cell(all, "pgd"), "m (baseline corrected)"},
        {"Arias intensity", cell(all, "arias"), "m/s"},
        {"D5-95", cell(all, "strong_duration"), "s, from " + cell(all, "strong_from") + " s"},
        {"CAV", cell(all, "cav"), "m/s"},
        {"MASI", cell(all, "masi"), "m/s (5 %, 0.1 to 2 s)"}};
    std::string text = as_table({{"measure"}, {"value", right}, {"unit"}}, rows);
    std::vector<Cells> spectrum;
    const json& of = all.at("spectrum");
    for (std::size_t i = 0; i < of.at("period").size(); ++i)
        spectrum.push_back({cell(of.at("period")[i]), cell(of.at("acceleration")[i])});
    return text + "\n" + as_table({{"period s", right}, {"5 % S_a m/s2", right}}, spectrum);
}

/// A record and the measures of motion::as_json().
struct Measured {
    std::filesystem::path file;
    json measures;
};

/// The records of a folder, sorted by name. Names and skips files that are not a record, or not a
/// possible motion.
/// Sorted, as a folder lists its files in any order: two calls must print the same study.
std::vector<Measured> records_in(const MotionOptions& options, const Console& console) {
    std::vector<std::filesystem::path> files;
    for (const auto& each : std::filesystem::directory_iterator(options.file))
        if (each.is_regular_file()) files.push_back(each.path());
    std::ranges::sort(files);
    std::vector<Measured> found;
    for (const auto& each : files) {
        try {
            const motion::Recording motion = acceleration_in(each, options);
            if (tell_warnings(each, motion, options, console))
                found.push_back({each, motion::as_json(motion::measures_of(motion.series))});
            else
                console.notes << each.filename().string() << ": left out\n";
        } catch (const fault::BadInput& error) {
            console.notes << each.filename().string() << ": left out: " << error.what() << "\n";
        }
    }
    if (found.empty())
        throw fault::BadInput(options.file.string(),
                              {{"", "holds no record", "give a folder of accelerations"}});
    return found;
}

/// A variant's name from the record's name and its peak: "el_centro_30"; numbered where another
/// record has this name.
/// At most 32 characters, and lower case, as the study's schema allows. The number and the peak
/// come from the end of that room, so that a long name cannot cut them off.
std::string variant_named(const std::filesystem::path& file, std::optional<double> pga_g,
                          const json& others) {
    std::string name;
    for (const char letter : file.stem().string()) {
        const bool plain = std::isalnum(static_cast<unsigned char>(letter)) != 0;
        name += plain ? static_cast<char>(std::tolower(static_cast<unsigned char>(letter))) : '_';
    }
    name.erase(0, name.find_first_not_of('_'));
    const std::string peak = pga_g ? "_" + std::to_string(std::lround(100.0 * *pga_g)) : "";
    for (int number = 1;; ++number) {
        const std::string end = (number > 1 ? "_" + std::to_string(number) : "") + peak;
        const std::string whole = shortened(name, 32 - end.size()) + end;
        const auto has_it = [&](const json& other) { return other.at("name") == whole; };
        if (std::ranges::none_of(others, has_it)) return whole;
    }
}

/// A study that applies each record at each peak, and transfers in the middle of the window.
/// Absolute paths: the study is printed, and the user may store it anywhere. The conditions of the
/// trigger are those of the shipped Mochikoshi studies.
json study_of(const std::vector<Measured>& records, const MotionOptions& options) {
    json variants = json::array();
    const auto add = [&](const Measured& each, std::optional<double> pga_g) {
        const auto file = std::filesystem::absolute(each.file).lexically_normal().string();
        json overrides{"/fem/motion/file=" + file};
        if (pga_g) overrides.push_back("/fem/motion/scale_to_pga_g=" + cell(json(*pga_g)));
        variants.push_back(
            {{"name", variant_named(each.file, pga_g, variants)}, {"overrides", overrides}});
    };
    for (const Measured& each : records) {
        if (options.pga_g.empty()) add(each, std::nullopt);
        for (const double pga_g : options.pga_g) add(each, pga_g);
    }
    return {{"format", "breachline-study/1"},
            {"name", "motions"},
            {"scene", std::filesystem::absolute(options.scene).lexically_normal().string()},
            {"variants", variants},
            {"triggers",
             {{{"kind", "window"},
               {"name", "window"},
               {"lower", "liquefaction_depth >= critical_depth and failure_surfaces >= 1"},
               {"upper", "jacobian_centre_avg < 0.97 or epsilon_q_avg > 0.2"},
               {"pick", "midpoint"}}}}};
}

/// Several records: a line each, without spectra.
std::string as_text(const std::vector<Measured>& records) {
    std::vector<Cells> rows;
    for (const auto& [file, all] : records)
        rows.push_back({file.filename().string(), cell(all, "pga_g"), cell(all, "pgv"),
                        cell(all, "pgd"), cell(all, "arias"), cell(all, "strong_duration"),
                        cell(all, "cav"), cell(all, "masi")});
    return as_table({{"record"},
                     {"PGA g", right},
                     {"PGV m/s", right},
                     {"PGD m", right},
                     {"Arias m/s", right},
                     {"D5-95 s", right},
                     {"CAV m/s", right},
                     {"MASI m/s", right}},
                    rows);
}

/// A correlation with its bounds; "-" where the server gives none.
std::string interval(const json& found) {
    return found.is_null() ? "-"
                           : cell(found, "value") + " (" + cell(found, "low") + " to " +
                                 cell(found, "high") + ")";
}

/// Sentences first: they are the answer, the table is their evidence.
std::string found_as_text(const json& found) {
    std::string text;
    for (const json& each : found.at("sentences")) text += harmless(each.get<std::string>()) + "\n";
    std::vector<Cells> rows;
    for (const json& each : found.at("measures")) {
        const json& curve = each.at("fragility");
        rows.push_back({each.at("title"), interval(each.at("with_depth")),
                        interval(each.at("with_runout")),
                        curve.contains("refused")
                            ? curve.at("refused").get<std::string>()
                            : cell(curve, "median") + " " + each.at("unit").get<std::string>() +
                                  " (" + cell(curve, "low") + " to " + cell(curve, "high") + ")"});
    }
    return text + "\n" +
           as_table({{"measure"}, {"with liquefied depth"}, {"with runout"}, {"half past the toe"}},
                    rows);
}

}  // namespace

/// Three uses by what was named: a run, a folder, one record. Only the first asks the server. A
/// record that no earthquake can have is shown, and the exit code refuses it.
fault::ExitCode show_motion(Server& server, const MotionOptions& options, const Console& console) {
    const auto show = [&](const json& answer, const auto& text) {
        if (!shown_as_json(answer, console)) console.out << text();
    };
    if (!options.run.empty()) {
        const json found = server.get(path_of({"runs", run_named(server, options.run), "motions"}));
        show(found, [&] { return found_as_text(found); });
    } else if (std::filesystem::is_directory(options.file)) {
        const auto records = records_in(options, console);
        json all;
        for (const auto& [file, measures] : records) all[file.filename().string()] = measures;
        if (!options.scene.empty())
            show_json(study_of(records, options), console);
        else
            show(all, [&] { return as_text(records); });
    } else {
        const motion::Recording motion = acceleration_in(options.file, options);
        const json all = motion::as_json(motion::measures_of(motion.series));
        show(all, [&] { return as_text(all); });
        if (!tell_warnings(options.file, motion, options, console))
            return fault::ExitCode::bad_input;
    }
    return fault::ExitCode::done;
}

}  // namespace breach::cli
