// Reads parameters, distributions and correlations, and refuses what would give wrong samples
// without a message later: values given as factors, bounds beyond the distribution, correlations
// that contradict each other. Called at each reading of a study and for each answer about its
// results, then without faults.
#include "services/orchestrator/study/uncertainty.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "core/scene/schema.hpp"
#include "core/statistics/points.hpp"
#include "core/words/number.hpp"
#include "core/words/words.hpp"

namespace breach::orchestrator {

using fault::Fault;
using nlohmann::json;
using statistics::DistributionKind;

static constexpr auto words_of(ParameterKind) {
    using enum ParameterKind;
    return words::in_order<ParameterKind>(
        {{factor, "factor"}, {value, "value"}, {choice, "choice"}, {numerical, "numerical"}});
}

static constexpr auto words_of(Sampling) {
    using enum Sampling;
    return words::in_order<Sampling>({{latin_hypercube, "latin_hypercube"}, {sobol, "sobol"}});
}

namespace {

// Below this share the bounds miss the distribution, most likely by a slip.
constexpr double least_share_between = 1e-9;
constexpr std::size_t default_batch = 16;

std::string in_quotes(const std::string& text) { return "\"" + text + "\""; }

std::string names_of(const std::vector<Parameter>& parameters) {
    std::string names;
    for (const Parameter& each : parameters)
        names.append(names.empty() ? "" : ", ").append(in_quotes(each.name));
    return names;
}

struct DistributionWords {
    std::vector<std::string> keys;  ///< of Distribution::numbers
    std::string meaning;
};

/// The keys in the order in which statistics::Distribution keeps its numbers.
DistributionWords distribution_words(DistributionKind kind) {
    switch (kind) {
        case DistributionKind::normal:
            return {{"mean", "sd"}, "mean, and sd, the standard deviation"};
        case DistributionKind::lognormal:
            return {{"median", "cov"}, "median, and cov, the coefficient of variation"};
        case DistributionKind::triangular:
            return {{"from", "mode", "to"},
                    "from and to are the ends, mode is the likeliest value"};
        case DistributionKind::uniform:
        case DistributionKind::log_uniform:
            break;
    }
    return {{"from", "to"}, "from and to are the ends"};
}

/// Reads one entry of the list of parameters; reports faults below the pointer `at`.
class ParameterReader {
  public:
    ParameterReader(const json& entry, std::string at, const json& scene,
                    std::vector<Fault>& faults)
        : entry_(entry), at_(std::move(at)), scene_(scene), faults_(faults) {}

    Parameter read() {
        parameter_.name = entry_.at("name");
        read_kind();
        return std::move(parameter_);
    }

  private:
    void fault(const std::string& below, std::string cause, std::string remedy) {
        faults_.push_back({at_ + below, std::move(cause), std::move(remedy)});
    }

    void read_kind() {
        const std::array kinds{"factor_on", "sets", "one_of", "numerical"};
        const auto given = [&](const char* key) { return entry_.contains(key); };
        if (std::ranges::count_if(kinds, given) != 1) {
            fault("", "a parameter is one of factor_on, sets, one_of, numerical",
                  "give exactly one of them");
            return;
        }
        parameter_.kind = given("factor_on") ? ParameterKind::factor
                          : given("sets")    ? ParameterKind::value
                          : given("one_of")  ? ParameterKind::choice
                                             : ParameterKind::numerical;
        const bool is_number = given("factor_on") || given("sets");
        for (const char* key : {"distribution", "between"})
            if (given(key) && !is_number)
                fault("/" + std::string(key), "has a meaning for factor_on and sets only",
                      "remove it");
        for (const char* key : {"weights", "names"})
            if (given(key) && !given("one_of"))
                fault("/" + std::string(key), "has a meaning for one_of only", "remove it");
        if (given("draws") && !given("numerical"))
            fault("/draws", "has a meaning for numerical only", "remove it");
        if (is_number) {
            read_entries(given("sets") ? "sets" : "factor_on");
            read_distribution();
        } else if (given("one_of")) {
            read_choices();
        } else {
            parameter_.lattices = entry_.value("draws", std::size_t{8});
        }
    }

    void read_entries(const std::string& key) {
        parameter_.entries = entry_.at(key).get<std::vector<std::string>>();
        for (std::size_t i = 0; i < parameter_.entries.size(); ++i) {
            const std::string below = "/" + key + "/" + std::to_string(i);
            const std::string& pointer = parameter_.entries[i];
            if (!is_pointer(pointer)) {
                fault(below, in_quotes(pointer) + " is no JSON pointer",
                      "name an entry of the scene, like /materials/tailings/viscosity");
            } else if (auto missing = scene::missing_parent(scene_, pointer)) {
                fault(below, pointer + ": " + missing->cause, missing->remedy);
            } else if (key == "factor_on") {
                check_factor(below, pointer);
            }
        }
    }

