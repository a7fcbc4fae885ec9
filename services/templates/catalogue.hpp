// The templates and their options: unit, default, range and a sentence each. Independent of
// scenes.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace breach::templates {

enum class Kind { number, whole, yes_or_no };

/// A default may be a share of another option, so that a dam of another height is the same dam in
/// another size.
struct Option {
    std::string name;
    Kind kind;
    std::string unit;  ///< "1" where there is none
    double least, most;
    double value;              ///< default; yes_or_no: 1 or 0
    std::string follows = {};  ///< the option that the default is a share of; empty: none
    double share = 0.0;        ///< of that option
    std::string help;
};

struct Template {
    std::string name;
    std::string title;
    std::vector<Option> options;  ///< options come before those that follow them
};

const std::vector<Template>& catalogue();
/// Throws BadInput with the list of names.
const Template& named(const std::string& name);

/// "height / 3": the rule of a default that follows another option; empty: a fixed number.
std::string rule_of(const Option& option);

/// {"templates": [{"name", "title", "options": [{"name", "topic", "type", "unit", "default",
/// "rule", "follows", "share", "minimum", "maximum", "help"}]}]}; described in README.md.
nlohmann::json as_json(const std::vector<Template>& templates);

}  // namespace breach::templates
