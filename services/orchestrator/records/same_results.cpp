// Equality to the last digit, because computations are deterministic: equal numbers mean that an
// entry had no effect, not that it had a small one. cpu_seconds differs in each run and is left
// out.
#include "services/orchestrator/records/same_results.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

namespace breach::orchestrator {

using nlohmann::json;

namespace {

bool is_measured(const ResultColumn& column) {
    const std::string_view name = column.name;
    return (column.kind == ColumnKind::number && *column.pointer != '\0' &&
            name != "cpu_seconds") ||
           name.starts_with("factor_of_safety");
}

/// Measured numbers by transfer time, for those with a runout.
using Course = std::map<json, json>;

Course course_of(const std::vector<ResultRow>& rows, const std::string& variant) {
    Course course;
    for (const ResultRow& row : rows) {
        if (value_of(row, "variant") != variant || value_of(row, "runout").is_null()) continue;
        json numbers = json::array();
        for (const ResultColumn& column : result_columns())
            if (is_measured(column)) numbers.push_back(value_of(row, column.name));
        course.emplace(value_of(row, "transfer_time"), std::move(numbers));
    }
    return course;
}

bool are_same(const Course& one, const Course& other) {
    bool have_one = false;
    for (const auto& [time, numbers] : one) {
        const auto its = other.find(time);
        if (its == other.end()) continue;
        if (its->second != numbers) return false;
        have_one = true;
    }
    return have_one;
}

}  // namespace

std::vector<std::vector<std::string>> same_results(const std::vector<ResultRow>& rows,
                                                   const std::vector<std::string>& variants) {
    struct Group {
        Course course;
        std::vector<std::string> names;
    };
    std::vector<Group> groups;
    for (const std::string& variant : variants) {
        Course course = course_of(rows, variant);
        const auto same = std::ranges::find_if(
            groups, [&](const Group& each) { return are_same(each.course, course); });
        if (same != groups.end())
            same->names.push_back(variant);
        else
            groups.push_back({std::move(course), {variant}});
    }
    std::vector<std::vector<std::string>> found;
    for (Group& each : groups)
        if (each.names.size() > 1) found.push_back(std::move(each.names));
    return found;
}

}  // namespace breach::orchestrator
