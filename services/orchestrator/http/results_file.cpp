#include "services/orchestrator/http/results_file.hpp"

#include <fstream>
#include <limits>

#include "core/exchange/archive.hpp"
#include "services/orchestrator/records/identity.hpp"

namespace breach::orchestrator {

namespace {

double or_nan(const std::optional<double>& value) {
    return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

exchange::Archive archive_of(const std::vector<SweepRow>& rows, const std::string& run) {
    exchange::Archive archive{.kind = "sweep_results",
                              .version = 1,
                              .reals = {},
                              .integers = {},
                              .texts = {{"run", run}},
                              .units = {{"transfer_time", "s"},
                                        {"runout", "m"},
                                        {"runout_beyond_toe", "m"},
                                        {"runout_largest", "m"},
                                        {"volume_ratio", "1"},
                                        {"numerical_share", "1"},
                                        {"overlap", "1"},
                                        {"cpu_seconds", "s"}}};
    for (const auto& [name, unit] : archive.units) archive.reals[name] = {};
    for (const char* name : {"variant", "state", "trigger"}) archive.texts[name] = "";
    for (const SweepRow& row : rows) {
        archive.reals["transfer_time"].push_back(row.transfer_time);
        archive.reals["runout"].push_back(or_nan(row.runout));
        archive.reals["runout_beyond_toe"].push_back(or_nan(row.runout_beyond_toe));
        archive.reals["runout_largest"].push_back(or_nan(row.runout_largest));
        archive.reals["volume_ratio"].push_back(or_nan(row.volume_ratio));
        archive.reals["numerical_share"].push_back(or_nan(row.numerical_share));
        archive.reals["overlap"].push_back(or_nan(row.overlap));
        archive.reals["cpu_seconds"].push_back(or_nan(row.cpu_seconds));
        archive.integers["reused"].push_back(row.reused ? 1 : 0);
        archive.texts["variant"] += row.variant + "\n";
        archive.texts["state"] += row.state + "\n";
        archive.texts["trigger"] += row.trigger + "\n";
    }
    return archive;
}

}  // namespace

std::string as_hdf5(const std::vector<SweepRow>& rows, const std::string& run,
                    const std::string& scene, FrameReader& hdf5,
                    const std::filesystem::path& scratch) {
    const auto file = scratch / (new_run_id() + ".h5");
    hdf5.alone([&] {
        exchange::Provenance provenance;
        provenance.phase = "breachline";
        provenance.scene = scene;
        exchange::write_archive(file, archive_of(rows, run), provenance);
    });
    std::ifstream stream(file, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    stream.close();
    std::filesystem::remove(file);
    return bytes;
}

}  // namespace breach::orchestrator
