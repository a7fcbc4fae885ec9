// Says where in the section a fault is, from text and pointer alone: the many checks that raise
// faults know nothing of drawings. A fault whose place cannot be found is only listed below the
// picture.
#include "services/drawing/fault_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "core/scene/scene.hpp"

namespace breach::drawing {

using mechanics::Vec2;
using nlohmann::json;
using Pointer = json::json_pointer;

namespace {

// Entries of a scene with pairs of numbers that are points, and entries that are abscissae. A new
// entry with coordinates belongs here, or its faults get no mark.
constexpr std::array<std::string_view, 11> points{"polygon", "corners", "from", "to",
                                                  "crest",   "toe",     "line", "phreatic_line",
                                                  "terrain", "floor",   "given"};
constexpr std::array<std::string_view, 7> abscissae{"x",       "entry",    "exit",  "domain_x",
                                                    "left_of", "right_of", "center"};

template <class Names>
bool is_one_of(const std::string& name, const Names& names) {
    return std::ranges::find(names, name) != names.end();
}

bool is_number_in(const json& pair, std::size_t i) { return pair.at(i).is_number(); }

bool is_pair(const json& value) {
    return value.is_array() && value.size() == 2 && is_number_in(value, 0) &&
           is_number_in(value, 1);
}

Vec2 point_of(const json& pair) { return {pair.at(0).get<double>(), pair.at(1).get<double>()}; }

/// A vertical face has two levels at one x; without soil there, the mark goes to the lower edge.
double ground_at(const scene::Section& section, double x) {
    const double aside = 1e-6 * std::max(1.0, std::abs(x));  // offset from a vertical face
    for (const double each : {x + aside, x - aside})
        if (const double ground = geometry::ground_at(section, each); std::isfinite(ground))
            return ground;
    return std::min(0.0, geometry::extent(section).low.y());
}

/// The number at the beginning of a text, and its end; nothing: there is none.
std::optional<double> number_at(const char* text, const char** end) {
    char* after = nullptr;
    const double value = std::strtod(text, &after);
    *end = after;
    return after != text && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// These two forms are what checks write; a point counts before an abscissa.
std::vector<Trace> told_in(const std::string& text, const scene::Scene& scene) {
    std::vector<Trace> told;
    const char* end = nullptr;
    for (std::size_t at = text.find('('); at != std::string::npos; at = text.find('(', at + 1)) {
        const auto x = number_at(text.c_str() + at + 1, &end);
        if (!x || *end != ',') continue;
        const auto y = number_at(end + 1, &end);
        if (y && *end == ')') told.push_back({Vec2(*x, *y)});
    }
    if (!told.empty()) return told;
    if (const std::size_t at = text.find("x = "); at != std::string::npos)
        if (const auto x = number_at(text.c_str() + at + 4, &end))
            told.push_back({Vec2(*x, ground_at(scene.section, *x))});
    return told;
}

class Collector {
  public:
    explicit Collector(const scene::Scene& scene) : scene_(scene) {}

    /// Collects the places of the entry with this name and of all entries below it.
    void collect(const std::string& name, const json& value) {
        if (value.is_object()) {
            // Supports and pressure boundaries: one line, not two points.
            if (is_segment(value)) {
                traces.push_back({point_of(value.at("from")), point_of(value.at("to"))});
                return;
            }
            for (const auto& [key, each] : value.items()) collect(key, each);
        } else if (is_one_of(name, points)) {
            collect_points(value);
        } else if (is_one_of(name, abscissae)) {
            collect_abscissae(value);
        } else if (value.is_array()) {
            for (const json& each : value)
                if (each.is_object()) collect(name, each);
        }
    }

    std::vector<Trace> traces;

  private:
    static bool is_segment(const json& value) {
        return value.contains("from") && value.contains("to") && is_pair(value.at("from")) &&
               is_pair(value.at("to"));
    }

    void collect_points(const json& value) {
        if (value.is_number()) return collect_abscissae(value);  // from and to of a load
        if (is_pair(value)) return traces.push_back({point_of(value)});
        if (!value.is_array()) return;
        Trace line;
        for (const json& each : value)
            if (is_pair(each)) line.push_back(point_of(each));
        if (!line.empty()) traces.push_back(std::move(line));
    }

    void collect_abscissae(const json& value) {
        const auto add = [&](const json& x) {
            if (x.is_number())
                traces.push_back(
                    {Vec2(x.get<double>(), ground_at(scene_.section, x.get<double>()))});
        };
        if (!value.is_array()) return add(value);
        for (const json& each : value) add(each);
    }

    const scene::Scene& scene_;
};

bool is_index(const std::string& token) {
    return !token.empty() && token.find_first_not_of("0123456789") == std::string::npos;
}

/// The name of an entry; for an element of a list, the list's name.
std::string name_of(Pointer pointer) {
    while (!pointer.empty() && is_index(pointer.back())) pointer.pop_back();
    return pointer.empty() ? "" : pointer.back();
}

std::size_t depth_of(const Pointer& pointer) {
    return static_cast<std::size_t>(std::ranges::count(pointer.to_string(), '/'));
}

/// From the entry upwards to the first one with a place: a fault of a number inside a region is
/// shown at the region. Never up to a whole part such as /fem, which would mark everything.
std::vector<Trace> of_entry(const std::string& text, const json& document,
                            const scene::Scene& scene) {
    for (Pointer pointer(text); depth_of(pointer) >= 2; pointer.pop_back()) {
        if (!document.contains(pointer)) continue;
        Collector collector(scene);
        collector.collect(name_of(pointer), document.at(pointer));
        if (!collector.traces.empty()) return collector.traces;
    }
    return {};
}

Vec2 mean_of(const Trace& trace) {
    Vec2 sum = Vec2::Zero();
    for (const Vec2& each : trace) sum += each;
    return sum / static_cast<double>(trace.size());
}

/// Centres of the regions of a material.
std::vector<Trace> of_material(const std::string& name, const json& document,
                               const scene::Scene& scene) {
    std::vector<Trace> traces;
    const Pointer list("/section/regions");
    if (!document.contains(list) || !document.at(list).is_array()) return {};
    for (const json& region : document.at(list)) {
        if (!region.is_object() || region.value("material", json()) != json(name)) continue;
        Collector collector(scene);
        collector.collect("polygon", region.value("polygon", json()));
        for (const Trace& each : collector.traces) traces.push_back({mean_of(each)});
    }
    return traces;
}

}  // namespace

std::vector<Trace> places_of(const fault::Fault& fault, const json& document,
                             const scene::Scene& scene) try {
    if (auto told = told_in(fault.cause, scene); !told.empty()) return told;
    const Pointer pointer(fault.pointer);
    if (fault.pointer.rfind("/materials/", 0) == 0) {
        Pointer material = pointer;
        // /materials/NAME/...
        while (depth_of(material) > 2) material.pop_back();
        return of_material(material.back(), document, scene);
    }
    return of_entry(fault.pointer, document, scene);
} catch (const json::exception&) {
    return {};  // invalid, or not a path through the document
}

}  // namespace breach::drawing
