// A motion in each format, and the scene check's measures of it.
#include <cmath>
#include <sstream>

#include "core/motion/plausibility.hpp"
#include "core/motion/read_motion.hpp"
#include "tests/fuzz/fuzz.hpp"

using namespace breach;

namespace {

void measure(const motion::Recording& recording) {
    const motion::Series& series = recording.series;
    fuzz::require(series.values.size() >= 2 && series.dt > 0.0 && std::isfinite(series.dt),
                  "a motion has samples and a time step");
    for (const double value : series.values)
        fuzz::require(std::isfinite(value), "a motion is finite");
    motion::remarks_about(recording, "/fem/motion/file");
    if (recording.quantity != motion::Quantity::acceleration) return;
    motion::strong_part(series);
    motion::base_corrected(series);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    for (const auto read : {motion::read_peer, motion::read_csv, motion::read_two_columns}) {
        std::istringstream in{std::string(fuzz::text_of(data, size))};
        fuzz::taken([&] { measure(read(in, "motion")); });
    }
    return 0;
}
