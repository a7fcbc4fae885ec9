#include "services/orchestrator/study/reach.hpp"

namespace breach::orchestrator {

std::vector<phases::Phase> phases_of(Reach reach) {
    switch (reach) {
        case Reach::chain:
            break;
        case Reach::filled_mpm:
            return {phases::mpm};
        case Reach::fem:
            return {phases::fem};
        case Reach::lem:
            return {phases::lem};
    }
    return {phases::fem, phases::transfer, phases::mpm};
}

bool has_lattice(Reach reach) { return reach == Reach::chain || reach == Reach::filled_mpm; }

}  // namespace breach::orchestrator
