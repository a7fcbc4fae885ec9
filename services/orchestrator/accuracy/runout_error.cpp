// Every runout that is shown gets an error. Two sources, the better first: an accuracy study that
// computed the same at the same setting; else noise and the bias of the cells, independent of each
// other. Noise: the repeats of this sweep, else neighbours in transfer time, else the usual one.
// Computed for each request, not stored: a later accuracy study improves the errors of earlier
// runs.
#include "services/orchestrator/accuracy/runout_error.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/statistics/neighbours.hpp"
#include "core/words/number.hpp"
#include "services/orchestrator/accuracy/accuracy_table.hpp"
#include "services/orchestrator/accuracy/sentences.hpp"
#include "services/orchestrator/records/mean_columns.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

constexpr std::size_t most_studies = 20;  // only the newest
/// Standard deviation of a runout over lattices of points without measured repeats: about the
/// values in docs/verification/accuracy.md for short runouts (up to 0.5 cells) and long ones (1.2
/// to 1.5 %).
constexpr double scatter_in_cells = 0.5;
constexpr double scatter_of_runout = 0.015;
/// Over the cells across the mean depth beyond the toe: runouts that coarse cells miss, relative. Bounds
/// the ladders of four scenes (docs/verification/mpm_convergence.md#the-bias-of-the-cells).
constexpr double bias_over_cells = 0.4;
constexpr const char* noise_of_points = "noise of the points, not of a FEM before it";
constexpr const char* noise_of_fem = "noise of the FEM and of the points";

struct Estimate {
    std::optional<double> error;      ///< [m]
    std::string from;                 ///< its source, or why there is none
    std::optional<double> bias = {};  ///< the same without scatter [m]
};

/// Recipes of the three phases; the FEM's without the times of its snapshots. If points fill the
/// section, only the MPM's.
using Question = std::tuple<std::string, std::string, std::string>;

class Questions {
  public:
    explicit Questions(const Store& store) : store_(store) {}

    /// For a task of the MPM; nothing: a phase of its chain has no recipe.
    std::optional<Question> of(const Task& mpm, const Task& transfer, const Task& fem) {
        if (!mpm.recipe || !transfer.recipe || !fem.recipe) return std::nullopt;
        auto known = fems_.find(*fem.recipe);
        if (known == fems_.end())
            known = fems_.emplace(*fem.recipe, without_snapshots(*fem.recipe)).first;
        return Question{*mpm.recipe, *transfer.recipe, known->second};
    }

  private:
    std::string without_snapshots(const std::string& recipe) const {
        const auto found = store_.recipe(recipe);
        json part = json::parse(found->part);
        // A FEM computes the same at all snapshot times; a sweep and a study rarely have the same
        // ones.
        part["fem"].erase("snapshot_times");
        part["fem"].erase("snapshot_interval");
        return std::to_string(found->cache_version) + " " + part.dump();
    }

    const Store& store_;
    std::map<std::string, std::string> fems_;  ///< by recipe
};

/// Only distances: an error of an area or a velocity cannot be used for a runout.
bool is_runout(const Quantity& quantity) {
    return has_lattice(quantity.reach) && quantity.name.starts_with("runout") &&
           quantity.unit == "m";
}

std::string source_of(const AccuracyTable& table, const AccuracyRow& row, const std::string& run) {
    const Ladder& ladder = table.plan.ladders[row.setting.ladder];
    std::string words = "accuracy study " + run + ", " + ladder.name;
    for (const std::string& each : ladder.steps[row.setting.step]) words += " " + each;
    words += ": of " + table.plan.quantity.name;
    if (table.transfer_time) words += " at t_T " + json(*table.transfer_time).dump() + " s";
    return words + (row.questionable ? ", which is questionable" : "");
}

Estimate estimate_of(const AccuracyTable& table, const AccuracyRow& row, const std::string& run) {
    const LadderSummary& ladder = table.ladders[row.setting.ladder];
    const std::string source = source_of(table, row, run);
    if (!row.error_of_a_run) return {std::nullopt, source + ": " + row.reason};
    const double reference = std::abs(*ladder.reference);
    return {*row.error_of_a_run * reference,
            source + (row.is_reference ? ", by how its ladder ends"
                                       : ", against " + reference_in_words(table.plan.reference)),
            *row.bias * reference};
}

/// If several ladders share the rung, the largest of their errors.
Estimate estimate_of(const AccuracyTable& table, const std::string& variant,
                     const std::string& run) {
    Estimate found{std::nullopt, "accuracy study " + run + " has no error for it"};
    for (const AccuracyRow& row : table.rows) {
        if (std::ranges::find(row.setting.variants, variant) == row.setting.variants.end())
            continue;
        Estimate each = estimate_of(table, row, run);
        if (!found.error || (each.error && *each.error > *found.error)) found = std::move(each);
    }
    return found;
}

