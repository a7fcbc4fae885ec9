// Completes the given options with the template's defaults, and checks them one by one and against
// each other.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/fault/fault.hpp"
#include "services/templates/catalogue.hpp"

namespace breach::templates {

/// Every option of a template with its value.
class Values {
  public:
    explicit Values(const Template& of) : template_(&of) {}
    double operator[](const std::string& name) const { return values_.at(name); }
    bool has(const std::string& name) const { return values_.contains(name); }
    /// Options that the template lacks are off.
    bool is_on(const std::string& name) const { return has(name) && values_.at(name) > 0.5; }
    int whole(const std::string& name) const;
    /// Options that the template lacks are 0.
    double or_none(const std::string& name) const { return has(name) ? values_.at(name) : 0.0; }
    void set(const std::string& name, double value) { values_[name] = value; }
    const Template& of() const { return *template_; }
    nlohmann::json as_json() const;

  private:
    const Template* template_;
    std::map<std::string, double> values_;
};

/// Faults point at "/height" and the like. Throws BadInput with all of them.
Values completed(const Template& of, const nlohmann::json& given);

/// Collects options that do not fit together. A check says all that it finds before it throws; a
/// later check may rely on what an earlier one has refused.
class Refusal {
  public:
    explicit Refusal(const Values& values) : values_(&values) {}
    /// Adds a fault unless `holds`. Puts the option's value before the cause: "is 12 m, ...".
    void unless(bool holds, const std::string& option, const std::string& cause,
                const std::string& remedy);
    /// Throws BadInput if there are any.
    void speak() const;

  private:
    const Values* values_;
    std::vector<fault::Fault> faults_;
};

/// "12.5 m"
std::string metres(double value);

}  // namespace breach::templates
