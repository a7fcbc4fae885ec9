// What must be known before the numbers of an assessment are believed: what they rest on, and what they
// do not say.
#include "services/report/chapters/assessment.hpp"
#include "services/report/read/samples.hpp"
#include "services/report/read/verdict.hpp"

namespace breach::report {

using nlohmann::json;

namespace {

std::string failed_caution(const json& samples) {
    if (samples.at("failed") == 0) return "";
    return count_of(samples.at("failed"), "sample") + " of " + samples.at("planned").dump() +
           " left no result and are in no number here. If they are the ones that run farthest, "
           "every percentile is too small.";
}

std::string standing_caution(const json& samples) {
    if (samples.value("no_transfer", json(0)) == 0) return "";
    return "Of " + count_of(samples.at("no_transfer"), "sample") + " of " +
           samples.at("planned").dump() +
           " nothing was transferred: their FEM ended, and its triggers had not fired. If the dam "
           "stands there, nothing runs out: every number here is of the samples that were let go.";
}

std::string moving_caution(const Run& run) {
    const auto moving = moving_samples(run);
    if (moving.empty()) return "";
    return std::to_string(moving.size()) + " of " + std::to_string(sampled_runouts(run).size()) +
           " samples were stopped while their soil still moved (flag \"still moving\"): their "
           "distances are lower bounds, and so is every percentile at or above the least of them "
           "(marked \u2265). How far they would have gone is not known, and what ranks or fits the "
           "samples (importance, tornado) takes them as they are; let them run longer "
           "(/mpm/duration).";
}

std::string few_caution(const json& quantity) {
    std::string lacking;
    for (const double p : {5.0, 10.0, 50.0, 90.0, 95.0})
        if (!percentile_in(quantity, p)) lacking += (lacking.empty() ? "p" : ", p") + rounded(p, 2);
    if (lacking.empty()) return "";
    return "Not told for lack of samples: " + lacking + ". " + quantity.at("count").dump() +
           " have a result.";
}

std::string cut_caution(const json& parameters) {
    std::string cut;
    for (const json& each : parameters)
        if (each.value("between", json()).is_array())
            cut += (cut.empty() ? "" : ", ") + each.at("name").get<std::string>();
    if (cut.empty()) return "";
    return "Nothing is drawn outside of the bounds given for " + cut +
           ": what lies beyond them is not rare here but impossible.";
}

std::string until_caution(const json& until) {
    if (!until.is_object() || until.value("reached", json(false)) == json(true)) return "";
    const json now = until.value("now", json());
    return "The study was to go on until p" + rounded(until.at("percentile").get<double>(), 4) +
           " of " + until.value("quantity", "the result") + " is known to \u00b1 " +
           rounded(100.0 * until.at("half_width").get<double>(), 3) + " % of its value; " +
           (now.is_number()
                ? "it is known to \u00b1 " + rounded(100.0 * now.get<double>(), 3) + " %."
                : std::string("so few samples do not tell it at all."));
}

std::string doubt_caution(const Run& run) {
    std::size_t doubtful = 0, unknown = 0;
    for (const PhaseFolder* each : sampled_runouts(run)) {
        if (certainty_of(*each) == Certainty::doubtful) ++doubtful;
        if (certainty_of(*each) == Certainty::unknown) ++unknown;
    }
    std::string text;
    if (doubtful > 0)
        text = std::to_string(doubtful) +
               " samples are questionable for other reasons than motion (table \"Flags\"); they "
               "are counted.";
    if (unknown > 0)
        text += (text.empty() ? "" : " ") + std::to_string(unknown) +
                " carry no flags: what may be wrong with them is not known.";
    return text;
}

}  // namespace

std::vector<std::string> cautions_of(const Run& run, const json& quantity) {
    const json& answer = run.uncertainty;
    std::vector<std::string> said{failed_caution(answer.at("samples")),
                                  standing_caution(answer.at("samples")),
                                  moving_caution(run),
                                  doubt_caution(run),
                                  few_caution(quantity),
                                  cut_caution(answer.at("parameters")),
                                  until_caution(answer.value("until", json()))};
    if (answer.at("samples").at("open") > 0)
        said.push_back(count_of(answer.at("samples").at("open"), "sample") +
                       " had not ended when this was written: the numbers will change.");
    std::erase(said, "");
    said.emplace_back(
        "Percentiles are over the parameters named below, as they are distributed there, and over "
        "nothing else. What the model leaves out (table of CDA's cases below) is in none of them.");
    return said;
}

}  // namespace breach::report