/// Rungs of the accuracy studies, by the recipe of their MPM. The recipes of the other phases are
/// looked up only where that is equal.
class Studies {
  public:
    Studies(const Store& store, const DataFolder& data)
        : store_(store), data_(data), questions_(store) {
        for (AccuracyRung& each : store.accuracy_rungs(most_studies)) {
            std::string recipe = each.recipe;
            rungs_.emplace(std::move(recipe), std::move(each));
        }
    }

    bool none() const { return rungs_.empty(); }

    /// Nothing: no study has this rung.
    std::optional<Estimate> estimate(const Task& mpm) {
        if (!mpm.recipe) return std::nullopt;
        // The cheap comparison first; the whole chain is read only for rungs with this recipe.
        const auto [first, last] = rungs_.equal_range(*mpm.recipe);
        if (first == last) return std::nullopt;
        const auto question = question_of(mpm);
        if (!question) return std::nullopt;
        std::optional<Estimate> best;
        // A study without an error may be followed by an older one that has it.
        for (auto each = first; each != last && !(best && best->error); ++each) {
            const AccuracyRung& rung = each->second;
            const auto rung_task = store_.task(rung.mpm_task);
            if (!rung_task || question_of(*rung_task) != question) continue;
            auto table = tables_.find(rung.run);
            if (table == tables_.end())
                table = tables_.emplace(rung.run, accuracy_table(store_, data_, rung.run)).first;
            if (table->second && is_runout(table->second->plan.quantity))
                best = estimate_of(*table->second, rung.variant, rung.run);
        }
        return best;
    }

  private:
    std::optional<Question> question_of(const Task& mpm) {
        if (!mpm.recipe) return std::nullopt;
        if (!mpm.parent) return Question{*mpm.recipe, "", ""};
        const auto transfer = store_.task(*mpm.parent);
        if (!transfer || !transfer->parent) return std::nullopt;  // its run was removed
        const auto fem = store_.task(*transfer->parent);
        return fem ? questions_.of(mpm, *transfer, *fem) : std::nullopt;
    }

    const Store& store_;
    const DataFolder& data_;
    Questions questions_;
    std::multimap<std::string, AccuracyRung> rungs_;  ///< newer studies first
    std::map<std::string, std::optional<AccuracyTable>> tables_;
};

/// A variant at a transfer time; a static scene has no time.
using Place = std::pair<std::string, std::optional<double>>;

Place place_at(const std::string& variant, const json& transfer_time) {
    return {variant,
            transfer_time.is_number() ? std::optional<double>(transfer_time) : std::nullopt};
}

/// The repeats of each variant at each transfer time.
/// From all rows of the run, not only those that a filter shows.
class Scatter {
  public:
    Scatter(const Store& store, const std::string& run, const AllRows& all_rows) {
        const json study = store.study_of(run).value_or(json::object());
        if (study.value("draws", 1) < 2) return;
        // Then each repeat has its own FEM, whose scatter is in the numbers as well.
        if (redrawn_named(study.value("draws_of", "")) == Redrawn::fem) noise_ = noise_of_fem;
        repeated_ = store.repeated_variants(run);
        for (const ResultRow& row : all_rows()) {
            if (!value_of(row, "runout").is_number()) continue;
            runouts_[place_of(row)].push_back(value_of(row, "runout"));
            tasks_.emplace(place_of(row), value_of(row, "mpm_task"));
        }
    }

    std::optional<Estimate> estimate(const ResultRow& row) const {
        const auto found = runouts_.find(place_of(row));
        if (found == runouts_.end() || found->second.size() < 2) return std::nullopt;
        return Estimate{
            statistics::repeats_of(found->second).deviation,
            "scatter of " + std::to_string(found->second.size()) + " repeats: " + noise_};
    }

    /// The error that scatter leaves in the mean over the repeats at a place.
    Estimate of_mean(const Place& place) const {
        const auto found = runouts_.find(place);
        if (found == runouts_.end() || found->second.size() < 2)
            return {std::nullopt, "fewer than two repeats have a runout"};
        return {statistics::half_width_of_mean(statistics::repeats_of(found->second)),
                "scatter of the mean of " + std::to_string(found->second.size()) +
                    " repeats, Student's 90 %: " + noise_};
    }

