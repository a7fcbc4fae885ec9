#include "services/cli/motion.hpp"

#include <nlohmann/json.hpp>

#include "core/check/applied_motion.hpp"
#include "core/motion/measures.hpp"
#include "services/cli/table.hpp"

namespace breach::cli {

using nlohmann::json;

namespace {

motion::Series acceleration_in(const MotionWish& wish) {
    const motion::Recording motion = check::applied_motion(
        {.file = wish.file,
         .scale_to_pga_g = wish.scale_to_pga_g,
         .baseline = wish.corrected ? scene::Baseline::corrected : scene::Baseline::as_recorded});
    if (motion.quantity == motion::Quantity::acceleration) return motion.series;
    throw fault::BadInput(wish.file.string(),
                          {{"", "is no acceleration", "give the acceleration of the record"}});
}

std::string as_text(const json& all) {
    const std::vector<Cells> rows{
        {"PGA", cell(all, "pga_g"), "g"},
        {"PGV", cell(all, "pgv"), "m/s"},
        {"PGD", cell(all, "pgd"), "m (baseline corrected)"},
        {"Arias intensity", cell(all, "arias"), "m/s"},
        {"D5-95", cell(all, "strong_duration"), "s, from " + cell(all, "strong_from") + " s"},
        {"CAV", cell(all, "cav"), "m/s"},
        {"MASI", cell(all, "masi"), "m/s (5 %, 0.1 to 2 s)"}};
    std::string text =
        as_table({{"measure", Align::left}, {"value", Align::right}, {"unit", Align::left}}, rows);
    std::vector<Cells> spectrum;
    const json& of = all.at("spectrum");
    for (std::size_t i = 0; i < of.at("period").size(); ++i)
        spectrum.push_back({cell(of.at("period")[i]), cell(of.at("acceleration")[i])});
    return text + "\n" +
           as_table({{"period s", Align::right}, {"5 % S_a m/s2", Align::right}}, spectrum);
}

}  // namespace

fault::ExitCode show_motion(const MotionWish& wish, const Console& console) {
    const json all = motion::as_json(motion::measures_of(acceleration_in(wish)));
    if (console.style == Style::json)
        show_json(all, console);
    else
        console.out << as_text(all);
    return fault::ExitCode::done;
}

}  // namespace breach::cli
