// Rows, error and recommendation from the results so far. Means are over the repeats that have a
// value; a rung without any keeps its row, with the reason of its first failed repeat.
#include "services/orchestrator/accuracy/accuracy_table.hpp"

#include <algorithm>
#include <cmath>

#include "core/phases/phases.hpp"
#include "core/statistics/repeats.hpp"
#include "services/orchestrator/accuracy/measured.hpp"
#include "services/orchestrator/accuracy/sentences.hpp"
#include "services/orchestrator/records/or_null.hpp"

namespace breach::orchestrator {

using fault::Fault;
using nlohmann::json;

namespace {

void add_reason(AccuracyRow& row, const std::string& more) {
    row.reason += (row.reason.empty() ? "" : "; ") + more;
}

/// The first one found: a row has room for one reason.
std::string worst_reason(const std::vector<Measured>& draws) {
    for (const Measured& each : draws)
        if (!each.reason.empty()) return each.reason;
    return "";
}

/// Means over the repeats that have a value.
std::optional<Cost> mean_cost(const std::vector<Measured>& draws) {
    Cost mean;
    const auto n = static_cast<double>(
        std::ranges::count_if(draws, [](const Measured& each) { return each.value.has_value(); }));
    if (n == 0.0) return std::nullopt;
    for (const Measured& each : draws) {
        if (!each.value) continue;
        mean.cpu_seconds += each.cost.cpu_seconds / n;
        mean.wall_seconds += each.cost.wall_seconds / n;
        for (const auto& [phase, seconds] : each.cost.cpu_seconds_by_phase)
            mean.cpu_seconds_by_phase[phase] += seconds / n;
        if (each.cost.peak_memory_MB)
            // The largest, not the mean: a user plans memory by it.
            mean.peak_memory_MB =
                std::max(mean.peak_memory_MB.value_or(0.0), *each.cost.peak_memory_MB);
    }
    return mean;
}

/// A rung that is not computed yet has its row, without value: the table grows into place.
AccuracyRow row_of(const AccuracyPlan& plan, const Setting& setting,
                   const std::map<std::string, Measured>& measured) {
    AccuracyRow row{.setting = setting};
    const std::vector<double>& sizes = plan.ladders[setting.ladder].sizes;
    if (!sizes.empty()) row.size = sizes[setting.step];
    std::vector<Measured> draws;
    std::vector<double> values;
    for (const std::string& variant : setting.variants) {
        const auto found = measured.find(variant);
        draws.push_back(found == measured.end() ? Measured{.reason = "its task is not there"}
                                                : found->second);
        if (draws.back().value) values.push_back(*draws.back().value);
        // One questionable repeat is enough, since the mean has it in it.
        row.questionable |= draws.back().questionable;
        row.softens |= draws.back().softens;
        row.has_length |= draws.back().has_length;
    }
    if (!values.empty()) row.value = statistics::repeats_of(values);
    row.cost = mean_cost(draws);
    row.reason = worst_reason(draws);
    return row;
}

/// Assumes halved sizes where they are unknown, and then leaves out results that depend on them.
statistics::Convergence convergence_of_ladder(const std::vector<const AccuracyRow*>& rows) {
    std::vector<statistics::Rung> rungs;
    bool sized = true;
    for (const AccuracyRow* each : rows) {
        if (!each->value) continue;
        sized = sized && each->size.has_value();
        const auto halvings = static_cast<double>(each->setting.step);
        rungs.push_back({each->size.value_or(std::exp2(-halvings)), *each->value});
    }
    statistics::Convergence found = statistics::convergence_of(rungs);
    if (!sized) {
        // All of these depend on the assumed ratio; that the values converge at all does not.
        found.order = found.limit = found.gci = std::nullopt;
        found.order_by_noise = std::nullopt;
        if (statistics::rests_on_sizes(found.course)) found.error_of_finest = std::nullopt;
    }
    return found;
}

std::optional<double> reference_of(const Reference& reference,
                                   const statistics::Convergence& convergence,
                                   const AccuracyRow& finest) {
    switch (reference.kind) {
        case ReferenceKind::given:
            return reference.value;
        case ReferenceKind::richardson:
            return convergence.limit;
        case ReferenceKind::finest:
            break;
    }
    return finest.value ? std::optional(finest.value->mean) : std::nullopt;
}

/// Relative to the reference, rung by rung. The reference rung itself has no such error: what it is
/// off by comes from how the ladder converges (share_of).
void tell_errors(const AccuracyPlan& plan, const LadderSummary& ladder,
                 const std::vector<AccuracyRow*>& rows) {
    for (AccuracyRow* row : rows) {
        if (!row->value) continue;
        if (!ladder.reference) {
            const bool finest = plan.reference.kind == ReferenceKind::finest;
            add_reason(*row, "there is no reference: " +
                                 (finest ? "the finest rung has no value" : ladder.message));
            continue;
        }
        if (*ladder.reference == 0.0) {
            add_reason(*row, "the reference is zero, and errors are relative to it");
            continue;
        }
        if (plan.reference.kind == ReferenceKind::finest && row == rows.back()) {
            row->is_reference = true;
            add_reason(*row, "it is the reference");
        } else {
            const double off = std::abs(row->value->mean - *ladder.reference);
            row->error = off / std::abs(*ladder.reference);
            const auto& noise = ladder.convergence.noise;
            // An error within the noise is shown with this mark, not left out.
            row->below_noise =
                noise && off < statistics::smallest_told_difference(*noise, row->value->count);
        }
        if (ladder.lacks_sizes)
            add_reason(*row, "error of the finest rung unknown: give the ladder \"sizes\"");
    }
}

/// Error of a rung on its own ladder: its difference from the reference; if that is the finest
/// rung, plus the finest rung's own error.
std::optional<statistics::Share> share_of(const AccuracyRow& row, const LadderSummary& ladder,
                                          ReferenceKind reference) {
    const std::optional<double>& of_finest = ladder.convergence.error_of_finest;
    const bool finest_is_told = ladder.convergence.course != statistics::Course::below_noise;
    // A share that exceeds the noise is "told": sentences mark the others.
    if (row.is_reference && of_finest) return statistics::Share{*of_finest, finest_is_told};
    if (!row.error) return std::nullopt;
    if (reference != ReferenceKind::finest) return statistics::Share{*row.error, !row.below_noise};
    if (!of_finest) return std::nullopt;
    return statistics::Share{*row.error + *of_finest, !row.below_noise || finest_is_told};
}

/// Whether the error of the base on another ladder is unknown because that ladder has no sizes.
bool rests_on_unsized(const AccuracyTable& table, AccuracyRow& row) {
    std::string names;
    for (std::size_t i = 0; i < table.ladders.size(); ++i)
        if (i != row.setting.ladder && table.ladders[i].base_lacks_sizes)
            names += (names.empty() ? "" : ", ") + table.plan.ladders[i].name;
    if (names.empty()) return false;
    add_reason(row, "error of the base on " + names + " unknown: give \"sizes\" there");
    return true;
}

/// A row's error is its own ladder's error plus the base's error on the other ladders. A given
/// reference includes them all.
void tell_errors_of_runs(AccuracyTable& table) {
    const ReferenceKind reference = table.plan.reference.kind;
    const bool in_it = reference == ReferenceKind::given;
    for (const AccuracyRow& row : table.rows) {
        // A ladder with the base on it knows the base's error there; rows of all other ladders
        // share it.
        if (!row.setting.is_base || in_it) continue;
        LadderSummary& ladder = table.ladders[row.setting.ladder];
        ladder.of_base = share_of(row, ladder, reference);
        ladder.base_lacks_sizes = ladder.lacks_sizes;
    }
    for (AccuracyRow& row : table.rows) {
        const LadderSummary& own = table.ladders[row.setting.ladder];
        std::vector<statistics::Share> shares;
        for (const LadderSummary& each : table.ladders)
            if (&each != &own && each.of_base) shares.push_back(*each.of_base);
        row.error_of_other_ladders = statistics::sum_of(shares);
        row.of_own_ladder = share_of(row, own, reference);
        if (!row.of_own_ladder || rests_on_unsized(table, row)) continue;
        shares.push_back(*row.of_own_ladder);
        row.bias = statistics::sum_of(shares);
        row.error_of_a_run = statistics::error_of_one_run(*row.bias, *row.value, *own.reference);
    }
}

/// Repeats of points share the FEM, because the lattice does not change it.
MeanOfDraws mean_of(const AccuracyRow& row, Redrawn drawn, double reference, std::size_t draws) {
    const auto& by_phase = row.cost->cpu_seconds_by_phase;
    const auto fem = by_phase.find(phases::fem.program);
    const bool shares = drawn == Redrawn::points && fem != by_phase.end();
    const double shared = shares ? fem->second : 0.0;
    const double own = row.cost->cpu_seconds - shared;
    return {draws, statistics::promised_error(*row.bias, *row.value, reference, draws),
            shared + static_cast<double>(draws) * own};
}

/// Repeats reduce the scatter, not the bias: a row whose bias is too large gets no number of them.
void tell_means(AccuracyTable& table) {
    for (AccuracyRow& row : table.rows) {
        if (!row.bias || !row.cost) continue;
        const double reference = *table.ladders[row.setting.ladder].reference;
        if (const auto draws =
                statistics::draws_within(table.plan.asked_error, *row.bias, *row.value, reference))
            row.mean_within_asked = mean_of(row, table.plan.draws_of, reference, *draws);
    }
}

/// Two questions: which rows are worth their cost for one run (the front), and which mean is the
/// cheapest within the requested error (the recommendation).
void choose(AccuracyTable& table) {
    std::vector<statistics::Offer> offers;
    std::vector<std::size_t> rows;
    std::vector<statistics::Offer> means;
    std::vector<std::size_t> rows_of_means;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const AccuracyRow& row = table.rows[i];
        if (!can_be_offered(table, row)) continue;
        offers.push_back({row.cost->cpu_seconds, *row.error_of_a_run});
        rows.push_back(i);
        if (!row.mean_within_asked) continue;
        means.push_back({row.mean_within_asked->cpu_seconds, row.mean_within_asked->error});
        rows_of_means.push_back(i);
    }
    const std::vector<bool> front = statistics::pareto_front(offers);
    for (std::size_t k = 0; k < rows.size(); ++k) table.rows[rows[k]].on_front = front[k];
    if (const auto best = statistics::cheapest_within(means, table.plan.asked_error))
        table.recommended = rows_of_means[*best];
    table.recommendation = recommendation_in_words(table);
}

bool changes(const Ladder& ladder, std::string_view entry) {
    return std::ranges::any_of(ladder.steps.front(),
                               [&](const std::string& each) { return each.starts_with(entry); });
}

/// Softening without an internal length localises in one element or cell of any size.
std::string softening_in_words(const AccuracyPlan& plan, const Ladder& ladder,
                               const AccuracyRow& row, statistics::Course course) {
    if (!row.softens || row.has_length) return "";
    const std::string begin =
        "; the soil softens without a nonlocal_length, in bands as wide as the ";
    const bool of_fem = plan.quantity.reach == Reach::fem || plan.quantity.reach == Reach::chain;
    const bool mesh =
        of_fem && changes(ladder, "/section/") &&
        (course == statistics::Course::not_falling || course == statistics::Course::oscillating);
    if (mesh) return begin + "elements: there may be no limit";
    const bool cells = has_lattice(plan.quantity.reach) && changes(ladder, "/mpm/cell_size");
    return cells ? begin +
                       "cells: smaller cells are another soil, too, and rungs that agree may be "
                       "two errors that cancel"
                 : "";
}

/// The order matters: ladders by themselves, then what rows take over from other ladders, then
/// means, then the choice.
void judge(AccuracyTable& table) {
    for (std::size_t i = 0; i < table.plan.ladders.size(); ++i) {
        std::vector<AccuracyRow*> rows;
        for (AccuracyRow& each : table.rows)
            if (each.setting.ladder == i) rows.push_back(&each);
        LadderSummary ladder;
        ladder.convergence = convergence_of_ladder({rows.begin(), rows.end()});
        ladder.reference = reference_of(table.plan.reference, ladder.convergence, *rows.back());
        ladder.lacks_sizes = table.plan.reference.kind == ReferenceKind::finest &&
                             table.plan.ladders[i].sizes.empty() &&
                             statistics::rests_on_sizes(ladder.convergence.course);
        ladder.reference_is_questionable =
            table.plan.reference.kind != ReferenceKind::given && rows.back()->questionable;
        ladder.message = course_in_words(ladder.convergence, table.plan, i);
        ladder.message += softening_in_words(table.plan, table.plan.ladders[i], *rows.back(),
                                             ladder.convergence.course);
        if (ladder.reference_is_questionable)
            ladder.message += "; its finest rung is questionable, so nothing of it is recommended";
        tell_errors(table.plan, ladder, rows);
        table.ladders.push_back(std::move(ladder));
    }
    tell_errors_of_runs(table);
    tell_means(table);
    choose(table);
}

json as_json(const MeanOfDraws& mean) {
    return {{"draws", mean.draws}, {"error", mean.error}, {"cpu_seconds", mean.cpu_seconds}};
}

std::optional<double> error_of(const std::optional<statistics::Share>& share) {
    return share ? std::optional(share->error) : std::nullopt;
}

json as_json(const AccuracyRow& row, const AccuracyPlan& plan) {
    const Ladder& ladder = plan.ladders[row.setting.ladder];
    json answer{{"ladder", ladder.name},
                {"step", row.setting.step + 1},
                {"setting", ladder.steps[row.setting.step]},
                {"variants", row.setting.variants},
                {"size", or_null(row.size)},
                {"value", nullptr},
                {"standard_deviation", nullptr},
                {"draws", 0},
                {"error", or_null(row.error)},
                {"error_of_own_ladder", or_null(error_of(row.of_own_ladder))},
                {"error_of_other_ladders", row.error_of_other_ladders},
                {"error_of_a_run", or_null(row.error_of_a_run)},
                {"bias", or_null(row.bias)},
                {"mean_within_asked", nullptr},
                {"is_reference", row.is_reference},
                {"below_noise", row.below_noise},
                {"on_pareto_front", row.on_front},
                {"questionable", row.questionable},
                {"cpu_seconds", nullptr},
                {"wall_seconds", nullptr},
                {"peak_memory_MB", nullptr},
                {"cpu_seconds_by_phase", json::object()},
                {"reason", row.reason}};
    if (row.value) {
        answer["value"] = row.value->mean;
        answer["standard_deviation"] = or_null(row.value->deviation);
        answer["draws"] = row.value->count;
    }
    if (row.mean_within_asked) answer["mean_within_asked"] = as_json(*row.mean_within_asked);
    if (row.cost) {
        answer["cpu_seconds"] = row.cost->cpu_seconds;
        answer["wall_seconds"] = row.cost->wall_seconds;
        answer["peak_memory_MB"] = or_null(row.cost->peak_memory_MB);
        answer["cpu_seconds_by_phase"] = row.cost->cpu_seconds_by_phase;
    }
    return answer;
}

json as_json(const std::optional<statistics::Range>& range) {
    return range ? json{range->low, range->high} : json();
}

json as_json(const LadderSummary& ladder, const std::string& name) {
    const statistics::Convergence& c = ladder.convergence;
    return {{"name", name},
            {"course", name_of(c.course)},
            {"message", ladder.message},
            {"order", or_null(c.order)},
            {"order_by_noise", as_json(c.order_by_noise)},
            {"limit", or_null(c.limit)},
            {"gci", or_null(c.gci)},
            {"error_of_finest", or_null(c.error_of_finest)},
            {"noise_floor", c.noise ? json(c.noise->deviation) : json()},
            {"spread", or_null(c.spread)},
            {"reference", or_null(ladder.reference)},
            {"error_of_base", or_null(error_of(ladder.of_base))}};
}

}  // namespace

