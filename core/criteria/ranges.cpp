#include "core/criteria/ranges.hpp"

#include <algorithm>
#include <cmath>

namespace breach::criteria {

namespace {

using Code = Instruction::Code;

/// Range of a condition: 0 if it may be false, 1 if it may be true.
Range truth(bool may_be_true, bool may_be_false) {
    return {may_be_false ? 0.0 : 1.0, may_be_true ? 1.0 : 0.0};
}

/// Products and quotients: unlimited range.
Range combined(Code code, const Range& x, const Range& y) {
    switch (code) {
        case Code::add:
            return {x.least + y.least, x.most + y.most};
        case Code::subtract:
            return {x.least - y.most, x.most - y.least};
        case Code::smaller:
        case Code::both:
            return {std::min(x.least, y.least), std::min(x.most, y.most)};
        case Code::larger:
        case Code::either:
            return {std::max(x.least, y.least), std::max(x.most, y.most)};
        case Code::less:
            return truth(x.least < y.most, x.most >= y.least);
        case Code::less_equal:
            return truth(x.least <= y.most, x.most > y.least);
        case Code::greater:
            return combined(Code::less, y, x);
        case Code::greater_equal:
            return combined(Code::less_equal, y, x);
        default:
            return {};
    }
}

Range absolute(const Range& x) {
    const bool around_zero = x.least <= 0.0 && x.most >= 0.0;
    return {around_zero ? 0.0 : std::min(std::abs(x.least), std::abs(x.most)),
            std::max(std::abs(x.least), std::abs(x.most))};
}

}  // namespace

bool can_be_true(const Expression& condition,
                 const std::function<Range(const std::string& field)>& range_of) {
    std::vector<Range> stack;
    for (const Instruction& each : condition.program) {
        switch (each.code) {
            case Code::constant:
                stack.push_back({each.value, each.value});
                break;
            case Code::field:
                stack.push_back(range_of(condition.fields[each.index]));
                break;
            case Code::negate:
                stack.back() = {-stack.back().most, -stack.back().least};
                break;
            case Code::absolute:
                stack.back() = absolute(stack.back());
                break;
            case Code::opposite:
                stack.back() = {1.0 - stack.back().most, 1.0 - stack.back().least};
                break;
            case Code::rate:
            case Code::growth:
                stack.back() = {};
                break;
            default: {
                const Range y = stack.back();
                stack.pop_back();
                stack.back() = combined(each.code, stack.back(), y);
            }
        }
    }
    return stack.back().most >= 1.0;
}

}  // namespace breach::criteria
