// A scene as in a phase: read, checked, completed. An accepted scene is accepted again when
// completed, with the same completion.
#include "core/check/check.hpp"
#include "tests/fuzz/json_mutator.hpp"

using namespace breach;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::taken([&] {
        const auto checked = check::checked_text(fuzz::text_of(data, size), "scene", "", {});
        if (!checked.faults.empty()) return;
        const auto again = check::checked_text(checked.scene.completed, "scene", "", {});
        fuzz::require(again.faults.empty(), "a completed scene is a sound scene");
        fuzz::require(again.scene.completed == checked.scene.completed,
                      "a completed scene is complete");
    });
    return 0;
}
