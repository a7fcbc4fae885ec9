// Compiles a condition or quantity and evaluates it over a few lines of telemetry.
#include <cmath>

#include "core/criteria/criterion.hpp"
#include "tests/fuzz/fuzz.hpp"

using namespace breach;
using criteria::Kind;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    for (const Kind kind : {Kind::condition, Kind::quantity}) {
        fuzz::taken([&] {
            const auto expression = criteria::parse(fuzz::text_of(data, size), kind, "/when");
            criteria::Evaluation evaluation(expression);
            std::vector<double> values(expression.fields.size());
            for (int line = 0; line < 8; ++line) {
                for (std::size_t i = 0; i < values.size(); ++i)
                    values[i] = line == 3 ? std::nan("") : std::ldexp(line - 2.5, int(i % 40) - 20);
                const double value = evaluation(0.25 * line, values);
                if (kind == Kind::condition)
                    fuzz::require(value == 0.0 || value == 1.0 || std::isnan(value),
                                  "a condition is true, false or unknown");
            }
            criteria::Criterion criterion(expression, 0.5);
        });
    }
    return 0;
}
