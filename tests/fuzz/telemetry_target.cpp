// Reads telemetry lines for criteria, for a watcher of a running phase, and for the API.
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/criteria/criterion.hpp"
#include "core/telemetry/lines.hpp"
#include "services/orchestrator/files/telemetry.hpp"
#include "tests/fuzz/fuzz.hpp"

using namespace breach;

namespace {

/// As a trigger watches a running phase.
void follow(const std::filesystem::path& file) {
    telemetry::Tail tail(file);
    double last = -1.0;
    for (const auto& line : tail.fresh()) {
        fuzz::require(line.time > last, "times ascend");
        last = line.time;
    }
    fuzz::require(tail.fresh().empty(), "each line is given out once");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const fuzz::File file(fuzz::text_of(data, size));
    fuzz::taken([&] {
        const auto lines = telemetry::read(file.path());
        const auto expression = criteria::parse("time > 1 and rate(x, 0.5) < 2 * abs(step)",
                                                criteria::Kind::condition, "/when");
        criteria::Criterion criterion(expression, 0.1);
        for (const auto& line : lines) criterion.take(criteria::line_for(expression, line));
    });
    follow(file.path());
    const auto answer =
        orchestrator::read_telemetry(file.path(), {.fields = {"time"}, .from = 1, .stride = 2});
    answer.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    return 0;
}
