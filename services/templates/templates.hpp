// Generates a scene and its study from the options of a template.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "services/templates/catalogue.hpp"

namespace breach::templates {

struct Made {
    nlohmann::ordered_json options;  ///< all options with their values
    nlohmann::ordered_json scene;    ///< commented; names its motion "motion.csv"
    nlohmann::ordered_json study;    ///< without its scene
    std::string motion;              ///< text of motion.csv; empty: no shaking
};

/// `options`: an object, {"height": 30}; missing options have their defaults. "name" names scene
/// and study. Throws BadInput with every fault; pointers name the option.
Made make(const std::string& name, const nlohmann::json& options);

/// JSON for people: short values on one line. Ends with a newline.
std::string as_text(const nlohmann::ordered_json& document);

}  // namespace breach::templates
