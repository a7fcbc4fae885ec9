// A study as in the service: read and planned as tasks.
#include "services/orchestrator/study/graph.hpp"
#include "services/orchestrator/study/read_study.hpp"
#include "tests/fuzz/json_mutator.hpp"

using namespace breach;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::taken([&] {
        const auto study = orchestrator::read_study(fuzz::text_of(data, size));
        const orchestrator::Numerics numerics{{"lem_tool", 1},
                                              {"fem_solver", 1},
                                              {"post_seismic", 1},
                                              {"transfer_tool", 1},
                                              {"mpm_solver", 1}};
        const auto graph = orchestrator::plan_tasks(study, numerics);
        for (std::size_t i = 0; i < graph.tasks.size(); ++i)
            fuzz::require(!graph.tasks[i].parent || *graph.tasks[i].parent < i,
                          "parents come before their children");
    });
    return 0;
}
