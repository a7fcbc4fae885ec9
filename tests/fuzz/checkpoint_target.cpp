// A modified checkpoint of the FEM or the MPM: refused, or accepted and then safe to resume. The
// input is a list of changes to the arrays of a valid one.
#include <spdlog/spdlog.h>

#include <cmath>
#include <limits>

#include "fem_solver/analysis.hpp"
#include "fem_solver/model/build_model.hpp"
#include "mpm_solver/body/fill.hpp"
#include "mpm_solver/checkpoint.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/unit/exchange/samples.hpp"

using namespace breach;
using exchange::Archive;

namespace {

constexpr const char* scene_text = R"({
    "format": "breachline-scene/1", "name": "block",
    "materials": {"soil": {"density": 1800,
        "law": {"type": "mohr_coulomb", "E_MPa": 20, "nu": 0.3, "c_kPa": 1, "phi_deg": 30}}},
    "section": {"regions": [{"name": "block", "material": "soil",
        "polygon": [[0, 0], [2, 0], [2, 2], [0, 2], [0, 0]],
        "mesh": {"type": "block", "divisions": [2, 2]}}]},
    "fem": {"supports": [{"name": "base", "from": [0, 0], "to": [2, 0], "fixes": "xy"}],
        "stages": [{"type": "static", "name": "gravity", "laws": "elastic"},
                   {"type": "dynamic", "name": "failure", "duration": 0.02, "time_step": 0.01}],
        "crest": [2, 2]},
    "transfer": {},
    "mpm": {"cell_size": 0.5, "domain_x": [0, 8], "domain_y": [0, 4], "duration": 1.0,
        "floor": {"level": 0, "friction": [{"from": 0, "to": 8, "coefficient": 0.5}]},
        "runout": {"toe": [2, 0]},
        "gauges": [{"name": "toe", "x": 2}]}})";

process::SessionSettings settings_in(const std::filesystem::path& folder) {
    process::SessionSettings settings;
    settings.phase = "fem_solver";
    settings.output = folder;
    settings.start = process::Start::resume;
    return settings;
}

/// A phase with its scene and a valid checkpoint.
class FemPhase {
  public:
    FemPhase()
        : session_(settings_in(folder_.path()), scene::parse_scene(scene_text, "fuzz")),
          model_(fem::build_model(session_.scene(),
                                  fem::build_mesh(session_.scene(), folder_.path()))) {
        fem::Course course(session_, model_);
        fem::analyse(course);
        fem::Kept kept = course;
        kept.position.stage = 1;
        kept.largest = {};
        kept.stage_force = kept.motion.force;
        kept.counts = {};
        sound_ = fem::checkpoint_archive(kept, {}, session_.scene());
    }
    const Archive& sound() const { return sound_; }
    void go_on_from(const Archive& archive) {
        exchange::write_archive(session_.output("checkpoint.h5"), archive, session_.provenance());
        const fem::Course resumed(session_, model_);
    }

  private:
    exchange::samples::Folder folder_;
    process::Session session_;
    fem::Model model_;
    Archive sound_;
};

class MpmPhase {
  public:
    MpmPhase() : scene_(scene::parse_scene(scene_text, "fuzz")) {
        mpm::Body body = mpm::make_body(
            scene_, mpm::zoned_points(scene_, mpm::fill_section(scene_).state, "fuzz"), "fuzz");
        mpm::Simulation simulation(scene_, std::move(body), 0.0);
        simulation.look();
        simulation.advance();
        mpm::save_checkpoint(file(), simulation, 1, provenance());
        sound_ = exchange::read_archive(file(), "mpm_checkpoint", mpm::checkpoint_version);
    }
    const Archive& sound() const { return sound_; }
    void go_on_from(const Archive& archive) {
        exchange::write_archive(file(), archive, provenance());
        mpm::Simulation simulation = mpm::load_checkpoint(file(), scene_, provenance()).simulation;
        try {
            simulation.advance();
            simulation.look();
            simulation.take_frame();
            simulation.state();
        } catch (const fault::Breakdown&) {
        }
    }

  private:
    std::filesystem::path file() const { return folder_ / "checkpoint.h5"; }
    exchange::Provenance provenance() const {
        exchange::Provenance provenance;
        provenance.scene = scene_.completed;
        return provenance;
    }
    exchange::samples::Folder folder_;
    scene::Scene scene_;
    Archive sound_;
};

/// Any entry of a map of arrays; the map is not empty.
template <class Map>
auto& entry_of(Map& map, fuzz::Purse& purse) {
    return *std::next(map.begin(), static_cast<long>(purse.below(map.size())));
}

double odd_real(fuzz::Purse& purse) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double odd[] = {0.0, -1.0, 1e-300, 1e300, -1e300, 1e9, infinity, -infinity, std::nan("")};
    return odd[purse.below(std::size(odd))];
}

template <class T>
void change_length(std::vector<T>& values, fuzz::Purse& purse) {
    const std::size_t change = purse.below(9);
    values.resize(purse.byte() % 4 == 0
                      ? 0
                      : values.size() + change - std::min<std::size_t>(4, values.size()));
}

void change(Archive& archive, fuzz::Purse& purse) {
    auto& [real_name, reals] = entry_of(archive.reals, purse);
    auto& [integer_name, integers] = entry_of(archive.integers, purse);
    switch (purse.byte() % 6) {
        case 0:
            change_length(reals, purse);
            break;
        case 1:
            change_length(integers, purse);
            break;
        case 2:
            if (!reals.empty()) reals[purse.below(reals.size())] = odd_real(purse);
            break;
        case 3:
            if (!integers.empty())
                integers[purse.below(integers.size())] =
                    static_cast<std::int64_t>(purse.number(1 << (purse.byte() % 4)));
            break;
        case 4:
            archive.reals.erase(real_name);
            break;
        default:
            archive.integers.erase(integer_name);
    }
}

template <class Phase>
void change_and_go_on(fuzz::Purse& purse) {
    spdlog::set_level(spdlog::level::off);
    static Phase phase;
    static const bool goes_on = fuzz::taken([] { phase.go_on_from(phase.sound()); });
    fuzz::require(goes_on, "a sound checkpoint is taken");
    Archive archive = phase.sound();
    while (!purse.empty() && !archive.reals.empty() && !archive.integers.empty())
        change(archive, purse);
    fuzz::taken([&] { phase.go_on_from(archive); });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::Purse purse(data, std::min<std::size_t>(size, 64));
    if (purse.byte() % 2 == 0)
        change_and_go_on<FemPhase>(purse);
    else
        change_and_go_on<MpmPhase>(purse);
    return 0;
}
