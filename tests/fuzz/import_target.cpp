// A drawing as DXF or CSV: gives a scene that every reader accepts, or faults with places. The
// first byte selects format and options.
#include "core/check/check.hpp"
#include "services/drawing/section_drawing.hpp"
#include "services/import/import.hpp"
#include "tests/fuzz/fuzz.hpp"

using namespace breach;

namespace {

nlohmann::json soil() {
    return nlohmann::json::parse(R"({"density": 2000, "law": {"type": "mohr_coulomb",
        "E_MPa": 40, "nu": 0.3, "c_kPa": 5, "phi_deg": 30}})");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const unsigned options = data[0];
    const std::string bytes(fuzz::text_of(data + 1, size - 1));
    importing::Request request{
        .drawing = {(options & 1) != 0 ? "drawing.csv" : "drawing.dxf", bytes},
        .materials = {{"a", soil()}, {"b", soil()}}};
    if ((options & 2) != 0) request.unit = "m";
    if ((options & 4) != 0) request.flatten = 0.1;
    if ((options & 8) != 0) request.layers = {"a=1,3"};
    if ((options & 16) != 0) request.phreatic = {"water.csv", "x,y\n0,3\n20,1\n"};
    if ((options & 32) != 0) request.tolerance = 0.5;
    if ((options & 64) != 0) request.motion.emplace();
    if ((options & 128) != 0) request.liquefied = {"a=0.08,CPTu"};
    const importing::Imported imported = importing::import_section(request);
    fuzz::require(imported.scene.is_null() != imported.faults.empty(), "a scene or faults");
    importing::lines_of(imported.report, 5);
    nlohmann::json shown = nlohmann::json::object();
    if (imported.faults.empty()) {
        shown = imported.scene;
        if (shown.contains("fem")) shown["fem"].erase("motion");  // its file does not exist
        const auto read = check::checked_text(shown.dump(), "scene", ".", {});
        fuzz::require(read.faults.empty(), "a scene that was made can be read");
    }
    for (const fault::Fault& each : imported.faults)
        fuzz::require(!each.cause.empty() && !each.remedy.empty() &&
                          nlohmann::json(each.cause + each.pointer).dump().size() > 2,
                      "a fault says why, in UTF-8, and what to write instead");
    const drawing::Draft draft{{shown, {}, ""}, imported.sketch, imported.faults};
    if (drawing::can_be_drawn(draft)) drawing::as_svg(draft, {});
    return 0;
}
