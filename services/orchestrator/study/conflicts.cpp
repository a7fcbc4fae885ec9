// A table instead of conditions in the readers: each pair of entries stands once, with its reason
// and what to write instead. Rows of one kind stand together and are all tried, so that a study
// with several conflicts gets all of them.
#include "services/orchestrator/study/conflicts.hpp"

#include "services/orchestrator/study/variants.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

bool has_variants(const Asked& asked) { return !own_variants(asked.document).empty(); }
bool has_triggers(const Asked& asked) { return !asked.document.at("triggers").empty(); }
bool has_times(const Asked& asked) { return asked.document.contains("transfer_times"); }
bool redraws_fem(const Asked& asked) { return asked.draws.of == Redrawn::fem; }
bool transfers(const Asked& asked) { return asked.reach == Reach::chain; }
bool is(const Asked& asked, Kind kind) { return asked.kind == kind; }
/// Each sample and each rung is one state, from one transfer.
std::size_t transfers_of(const Asked& asked) { return asked.times + asked.live; }

/// stands: a function without state, so that the table is data. It may rely on entries that the
/// schema has completed ("triggers" is always there).
struct Conflict {
    const char* pointer;
    bool (*stands)(const Asked& asked);
    const char* cause;
    const char* remedy;
};

const Conflict conflicts[] = {
    // a sweep
    {"/transfer_times",
     [](const Asked& a) { return is(a, Kind::sweep) && !transfers(a) && has_times(a); },
     "the scene has no FEM, and nothing else is transferred",
     "leave \"transfer_times\" out, or add \"fem\" to the scene"},
    {"/triggers",
     [](const Asked& a) { return is(a, Kind::sweep) && !transfers(a) && has_triggers(a); },
     "triggers watch a FEM, and the scene has none",
     "leave \"triggers\" out, or add \"fem\" to the scene"},
    {"/stability",
     [](const Asked& a) {
         return is(a, Kind::sweep) && a.reach == Reach::lem && a.document.at("stability") == false;
     },
     "the scene has nothing but a stability analysis to run",
     "leave \"stability\" out, or add \"mpm\" to the scene"},
    {"/draws_of",
     [](const Asked& a) {
         return is(a, Kind::sweep) && redraws_fem(a) && a.draws.count > 1 && a.live > 0;
     },
     each_fem_has_its_time,
     "give \"transfer_times\", or leave \"draws_of\" out: repeats of the points share one FEM and "
     "its triggers"},
    // an accuracy study
    {"/variants", [](const Asked& a) { return is(a, Kind::accuracy) && has_variants(a); },
     "an accuracy study makes its variants of its ladders",
     "leave \"variants\" out: a ladder's rungs say what is changed"},
    {"/draws", [](const Asked& a) { return is(a, Kind::accuracy) && a.draws.count > 1; },
     "an accuracy study has its own entry for repeats",
     "give /accuracy/draws and /accuracy/draws_of"},
    {"/draws_of", [](const Asked& a) { return is(a, Kind::accuracy) && redraws_fem(a); },
     "an accuracy study has its own entry for repeats",
     "give /accuracy/draws and /accuracy/draws_of"},
    {"/uncertainty",
     [](const Asked& a) { return is(a, Kind::accuracy) && a.document.contains("uncertainty"); },
     "a study has one question",
     "leave \"uncertainty\" out, or give it in a study without \"accuracy\""},
    {"/triggers", [](const Asked& a) { return is(a, Kind::accuracy) && has_triggers(a); },
     "an accuracy study judges one state, at one time", "give one transfer time instead"},
    {"/transfer_times",
     [](const Asked& a) { return is(a, Kind::accuracy) && transfers(a) && a.times > 1; },
     "an accuracy study judges one state, and there are several transfer times", "give one time"},
    {"/transfer_times",
     [](const Asked& a) { return is(a, Kind::accuracy) && !transfers(a) && a.times > 0; },
     "nothing is transferred for this quantity", "leave \"transfer_times\" out"},
    // an uncertainty study
    {"/variants", [](const Asked& a) { return is(a, Kind::uncertainty) && has_variants(a); },
     "an uncertainty study makes its variants of its samples",
     "leave \"variants\" out; what is one of several becomes a parameter with \"one_of\""},
    {"/draws", [](const Asked& a) { return is(a, Kind::uncertainty) && a.draws.count > 1; },
     "an uncertainty study draws lattices itself",
     "give a parameter {\"name\": \"lattice\", \"numerical\": true}"},
    {"/draws_of", [](const Asked& a) { return is(a, Kind::uncertainty) && redraws_fem(a); },
     "an uncertainty study draws lattices itself",
     "give a parameter {\"name\": \"lattice\", \"numerical\": true}"},
    {"/transfer_times",
     [](const Asked& a) { return is(a, Kind::uncertainty) && !transfers(a) && a.times > 0; },
     "nothing is transferred for this quantity", "leave it out"},
    {"/triggers",
     [](const Asked& a) { return is(a, Kind::uncertainty) && !transfers(a) && a.live > 0; },
     "nothing is transferred for this quantity", "leave it out"},
    {"/transfer_times",
     [](const Asked& a) { return is(a, Kind::uncertainty) && transfers(a) && a.times > 1; },
     "each sample is transferred once, and this makes several transfers",
     "give one time, or one trigger that fires once"},
    {"/triggers",
     [](const Asked& a) {
         return is(a, Kind::uncertainty) && transfers(a) && a.times <= 1 &&
                (transfers_of(a) > 1 || a.bisects);
     },
     "each sample is transferred once, and this makes several transfers",
     "give one time, or one trigger that fires once"},
};

}  // namespace

Kind kind_of(const json& document) {
    if (document.contains("accuracy")) return Kind::accuracy;
    return document.contains("uncertainty") ? Kind::uncertainty : Kind::sweep;
}

void refuse_conflicts(const Asked& asked, std::vector<fault::Fault>& faults) {
    for (const Conflict& each : conflicts)
        if (each.stands(asked)) faults.push_back({each.pointer, each.cause, each.remedy});
    // The other kinds read and check their repeats themselves.
    if (asked.kind == Kind::sweep) check_draws(asked.draws, asked.reach, "", faults);
}

}  // namespace breach::orchestrator