std::optional<AccuracyTable> accuracy_table(const Store& store, const DataFolder& data,
                                            const std::string& run,
                                            std::optional<double> asked_error) {
    const auto study = store.study_of(run);
    if (!study || !study->contains("accuracy")) return std::nullopt;
    const json scene = json::parse(unless_removed(store.scene_of(run)));
    std::vector<Fault> none;  // the study was checked when it was accepted
    AccuracyTable table;
    table.plan = read_accuracy(study->at("accuracy"), scene, none);
    // A reader may ask for another error without a new study: only the choice changes.
    if (asked_error) table.plan.asked_error = *asked_error;
    const std::vector<Task> tasks = store.tasks_of(run);
    for (const Task& each : tasks)
        if (each.transfer_time) table.transfer_time = each.transfer_time;
    const auto measured = measured_variants(tasks, table.plan.quantity, data);
    for (const Setting& each : settings_of(table.plan, scene))
        table.rows.push_back(row_of(table.plan, each, measured));
    judge(table);
    return table;
}

json as_json(const AccuracyTable& table) {
    json rows = json::array();
    for (const AccuracyRow& each : table.rows) rows.push_back(as_json(each, table.plan));
    json ladders = json::array();
    for (std::size_t i = 0; i < table.ladders.size(); ++i)
        ladders.push_back(as_json(table.ladders[i], table.plan.ladders[i].name));
    json recommended = nullptr;
    if (table.recommended) {
        const AccuracyRow& row = table.rows[*table.recommended];
        recommended = {{"ladder", table.plan.ladders[row.setting.ladder].name},
                       {"step", row.setting.step + 1},
                       {"setting", table.plan.ladders[row.setting.ladder].steps[row.setting.step]},
                       {"error_of_a_run", *row.error_of_a_run},
                       {"draws", row.mean_within_asked->draws},
                       {"error", row.mean_within_asked->error},
                       {"cpu_seconds", row.mean_within_asked->cpu_seconds}};
    }
    const Quantity& quantity = table.plan.quantity;
    return {{"quantity", quantity.name},
            {"unit", quantity.unit},
            {"time", or_null(quantity.time)},
            {"transfer_time", or_null(table.transfer_time)},
            {"draws", table.plan.draws},
            {"draws_of", name_of(table.plan.draws_of)},
            {"base", table.plan.base},
            {"reference", reference_in_words(table.plan.reference)},
            {"asked_error", table.plan.asked_error},
            {"confidence", statistics::confidence},
            {"rows", std::move(rows)},
            {"ladders", std::move(ladders)},
            {"recommended", std::move(recommended)},
            {"recommendation", table.recommendation}};
}

}  // namespace breach::orchestrator
