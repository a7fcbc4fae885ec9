// Words for the accuracy page, the CLI and the report. A number appears with its noise, or with
// what would measure it.
#include "services/orchestrator/accuracy/sentences.hpp"

#include <algorithm>
#include <array>

#include "core/statistics/repeats.hpp"
#include "core/words/number.hpp"

namespace breach::orchestrator {

namespace {

std::string shown(double value, const char* format = "%.4g") {
    return words::formatted(format, value);
}

std::string percent(double share) {
    return shown(100.0 * share, share < 0.995 ? "%.2g" : "%.0f") + " %";
}

std::string with_unit(double value, const Quantity& quantity) {
    return shown(value) + (quantity.unit == "1" ? "" : " " + quantity.unit);
}

/// Empty: repeats of the quantity do not scatter.
std::string how_to_measure_noise(const AccuracyPlan& plan) {
    if (can_redraw(Redrawn::points, plan.quantity.reach)) return "set \"draws\" to measure it";
    return can_redraw(Redrawn::fem, plan.quantity.reach)
               ? "set \"draws\" and \"draws_of\": \"fem\" to measure it"
               : "";
}

std::string noise_in_words(const statistics::Convergence& convergence, const AccuracyPlan& plan) {
    if (convergence.noise)
        return "; one run scatters by " + with_unit(convergence.noise->deviation, plan.quantity);
    const std::string remedy = how_to_measure_noise(plan);
    return remedy.empty() ? "" : "; the noise of one run is not known, " + remedy;
}

/// Where the noise leaves the order uncertain: its range, and how to narrow it.
std::string order_in_words(const statistics::Convergence& convergence) {
    std::string words = "order " + shown(*convergence.order, "%.2g");
    if (!convergence.order_by_noise) return words;
    const auto [low, high] = *convergence.order_by_noise;
    // A range within a factor of two is no news.
    if (high <= 2.0 * low) return words;
    return words + " (by the noise anything from " + shown(low, "%.2g") + " to " +
           shown(high, "%.2g") + "; use rungs farther apart or more repeats)";
}

std::string setting_in_words(const AccuracyTable& table, const AccuracyRow& row) {
    const Ladder& ladder = table.plan.ladders[row.setting.ladder];
    std::string words = ladder.name + ":";
    for (const std::string& each : ladder.steps[row.setting.step]) words += " " + each;
    return words;
}

/// Ladders whose error of the base is unknown, so that the other ladders' rows lack it.
std::string left_out(const AccuracyTable& table, const AccuracyRow& row) {
    if (table.plan.reference.kind == ReferenceKind::given) return "";
    std::string names;
    for (std::size_t i = 0; i < table.ladders.size(); ++i)
        if (i != row.setting.ladder && !table.ladders[i].of_base)
            names += (names.empty() ? "" : ", ") + table.plan.ladders[i].name;
    return names.empty() ? "" : "; without the error of " + names + ", not known at the base";
}

/// "one run", "the mean of 4 draws"
std::string mean_in_words(std::size_t draws) {
    return draws == 1 ? "one run" : "the mean of " + std::to_string(draws) + " repeats";
}

std::string cost_in_words(double cpu_seconds) { return shown(cpu_seconds, "%.3g") + " CPU s"; }

/// "one run is off by 4.8 %, 0.231 CPU s"
std::string run_in_words(const AccuracyTable& table, const AccuracyRow& row) {
    return "one run is off by " + percent(*row.error_of_a_run) + left_out(table, row) + "; " +
           cost_in_words(row.cost->cpu_seconds);
}

/// Contributions of the ladders to the error of a run, without small ones.
/// For the setting that is nearest but not good enough: it says which ladder to refine.
std::string shares_of(const AccuracyTable& table, const AccuracyRow& row) {
    if (table.plan.reference.kind == ReferenceKind::given) return "";
    constexpr double told = 0.05;  // of the whole
    std::string words;
    const auto tell = [&](const std::string& ladder,
                          const std::optional<statistics::Share>& share) {
        if (!share || share->error < told * *row.error_of_a_run) return;
        words += (words.empty() ? " It is off by " : ", ") + percent(share->error) + " by " +
                 ladder + (share->told ? "" : " (within the noise)");
    };
    tell(table.plan.ladders[row.setting.ladder].name, row.of_own_ladder);
    for (std::size_t i = 0; i < table.ladders.size(); ++i)
        if (i != row.setting.ladder) tell(table.plan.ladders[i].name, table.ladders[i].of_base);
    return words.empty() ? "" : words + ".";
}

/// Error of the mean over the largest number of repeats that a mean may have.
double error_of_means(const AccuracyTable& table, const AccuracyRow& row) {
    return statistics::promised_error(*row.bias, *row.value,
                                      *table.ladders[row.setting.ladder].reference,
                                      statistics::most_draws_of_a_mean);
}

/// The row whose means come nearest to the requested error; nothing: none can be recommended.
const AccuracyRow* nearest(const AccuracyTable& table) {
    const AccuracyRow* best = nullptr;
    for (const AccuracyRow& each : table.rows) {
        if (!can_be_offered(table, each)) continue;
        if (best == nullptr || error_of_means(table, each) < error_of_means(table, *best))
            best = &each;
    }
    return best;
}

/// Ladders without an error because their sizes are missing.
std::string sizes_to_give(const AccuracyTable& table) {
    std::string names;
    for (std::size_t i = 0; i < table.ladders.size(); ++i)
        if (table.ladders[i].lacks_sizes)
            names += (names.empty() ? "" : ", ") + table.plan.ladders[i].name;
    return names.empty() ? "" : "; \"sizes\" give the error of " + names;
}

std::string recommended_in_words(const AccuracyTable& table, const AccuracyRow& row) {
    const MeanOfDraws& mean = *row.mean_within_asked;
    const std::string setting = setting_in_words(table, row);
    const std::string asked = percent(table.plan.asked_error);
    const std::string remedy = how_to_measure_noise(table.plan);
    // Without repeats, nothing can be said of nine of ten runs.
    if (!row.value->deviation)
        return "The cheapest setting within " + asked + " is " + setting + " (" +
               run_in_words(table, row) + ")" +
               (remedy.empty() ? "" : "; its scatter is not known, " + remedy) + ".";
    return "The cheapest within " + asked + " is " + mean_in_words(mean.draws) + " of " + setting +
           ": nine of ten " + (mean.draws == 1 ? "runs" : "such means") + " are within " +
           percent(mean.error) + " at " + cost_in_words(mean.cpu_seconds) + " (" +
           run_in_words(table, row) + ").";
}

}  // namespace

std::string course_in_words(const statistics::Convergence& convergence, const AccuracyPlan& plan,
                            std::size_t ladder) {
    std::string words;
    switch (convergence.course) {
        case statistics::Course::too_few:
            words = "fewer than three rungs have a value: no order";
            break;
        case statistics::Course::oscillating:
            words = "the three finest rungs go up and down: no order";
            break;
        case statistics::Course::not_falling:
            words =
                "the differences of the three finest rungs do not fall towards a limit: no "
                "order";
            break;
        case statistics::Course::no_effect:
            return "all rungs give the same to the last digit: the quantity does not depend on "
                   "what the ladder changes";
        case statistics::Course::below_noise:
            words =
                "the two finest rungs differ by no more than the noise of the repeats: no "
                "order";
            break;
        case statistics::Course::monotone:
            if (plan.ladders[ladder].sizes.empty()) {
                words = "the three finest rungs fall monotonically: no order";
                break;
            }
            words = order_in_words(convergence) + ", limit " +
                    with_unit(*convergence.limit, plan.quantity);
            if (convergence.gci)
                words += ", grid convergence index of the finest " + percent(*convergence.gci);
    }
    if (convergence.spread && convergence.course != statistics::Course::monotone)
        words += "; spread " + with_unit(*convergence.spread, plan.quantity);
    if (plan.ladders[ladder].sizes.empty() && statistics::rests_on_sizes(convergence.course))
        words += "; error of the finest rung unknown: give \"sizes\", how coarse each rung is";
    return words + noise_in_words(convergence, plan);
}

std::string reference_in_words(const Reference& reference) {
    switch (reference.kind) {
        case ReferenceKind::finest:
            break;
        case ReferenceKind::richardson:
            return "Richardson's limit of each ladder";
        case ReferenceKind::given:
            return shown(reference.value) + " (" + reference.source + ")";
    }
    return "the finest rung of each ladder";
}

std::string recommendation_in_words(const AccuracyTable& table) {
    const std::string asked = percent(table.plan.asked_error);
    if (table.recommended) return recommended_in_words(table, table.rows[*table.recommended]);
    const AccuracyRow* best = nearest(table);
    if (best == nullptr)
        return "No setting can be recommended: no rung that can be relied on has an error yet" +
               sizes_to_give(table) + ".";
    std::string words = "No setting meets " + asked;
    if (best->value->deviation)
        words +=
            ", nor the mean of " + std::to_string(statistics::most_draws_of_a_mean) + " repeats";
    words += "; the nearest is " + setting_in_words(table, *best) + " (";
    // More repeats cannot help: only a finer setting can.
    if (best->value->deviation && *best->bias > table.plan.asked_error)
        words += "its own error is " + percent(*best->bias) + ", for any number of repeats; ";
    else if (best->value->deviation)
        words += "nine of ten such means are within " + percent(error_of_means(table, *best)) +
                 ", the scatter being known from " + std::to_string(best->value->count) +
                 " repeats; ";
    return words + run_in_words(table, *best) + ")." + shares_of(table, *best);
}

}  // namespace breach::orchestrator
