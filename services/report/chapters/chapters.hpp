// The chapters of a run's report, each from the files of its phases. Chapters and figures without
// data are left out, and the reason is noted.
#pragma once

#include <string_view>

#include "services/report/chart/document.hpp"
#include "services/report/read/measures.hpp"
#include "services/report/read/paper.hpp"
#include "services/report/read/run_folder.hpp"

namespace breach::report {

/// Choices of the reader.
struct Choice {
    std::vector<double> snapshot_times;  ///< of contours and meshes [s]; empty: four over the run
    std::vector<double> transfer_times;  ///< of the runouts in detail [s]; empty: chosen
    std::filesystem::path motion;        ///< file; empty: the scene's entry
    /// Other runs with variants that belong to this one
    std::vector<std::filesystem::path> companions;
    std::filesystem::path element_tests;  ///< folder of fem_solver element-test; empty: none
};

/// The input of all chapters.
struct Material {
    const Run& run;
    const std::optional<Paper>& paper;
    const Measures& measures;
    const Choice& choice;
};

/// Runouts shown in detail, of the variant with the largest runout: those nearest to the requested
/// transfer times; without such times, the largest and the one nearest to half of it.
std::vector<const PhaseFolder*> chosen_runouts(const Material& from);
/// "t_T = 13 s, softened".
std::string of_transfer(const PhaseFolder& phase);
/// An entry of a result as text, divided by `unit`; "-" when it does not exist. Pointer:
/// "/energy/numerical/share".
std::string fact(const nlohmann::json& result, const std::string& pointer, double unit = 1.0);

/// A runout's part of file names: "13s", "filled_soft".
std::string file_word(const PhaseFolder& mpm);

/// The figure of runouts against transfer times.
inline constexpr std::string_view runout_figure = "runout_against_transfer_time";
/// Its curves, one per variant; means where the runouts have repeats.
std::vector<Series> runout_curves(const Run& run);

/// Marks the start and the end of the window of transfer times; without a window, the reason.
void mark_window(const WindowEdges& window, std::vector<Mark>& marks);

Series section_at_rest(const nlohmann::json& scene);

Front front_of(const Run& run);
/// The section before and after the governing runout, with slip surface and phreatic line.
Figure overview_of(const Run& run);
/// For a study over distributions: the page for a regulator, then its data.
void add_assessment(const Material& from, Document& document);
/// The first page's row from the samples; nothing for any other run.
std::optional<std::vector<std::string>> sampled_answer(const Run& run);
void add_inputs(const Material& from, Document& document);
void add_stability(const Material& from, Document& document);
void add_element_tests(const Material& from, Document& document);
void add_motion(const Material& from, Document& document);
void add_motions(const Material& from, Document& document);
void add_shaking(const Material& from, Document& document);
void add_mesh(const Material& from, Document& document);
void add_transfer(const Material& from, Document& document);
void add_runout(const Material& from, Document& document);
void add_flow(const Material& from, Document& document);
void add_outflow(const Material& from, Document& document);
void add_ground(const Material& from, Document& document);
void add_variants(const Material& from, Document& document);
void add_numbers(const Material& from, Document& document);
void add_checklist(const Material& from, Document& document);
/// The methods of the phases that ran, with their sources.
void add_methods(const Material& from, Document& document);
void add_annex(const Material& from, Document& document);

}  // namespace breach::report