    /// Root mean square of the repeats' scatter over all places; nothing: none has two repeats.
    std::optional<double> everywhere() const {
        double sum = 0.0, places = 0.0;
        for (const auto& [place, runouts] : runouts_) {
            if (runouts.size() < 2) continue;
            sum += std::pow(statistics::repeats_of(runouts).deviation.value_or(0.0), 2.0);
            ++places;
        }
        return places > 0.0 ? std::optional(std::sqrt(sum / places)) : std::nullopt;
    }

    /// The MPM task of a repeat that has a runout; nothing: none has.
    std::optional<std::string> task_of(const Place& place) const {
        const auto found = tasks_.find(place);
        return found == tasks_.end() ? std::nullopt : std::optional(found->second);
    }

  private:
    Place place_of(const ResultRow& row) const {
        const std::string variant = value_of(row, "variant");
        const auto found = repeated_.find(variant);
        return place_at(found == repeated_.end() ? variant : found->second,
                        value_of(row, "transfer_time"));
    }

    const char* noise_ = noise_of_points;
    std::map<std::string, std::string> repeated_;  ///< by the repeat
    std::map<Place, std::vector<double>> runouts_;
    std::map<Place, std::string> tasks_;
};

/// Only for runs with several transfer times: how far a runout is off its neighbours'
/// (core/statistics/neighbours.hpp).
class OverTransferTime {
  public:
    explicit OverTransferTime(const std::vector<ResultRow>& rows) {
        std::map<std::string, std::map<double, double>> curves;
        for (const ResultRow& row : rows) {
            const json& time = value_of(row, "transfer_time");
            if (time.is_number() && value_of(row, "runout").is_number())
                curves[value_of(row, "variant")].emplace(time, value_of(row, "runout"));
        }
        for (const auto& [variant, curve] : curves) {
            std::vector<statistics::CurvePoint> samples;
            for (const auto& [time, runout] : curve) samples.push_back({time, runout});
            const auto scatter = statistics::scatter_among_neighbours(samples);
            for (std::size_t i = 0; i < samples.size(); ++i)
                if (scatter[i]) scatter_.emplace(Place{variant, samples[i].x}, *scatter[i]);
        }
    }

    std::optional<Estimate> estimate(const ResultRow& row) const {
        const auto found =
            scatter_.find(place_at(value_of(row, "variant"), value_of(row, "transfer_time")));
        if (found == scatter_.end()) return std::nullopt;
        return Estimate{found->second,
                        "scatter among neighbouring transfer times: noise and the curve's own "
                        "bends, not of the FEM that they share"};
    }

  private:
    std::map<Place, double> scatter_;
};

/// Cell size of a runout [m]; nothing: its result does not say it.
std::optional<double> cell_size_of(const std::optional<Task>& task) {
    const json size = task && task->result ? task->result->value("cell_size", json()) : json();
    return size.is_number() ? std::optional(size.get<double>()) : std::nullopt;
}

/// Noise of a row without repeats of its own. Runouts at neighbouring transfer times begin with nearly
/// equal points on one lattice. Their scatter shrinks with the spacing of the times, and does not
/// include other lattices, so the usual scatter is the least.
Estimate noise_without_repeats(const std::optional<Estimate>& beside, double runout,
                               const std::optional<double>& draws,
                               const std::optional<double>& cell) {
    const double usual =
        std::max(scatter_in_cells * cell.value_or(0.0), scatter_of_runout * std::abs(runout));
    const double floor = draws.value_or(usual);
    if (beside && floor <= *beside->error) return *beside;
    const std::string why = draws
                                ? "scatter of the repeats of other rows"
                                : "usual scatter of lattices of points, at least half a cell and " +
                                      words::text_of(100.0 * scatter_of_runout) +
                                      " % of the runout (set \"draws\" to measure it)";
    if (!beside) return {floor, why};
    return {floor, why + "; neighbouring transfer times share a lattice and scatter by " +
                       words::text_of(*beside->error, 2) + " m only"};
}

/// Bias of the cells [m] by those across the deposit; without an error where no soil is beyond the toe.
Estimate bias_of_cells(const json& beyond_toe, const json& area_beyond_toe,
                       const std::optional<double>& cell) {
    const double reach = beyond_toe.is_number() ? beyond_toe.get<double>() : 0.0;
    const double area = area_beyond_toe.is_number() ? area_beyond_toe.get<double>() : 0.0;
    if (!cell || !(reach > 0.0 && area > 0.0))
        return {std::nullopt, "no soil beyond the toe tells the error of the cells"};
    const double across = area / (reach * *cell);
    const double share = bias_over_cells / across;
    return {share * reach, words::text_of(100.0 * share, 2) + " % for cells, " +
                               words::text_of(across, 2) +
                               " across the deposit's mean depth (an accuracy study measures it)"};
}

