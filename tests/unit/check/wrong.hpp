// A shipped scene with a few changed entries, and the problems of its check.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "core/check/check.hpp"

namespace breach::check {

inline std::string file_text(const std::string& file) {
    std::ifstream stream(file);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

inline Checked changed(const std::string& scene, const std::vector<std::string>& overrides) {
    const std::string folder = BREACH_ROOT "/workflows/scenes";
    return checked_text(file_text(folder + "/" + scene + ".json"), scene, folder, overrides);
}

/// "pointer: cause (remedy)", one per line, for failure messages.
inline std::string told(const std::vector<fault::Fault>& faults) {
    std::string all;
    for (const auto& each : faults)
        all += each.pointer + ": " + each.cause + " (" + each.remedy + ")\n";
    return all;
}

/// Expects exactly one fault, at this pointer, with `cause` in its text and with a remedy.
inline void expect_only(const Checked& checked, const std::string& pointer,
                        const std::string& cause) {
    ASSERT_EQ(checked.faults.size(), 1u) << told(checked.faults);
    EXPECT_EQ(checked.faults[0].pointer, pointer);
    EXPECT_NE(checked.faults[0].cause.find(cause), std::string::npos) << told(checked.faults);
    EXPECT_FALSE(checked.faults[0].remedy.empty());
}

inline bool has_fault(const Checked& checked, const std::string& pointer,
                      const std::string& cause = "") {
    return std::ranges::any_of(checked.faults, [&](const fault::Fault& each) {
        return each.pointer == pointer && each.cause.find(cause) != std::string::npos;
    });
}

inline bool has_warning(const Checked& checked, const std::string& code,
                        const std::string& pointer) {
    return std::ranges::any_of(checked.scene.warnings, [&](const fault::Flag& each) {
        return each.code == code && each.pointer == pointer;
    });
}

}  // namespace breach::check