    /// The root is none: a parameter must not replace the whole scene.
    static bool is_pointer(const std::string& text) {
        try {
            return text.starts_with('/') && !json::json_pointer(text).empty();
        } catch (const json::exception&) {
            return false;
        }
    }

    void check_factor(const std::string& below, const std::string& pointer) {
        const json::json_pointer there(pointer);
        bool found = false;
        try {
            found = scene_.contains(there);
        } catch (const json::exception&) {  // a text instead of an index
        }
        if (!found)
            fault(below, "the scene has no entry " + pointer,
                  "name an entry that the scene gives, or use \"sets\" with values instead of "
                  "factors");
        else if (!scene_.at(there).is_number())
            fault(below, pointer + " is no number in the scene", "a factor needs a number");
        else if (scene_.at(there) == 0.0)
            fault(below, pointer + " is 0 in the scene: no factor changes it",
                  "use \"sets\" with values instead");
    }

    double number(const json& distribution, const std::string& key, bool& complete) {
        if (distribution.contains(key)) return distribution.at(key);
        fault("/distribution", "lacks " + in_quotes(key),
              "add it: " + distribution_words(parameter_.distribution.kind).meaning);
        complete = false;
        return 0.0;
    }

    void read_distribution() {
        if (!entry_.contains("distribution")) {
            fault("", "lacks \"distribution\"",
                  "say how it is distributed: {\"type\": \"uniform\", \"from\": ..., \"to\": ...}");
            return;
        }
        const json& entry = entry_.at("distribution");
        statistics::Distribution& distribution = parameter_.distribution;
        distribution.kind = words::word_at<DistributionKind>(entry, "type");
        const auto [keys, meaning] = distribution_words(distribution.kind);
        bool complete = true;
        for (std::size_t i = 0; i < keys.size(); ++i)
            distribution.numbers.at(i) = number(entry, keys[i], complete);
        for (const auto& [key, value] : entry.items())
            if (key != "type" && std::ranges::find(keys, key) == keys.end())
                fault("/distribution/" + key,
                      "has no meaning in a " + std::string(words::name_of(distribution.kind)) +
                          " distribution",
                      "remove it: " + meaning);
        if (!complete || !check_numbers(distribution)) return;
        read_between();
        check_factors();
    }

    /// Refuses values given as factors: 12 would be twelve times the scene's strength, not 12 kPa.
    void check_factors() {
        if (parameter_.kind != ParameterKind::factor) return;
        constexpr double most = 5.0, share = 0.05;
        const double low = statistics::quantile(parameter_.distribution, share);
        if (low > most)
            fault("/distribution",
                  "multiplies the scene's number by more than " + words::text_of(low) +
                      " in 19 of 20 samples",
                  "give factors around 1, or use \"sets\" with values instead of \"factor_on\"");
    }

    bool check_numbers(const statistics::Distribution& distribution) {
        const std::size_t before = faults_.size();
        const auto [a, b, c] = distribution.numbers;
        const auto ends = [&](double from, double to) {
            if (to <= from)
                fault("/distribution/to",
                      "the range from " + words::text_of(from) + " to " + words::text_of(to) +
                          " is empty",
                      "give to > from");
        };
        const auto positive = [&](const char* key, double value, const char* why) {
            if (value <= 0.0)
                fault("/distribution/" + std::string(key),
                      "is " + words::text_of(value) + ", and " + why, "give a number above 0");
        };
        switch (distribution.kind) {
            case DistributionKind::uniform:
                ends(a, b);
                break;
            case DistributionKind::log_uniform:
                positive("from", a, "a logarithm needs positive ends");
                ends(a, b);
                break;
            case DistributionKind::normal:
                positive("sd", b, "a spread is positive");
                break;
            case DistributionKind::lognormal:
                positive("median", a, "a lognormal number is positive");
                positive("cov", b, "a spread is positive");
                break;
            case DistributionKind::triangular:
                ends(a, c);
                if (a < c && (b < a || b > c))
                    fault("/distribution/mode", "lies outside of from and to",
                          "give from <= mode <= to");
                break;
        }
        return faults_.size() == before;
    }

    void read_between() {
        if (!entry_.contains("between")) return;
        const std::array<double, 2> ends{entry_.at("between")[0], entry_.at("between")[1]};
        if (ends[0] >= ends[1]) {
            fault("/between",
                  "nothing lies between " + words::text_of(ends[0]) + " and " +
                      words::text_of(ends[1]),
                  "give [least, largest]");
            return;
        }
        // The distribution is cut, not clamped: samples between the bounds keep their proportions.
        parameter_.distribution.between = ends;
        const double share = statistics::share_between(parameter_.distribution);
        if (share < least_share_between)
            fault("/between",
                  "the distribution has nothing there: " + words::text_of(share) +
                      " of its probability",
                  "let the bounds hold the part of the distribution that is meant");
    }

