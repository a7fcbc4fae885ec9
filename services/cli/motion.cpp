#include "services/cli/motion.hpp"

#include <nlohmann/json.hpp>

#include "core/motion/measures.hpp"
#include "core/motion/read_motion.hpp"
#include "services/cli/table.hpp"

namespace breach::cli {

using nlohmann::json;

namespace {

motion::Series acceleration_in(const MotionWish& wish) {
    const motion::Recording recording = motion::read_motion(wish.file);
    if (recording.quantity != motion::Quantity::acceleration)
        throw fault::BadInput(wish.file.string(),
                              {{"", "is no acceleration", "give the acceleration of the record"}});
    motion::Series a = recording.series;
    if (wish.corrected) a = motion::base_corrected(std::move(a));
    if (wish.scale_to_pga_g)
        a = motion::scaled_to_peak(std::move(a), *wish.scale_to_pga_g * motion::standard_gravity);
    return a;
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
