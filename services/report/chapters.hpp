// The chapters of a run's report, each from the files of its phases. A chapter that a run cannot
// fill is left out, and why is noted; so is each figure.
#pragma once

#include "services/report/document.hpp"
#include "services/report/measures.hpp"
#include "services/report/paper.hpp"
#include "services/report/run_folder.hpp"

namespace breach::report {

/// What the reader chose.
struct Choice {
    std::vector<double> snapshot_times;  ///< of contours and meshes [s]; empty: four over the run
    std::vector<double> transfer_times;  ///< of geometries [s]; empty: half and full runout
    std::filesystem::path motion;        ///< file; empty: where the scene says
};

/// All that chapters read.
struct Material {
    const Run& run;
    const std::optional<Paper>& paper;
    const Measures& measures;
    const Choice& choice;
};

void add_stability(const Material& from, Document& document);
void add_motion(const Material& from, Document& document);
void add_shaking(const Material& from, Document& document);
void add_mesh(const Material& from, Document& document);
void add_transfer(const Material& from, Document& document);
void add_runout(const Material& from, Document& document);
void add_flow(const Material& from, Document& document);
void add_numbers(const Material& from, Document& document);

}  // namespace breach::report
