// A user's condition or quantity over telemetry fields, parsed once and evaluated line by line:
//
//     jacobian_least_avg < 0.97 and not (time < 1)
//     growth(kinetic_energy, 0.2) > 5 or epsilon_q_avg >= 0.2
//
// Numbers, fields, + - * /, < <= > >=, and / or / not, parentheses; abs(x), min(x, y), max(x, y);
// rate(x, w) = (x(t) - x(t-w)) / w [1/s times x's unit], growth(x, w) = ln(x(t) / x(t-w)) / w
// [1/s], w in seconds of the simulated time.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace breach::criteria {

enum class Kind { quantity, condition };

/// One instruction of the compiled expression, for a stack machine.
struct Instruction {
    enum class Code {
        constant,
        field,
        negate,
        add,
        subtract,
        multiply,
        divide,
        absolute,
        smaller,
        larger,
        less,
        less_equal,
        greater,
        greater_equal,
        both,
        either,
        opposite,
        rate,
        growth,
    };
    Code code;
    double value = 0.0;     ///< a constant, or a window's length [s]
    std::size_t index = 0;  ///< of the field, or of the window
};

struct Expression {
    std::string text;
    Kind kind = Kind::quantity;
    std::vector<std::string> fields;  ///< each once; "time" only if it is used
    std::vector<Instruction> program;
    std::size_t depth = 0;    ///< largest height of the stack
    std::size_t windows = 0;  ///< number of calls of rate and growth
};

/// Throws BadInput with one fault at `pointer`: the column in the text (from 1) and what was
/// expected there. `known`: allowed fields; empty: any name is allowed.
Expression parse(std::string_view text, Kind wanted, const std::string& pointer,
                 const std::vector<std::string>& known = {});

}  // namespace breach::criteria