    void read_choices() {
        const auto options = entry_.at("one_of").get<std::vector<std::vector<std::string>>>();
        for (std::size_t i = 0; i < options.size(); ++i) {
            parameter_.choices.push_back(
                {.name = "option " + std::to_string(i + 1), .overrides = options[i]});
            // Each option by itself, its overrides one after the other: a later one may need an
            // earlier.
            json changed = scene_;
            for (std::size_t k = 0; k < options[i].size(); ++k)
                add_entry_of(options[i][k], i, k, changed);
        }
        read_list("names", [](Choice& choice, const json& name) { choice.name = name; });
        read_list("weights", [](Choice& choice, const json& weight) { choice.weight = weight; });
        for (std::size_t i = 0; i < options.size(); ++i) {
            const auto same = [&](const Choice& other) {
                return other.name == parameter_.choices[i].name;
            };
            if (std::ranges::count_if(parameter_.choices, same) > 1)
                fault("/names/" + std::to_string(i),
                      in_quotes(parameter_.choices[i].name) + " is given twice",
                      "give each option a name of its own");
        }
    }

    void add_entry_of(const std::string& override_, std::size_t option, std::size_t place,
                      json& changed) {
        const std::string pointer = override_.substr(0, override_.find('='));
        if (!is_pointer(pointer) || pointer.size() == override_.size()) {
            fault("/one_of/" + std::to_string(option) + "/" + std::to_string(place),
                  in_quotes(override_) + " is no assignment", "write \"/json/pointer=value\"");
            return;
        }
        for (const Fault& each : scene::apply_override(changed, override_))
            fault("/one_of/" + std::to_string(option) + "/" + std::to_string(place),
                  each.pointer + ": " + each.cause, each.remedy);
        if (std::ranges::find(parameter_.entries, pointer) == parameter_.entries.end())
            parameter_.entries.push_back(pointer);
    }

    template <class Take>
    void read_list(const std::string& key, Take take) {
        if (!entry_.contains(key)) return;
        const json& list = entry_.at(key);
        if (list.size() != parameter_.choices.size()) {
            fault("/" + key,
                  "there are " + std::to_string(list.size()) + " " + key + " for " +
                      std::to_string(parameter_.choices.size()) + " options",
                  "give one for each option, in their order");
            return;
        }
        for (std::size_t i = 0; i < list.size(); ++i) take(parameter_.choices[i], list[i]);
    }

    const json& entry_;
    std::string at_;
    const json& scene_;
    std::vector<Fault>& faults_;
    Parameter parameter_;
};

/// Whether the pointers are equal or one contains the other.
/// An override of "/materials/clay" sets "/materials/clay/law" too.
bool meet(const std::string& a, const std::string& b) {
    const auto holds = [](const std::string& whole, const std::string& part) {
        return part.starts_with(whole) &&
               (part.size() == whole.size() || part[whole.size()] == '/');
    };
    return holds(a, b) || holds(b, a);
}

/// Two parameters of one entry: the later one would win in every sample, and the other would show
/// no effect.
void refuse_repeated_entries(const std::vector<Parameter>& parameters, std::vector<Fault>& faults) {
    std::optional<std::size_t> numerical;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        const std::string at = "/uncertainty/parameters/" + std::to_string(i);
        for (std::size_t k = 0; k < i; ++k) {
            if (parameters[k].name == parameters[i].name)
                faults.push_back({at + "/name",
                                  "the name " + in_quotes(parameters[i].name) + " is given twice",
                                  "give each parameter a name of its own"});
            for (const std::string& each : parameters[i].entries)
                if (gives(parameters[k], each))
                    faults.push_back(
                        {at, each + " is given by " + in_quotes(parameters[k].name) + " as well",
                         "let one parameter give each entry"});
        }
        if (parameters[i].kind != ParameterKind::numerical) continue;
        if (numerical)
            faults.push_back({at, "the lattice is drawn by two parameters", "leave one of them"});
        numerical = i;
    }
}

std::vector<AskedCorrelation> read_correlations(const json& entries,
                                                const std::vector<Parameter>& parameters,
                                                std::vector<Fault>& faults) {
    std::vector<AskedCorrelation> asked;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const std::string at = "/uncertainty/correlation/" + std::to_string(i);
        const json& entry = entries[i];
        if (entry.size() != 3 || !entry[0].is_string() || !entry[1].is_string() ||
            !entry[2].is_number()) {
            faults.push_back({at, "is no pair of names with a number",
                              "write [\"one name\", \"other name\", 0.3]"});
            continue;
        }
        std::array<std::size_t, 2> places{};
        bool sound = true;
        for (std::size_t k = 0; k < 2; ++k) {
            const std::string name = entry[k];
            const auto found = std::ranges::find(parameters, name, &Parameter::name);
            places[k] = static_cast<std::size_t>(found - parameters.begin());
            const bool has_order =
                found != parameters.end() &&
                (found->kind == ParameterKind::factor || found->kind == ParameterKind::value);
            if (has_order) continue;
            sound = false;
            if (found == parameters.end())
                faults.push_back({at + "/" + std::to_string(k),
                                  "there is no parameter " + in_quotes(name),
                                  "the parameters are " + names_of(parameters)});
            else
                faults.push_back({at + "/" + std::to_string(k),
                                  in_quotes(name) + " has no order, so that it has no ranks",
                                  "correlate parameters with a distribution"});
        }
        const double rank = entry[2];
        if (!(rank > -1.0 && rank < 1.0)) {
            faults.push_back({at + "/2", "is " + words::text_of(rank),
                              "a rank correlation lies between -1 and 1; for exactly 1 let one "
                              "parameter set both entries"});
            sound = false;
        }
        if (sound && places[0] == places[1]) {
            faults.push_back({at, "correlates a parameter with itself", "name two parameters"});
            sound = false;
        }
        const bool repeated = std::ranges::any_of(asked, [&](const AskedCorrelation& other) {
            return std::minmax(other.a, other.b) == std::minmax(places[0], places[1]);
        });
        if (sound && repeated)
            faults.push_back({at, "this pair is given twice", "give each pair once"});
        if (sound && !repeated) asked.push_back({places[0], places[1], rank});
    }
    return asked;
}

