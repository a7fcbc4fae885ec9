#include "transfer_tool/run.hpp"

#include <spdlog/spdlog.h>

#include "transfer_tool/transfer.hpp"

namespace breach::transfer {
namespace {

nlohmann::json as_json(const exchange::Ledger& ledger) {
    nlohmann::json rows = nlohmann::json::array();
    for (const exchange::LedgerRow& row : ledger)
        rows.push_back({{"region", row.region},
                        {"quantity", row.quantity},
                        {"unit", row.unit},
                        {"before", row.before},
                        {"after", row.after},
                        {"relative_difference", row.difference}});
    return rows;
}

void report(process::Session& session, const Transferred& t) {
    const scene::Transfer& settings = scene::transfer_of(session.scene());
    spdlog::info("{} points at t_T = {} s\n{}", t.state.size(), t.state.transfer_time,
                 as_text(t.ledger));
    spdlog::info(
        "{} points returned to the yield surface (largest excess {:.3g} Pa), {} strains "
        "raised to zero, {} coincident Gauss points merged",
        t.yield.returned, t.yield.largest_excess, t.gauss_fields.raised_strains,
        t.gauss_fields.merged_centres);
    nlohmann::json& result = session.result();
    result["transfer_time"] = t.state.transfer_time;
    result["points"] = t.state.size();
    result["points_per_direction"] = settings.points_per_direction;
    result["interpolation"] =
        settings.interpolation == scene::Interpolation::local ? "local" : "paper";
    result["softening_start"] =
        settings.softening_start == scene::SofteningStart::carried ? "carried" : "zero";
    result["returned_to_yield_surface"] = t.yield.returned;
    result["largest_yield_excess"] = t.yield.largest_excess;
    result["strains_raised_to_zero"] = t.gauss_fields.raised_strains;
    result["coincident_gauss_points"] = t.gauss_fields.merged_centres;
    result["ledger"] = as_json(t.ledger);
}

}  // namespace

process::Outcome run(process::Session& session) {
    const std::string file = session.input().string();
    const auto output = session.output("particles.vtkhdf");
    std::filesystem::remove(output);  // points of an earlier transfer must not pass for this one's
    session.progress(0.0, "reading");
    const exchange::MeshSnapshot mesh = exchange::read_mesh_snapshot(session.input()).snapshot;
    if (session.stop_requested()) return process::Outcome::stopped;
    session.progress(0.1, "transferring " + std::to_string(mesh.quads.size()) + " elements");
    const Transferred transferred =
        transfer(mesh, session.scene(), session.settings().threads, file);
    if (session.stop_requested()) return process::Outcome::stopped;
    report(session, transferred);
    refuse_losses(transferred.ledger, scene::transfer_of(session.scene()));

    exchange::write_particle_state(output, transferred.state, session.provenance(),
                                   transferred.ledger);
    session.result()["particles"] = output.filename().string();
    session.announce(output, {{"kind", "particles"},
                              {"transfer_time", transferred.state.transfer_time},
                              {"points", transferred.state.size()}});
    session.progress(1.0, "done");
    return process::Outcome::done;
}

}  // namespace breach::transfer
