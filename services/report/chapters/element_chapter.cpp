// Cyclic resistance and undrained strength of the materials from element tests, which belong to no
// run.
#include "services/report/chapters/chapters.hpp"
#include "services/report/figures/element_test_figures.hpp"

namespace breach::report {

using namespace nlohmann::literals;

namespace {

void note_what_is_missing(const nlohmann::json& scene, Document& document) {
    const nlohmann::json materials = scene.value("materials", nlohmann::json::object());
    for (const auto& [name, material] : materials.items()) {
        if (material.value("/law/type"_json_pointer, "") != "pm4sand") continue;
        document.left_out.push_back({"cyclic resistance and undrained strength of " + name,
                                     "fem_solver element-test computes them; give its folder with "
                                     "--element-tests"});
    }
}

/// Leaves out single cyclic tests: each is a point in the curve of cyclic resistance.
bool belongs(const Figure& figure) {
    return figure.name.ends_with("_CRR") || figure.name.find("_csr") == std::string::npos;
}

}  // namespace

void add_element_tests(const Material& from, Document& document) {
    if (from.choice.element_tests.empty()) {
        note_what_is_missing(from.run.scene, document);
        return;
    }
    Chapter chapter{"Soil elements",
                    "One point of soil under the laws of the analysis, by fem_solver "
                    "element-test: cyclic resistance, undrained and drained strength."};
    for (Figure& each : element_test_figures(from.choice.element_tests)) {
        if (!belongs(each)) continue;
        add_points(from.paper, each);
        chapter.figures.push_back(std::move(each));
    }
    document.chapters.push_back(std::move(chapter));
}

}  // namespace breach::report