void check_correlations(const UncertaintyPlan& plan, std::vector<Fault>& faults) {
    if (plan.correlations.empty()) return;
    if (!statistics::cholesky(correlation_matrix(plan)))
        faults.push_back({"/uncertainty/correlation",
                          "these correlations contradict each other: their matrix is not positive "
                          "definite",
                          "weaken one of them, or correlate their common cause: two that go with a "
                          "third cannot go against each other"});
    // With fewer samples than this, ranks cannot be arranged to the wanted matrix.
    const std::size_t least = plan.parameters.size() + 2;
    if (plan.sampling == Sampling::latin_hypercube && plan.first < least)
        faults.push_back(
            {"/uncertainty/samples",
             std::to_string(plan.first) + " samples at a time are too few to correlate " +
                 std::to_string(plan.parameters.size()) + " parameters",
             "draw at least " + std::to_string(least) + " (in the first batch), or use sobol"});
}

}  // namespace

std::string_view name_of(ParameterKind kind) { return words::name_of(kind); }
std::string_view name_of(Sampling sampling) { return words::name_of(sampling); }

UncertaintyPlan read_uncertainty(const json& entry, const json& scene, std::vector<Fault>& faults) {
    UncertaintyPlan plan;
    const json& entries = entry.at("parameters");
    for (std::size_t i = 0; i < entries.size(); ++i)
        plan.parameters.push_back(ParameterReader(entries[i],
                                                  "/uncertainty/parameters/" + std::to_string(i),
                                                  scene, faults)
                                      .read());
    plan.quantity = entry.at("quantity");
    plan.samples = entry.at("samples");
    plan.seed = entry.at("seed");
    plan.sampling = words::word_at<Sampling>(entry, "sampling");
    if (entry.contains("until")) plan.batch = entry.at("until").value("batch", default_batch);
    const std::size_t at_once = std::min(plan.batch.value_or(plan.samples), plan.samples);
    plan.drawn = std::min(plan.samples, entry.value("drawn", at_once));
    plan.first = entry.value("first_block", at_once);
    refuse_repeated_entries(plan.parameters, faults);
    plan.correlations = read_correlations(entry.at("correlation"), plan.parameters, faults);
    check_correlations(plan, faults);
    if (plan.sampling == Sampling::sobol &&
        plan.parameters.size() > statistics::most_sobol_dimensions)
        faults.push_back({"/uncertainty/parameters",
                          "the Sobol sequence here has " +
                              std::to_string(statistics::most_sobol_dimensions) + " dimensions",
                          "draw fewer parameters, or use latin_hypercube"});
    return plan;
}

bool gives(const Parameter& parameter, const std::string& pointer) {
    return std::ranges::any_of(parameter.entries,
                               [&](const std::string& each) { return meet(each, pointer); });
}

statistics::Matrix correlation_matrix(const UncertaintyPlan& plan) {
    const std::size_t n = plan.parameters.size();
    statistics::Matrix matrix(n, std::vector<double>(n, 0.0));
    for (std::size_t i = 0; i < n; ++i) matrix[i][i] = 1.0;
    for (const AskedCorrelation& each : plan.correlations)
        matrix[each.a][each.b] = matrix[each.b][each.a] = each.rank;
    return matrix;
}

}  // namespace breach::orchestrator
