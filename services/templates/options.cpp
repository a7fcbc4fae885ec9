// All faults are collected, as a form shows them beside their fields. Values are kept as numbers by
// name, whole numbers and yes or no as well: the geometry uses them in formulas.
#include "services/templates/options.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/words/number.hpp"

namespace breach::templates {

using fault::Fault;
using nlohmann::json;

namespace {

constexpr const char* name_entry = "name";

std::string plain(double value) { return words::text_of(value, 6); }

std::string with_unit(double value, const Option& option) {
    if (option.kind == Kind::yes_or_no) return value > 0.5 ? "true" : "false";
    return plain(value) + (option.unit == "1" ? "" : " " + option.unit);
}

std::string range_of(const Option& option) {
    if (option.kind == Kind::yes_or_no) return "true or false";
    return (option.kind == Kind::whole ? "a whole number from " : "from ") + plain(option.least) +
           " to " + with_unit(option.most, option);
}

/// The fault of a value; empty: none.
std::string flaw(const json& value, const Option& option) {
    if (option.kind == Kind::yes_or_no) return value.is_boolean() ? "" : "is " + value.dump();
    if (!value.is_number()) return "is " + value.dump();
    const double number = value;
    if (option.kind == Kind::whole && number != std::floor(number)) return "is " + plain(number);
    const bool inside = number >= option.least && number <= option.most;
    return inside ? "" : "is " + with_unit(number, option);
}

double number_in(const json& value) {
    return value.is_boolean() ? (value.get<bool>() ? 1.0 : 0.0) : value.get<double>();
}

}  // namespace

std::string metres(double value) { return words::text_of(value, 4) + " m"; }

int Values::whole(const std::string& name) const {
    return static_cast<int>(std::lround(values_.at(name)));
}

json Values::as_json() const {
    json all = json::object();
    for (const Option& each : template_->options) {
        const double value = values_.at(each.name);
        switch (each.kind) {
            case Kind::number:
                all[each.name] = value;
                break;
            case Kind::whole:
                all[each.name] = whole(each.name);
                break;
            case Kind::yes_or_no:
                all[each.name] = is_on(each.name);
                break;
        }
    }
    return all;
}

Values completed(const Template& of, const json& given) {
    const std::string what = "template " + of.name;
    if (!given.is_object())
        throw fault::BadInput(what, {{"", "is " + given.dump().substr(0, 60),
                                      "give the options as an object: {\"height\": 30}"}});
    std::vector<Fault> faults;
    std::string known;
    for (const Option& each : of.options) known += (known.empty() ? "" : ", ") + each.name;
    for (const auto& [key, value] : given.items())
        // The name is of the scene, not of the geometry (templates.cpp).
        if (key != name_entry &&
            std::ranges::find(of.options, key, &Option::name) == of.options.end())
            faults.push_back(
                {"/" + key, "is no option of " + of.name, "the options are: " + known});
    Values values(of);
    for (const Option& each : of.options) {
        double value = each.value;
        if (!each.follows.empty() && values.has(each.follows))
            // Within the option's limits: a very high dam would else have a default that its own
            // check refuses.
            value = std::clamp(each.share * values[each.follows], each.least, each.most);
        if (given.contains(each.name)) {
            const json& wanted = given.at(each.name);
            const std::string wrong = flaw(wanted, each);
            if (!wrong.empty())
                faults.push_back(
                    {"/" + each.name, wrong, "must be " + range_of(each) + ": " + each.help});
            else
                value = number_in(wanted);
        }
        // Also after a fault, so that options which follow this one are still checked.
        values.set(each.name, value);
    }
    if (!faults.empty()) throw fault::BadInput(what, std::move(faults));
    return values;
}

void Refusal::unless(bool holds, const std::string& option, const std::string& cause,
                     const std::string& remedy) {
    if (holds) return;
    const auto& options = values_->of().options;
    const auto found = std::ranges::find(options, option, &Option::name);
    faults_.push_back({"/" + option, "is " + with_unit((*values_)[option], *found) + ": " + cause,
                       remedy + " (" + option + ": " + range_of(*found) + ")"});
}

void Refusal::speak() const {
    if (!faults_.empty()) throw fault::BadInput("template " + values_->of().name, faults_);
}

}  // namespace breach::templates