/// Of one run.
Estimate with_bias(const Estimate& noise, const Estimate& bias) {
    return {std::hypot(*noise.error, bias.error.value_or(0.0)), noise.from + "; " + bias.from};
}

/// Bias from an accuracy study, else that of the cells; scatter from the repeats.
Estimate of_mean(const std::optional<Estimate>& studied, const Estimate& of_cells,
                 Estimate scatter) {
    if (!scatter.error) return scatter;
    if (studied && studied->bias)
        return {*studied->bias + *scatter.error, "bias by " + studied->from + "; " + scatter.from};
    return {of_cells.error.value_or(0.0) + *scatter.error, scatter.from + "; " + of_cells.from};
}

/// The same at every transfer time and repeat of a variant.
struct OfVariant {
    std::optional<Estimate> studied;  ///< by an accuracy study
    std::optional<double> cell;       ///< [m]
};

}  // namespace

void tell_runout_errors(const Store& store, const DataFolder& data, const std::string& run,
                        std::vector<ResultRow>& rows, std::vector<ResultRow>& means,
                        const AllRows& all_rows) {
    Studies studies(store, data);
    const Scatter scatter(store, run, all_rows);
    std::optional<OverTransferTime> over_time;
    const auto look_up = [&](const std::string& mpm_task) {
        const auto task = store.task(mpm_task);
        return OfVariant{studies.none() ? std::nullopt : studies.estimate(unless_removed(task)),
                         cell_size_of(task)};
    };
    std::map<std::string, OfVariant> by_variant;
    for (ResultRow& row : rows) {
        if (!value_of(row, "runout").is_number()) continue;
        const std::string variant = value_of(row, "variant");
        auto known = by_variant.find(variant);
        if (known == by_variant.end())
            known = by_variant.emplace(variant, look_up(value_of(row, "mpm_task"))).first;
        const std::optional<double>& cell = known->second.cell;
        std::optional<Estimate> estimate = known->second.studied;
        if (!estimate || !estimate->error) {
            auto noise = scatter.estimate(row);
            // Only now: it reads every row of the run.
            if (!over_time) over_time.emplace(all_rows());
            const auto beside = over_time->estimate(row);
            if (noise && beside) {
                noise->from += "; neighbouring transfer times scatter by " +
                               words::text_of(*beside->error, 2) +
                               " m, the curve's own bends among it";
            }
            if (!noise)
                noise = noise_without_repeats(beside, value_of(row, "runout"), scatter.everywhere(),
                                              cell);
            estimate = with_bias(*noise, bias_of_cells(value_of(row, "runout_beyond_toe"),
                                                       value_of(row, "area_beyond_toe"), cell));
        }
        value_of(row, "runout_error") = *estimate->error;
        value_of(row, "runout_error_from") = estimate->from;
    }
    // By the variant that is repeated: a mean has no MPM task, so one of its repeats stands for
    // all.
    std::map<std::string, OfVariant> by_repeated;
    for (ResultRow& mean : means) {
        const auto value = [&](const char* name) -> json& {
            return value_of(mean, name, mean_columns());
        };
        const Place place = place_at(value("variant"), value("transfer_time"));
        auto known = by_repeated.find(place.first);
        const auto task = scatter.task_of(place);
        if (task && known == by_repeated.end())
            known = by_repeated.emplace(place.first, look_up(*task)).first;
        const OfVariant of = known == by_repeated.end() ? OfVariant{} : known->second;
        const Estimate of_cells =
            bias_of_cells(value("runout_beyond_toe"), value("area_beyond_toe"), of.cell);
        const Estimate estimate = of_mean(of.studied, of_cells, scatter.of_mean(place));
        if (estimate.error) value("runout_error") = *estimate.error;
        value("runout_error_from") = estimate.from;
    }
}

void tell_governing_error(const Store& store, const DataFolder& data, Run& run) {
    if (!run.governing || !run.governing->soil || run.governing->soil->worst_of > 1) return;
    const std::vector<ResultRow> all = store.results(run.id);
    const auto governs = [&](const ResultRow& row) {
        return value_of(row, "mpm_task") == json(run.governing->task);
    };
    std::vector<ResultRow> row, no_means;
    std::ranges::copy_if(all, std::back_inserter(row), governs);
    tell_runout_errors(
        store, data, run.id, row, no_means, [&]() -> const auto& { return all; });
    if (row.empty()) return;
    if (const json& error = value_of(row.front(), "runout_error"); error.is_number())
        run.governing->soil->error = error;
}

}  // namespace breach::orchestrator
