// Inside services/import only: the steps of an import in their order, and what they hand on. Every
// step adds its faults and remarks to the notes; steps.cpp decides whether the next one follows.
#pragma once

#include "services/import/depth_layers.hpp"
#include "services/import/document.hpp"
#include "services/import/import.hpp"
#include "services/import/layer_map.hpp"
#include "services/import/liquefy.hpp"

namespace breach::importing {

/// The request, and the result as far as it is.
struct Notes {
    const Request& request;
    Imported result = {};

    bool are_clean() const { return result.faults.empty(); }
    void refuse(std::string pointer, std::string cause, std::string remedy) {
        result.faults.push_back({std::move(pointer), std::move(cause), std::move(remedy)});
    }
    void remark(std::string text) { result.report["remarks"].push_back(std::move(text)); }
    /// For sizes and shapes that suggest a mistake: becomes a fault unless confirmed.
    void ask_to_confirm(const std::string& pointer, const std::string& cause,
                        const std::string& remedy);
    void add(const std::vector<Fault>& faults);
    void add(const std::vector<Change>& changes);
    void add(const Drawing& drawing);
};

/// The outlines of a drawing by the meaning of their layers.
struct Sorted {
    std::vector<Soil> soils;                     ///< as drawn; open ones are faults
    std::map<Role, std::vector<Outline>> lines;  ///< joined within their layer
};
/// Joins the lines of each layer, and names the regions. Moves the outlines out of the drawing.
Sorted sorted(Drawing& drawing, const LayerMap& map, Notes& notes);

/// The phreatic line, the terrain and the ground, each drawn or sent as a file of its own.
/// drawn_in: unit of the drawing, for a remark on files that name none.
Lines section_lines(Sorted& drawn, const std::string& drawn_in, Notes& notes);

/// The drawing after healing and cutting.
struct Section {
    std::vector<Soil> soils;
    Lines lines;
    std::vector<LayerRequest> layers;
    std::vector<LiquefiedRequest> liquefied;
    std::string terrain_from = "";  ///< why the terrain is as it is; set by can_fail
};
/// Adds the faults for which the section can neither be shaken nor liquefy, as requested. Guesses
/// the terrain if it has none.
bool can_fail(Section& section, Notes& notes);
/// Fills scene, study, motion and sketch of the result.
void write_scene(const Section& section, Notes& notes);

/// Replaces characters that names of scenes or regions must not have.
std::string as_name(const std::string& text, const std::string& otherwise);
std::string scene_name(const Request& request);
/// "CORE, FILL" in UTF-8, at most 400 bytes; "none".
std::string layers_named(const std::set<std::string>& names);

}  // namespace breach::importing
