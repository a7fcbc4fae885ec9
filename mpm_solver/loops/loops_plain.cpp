// The inner loops for any CPU; flags in CMakeLists.txt.
#include "mpm_solver/loops/loops_of.hpp"

namespace breach::mpm {

namespace {
struct Plain {
    static constexpr int lanes = 2;  // SSE2, NEON
};
}  // namespace

Loops plain_loops(const Choice& choice) { return loops_of<Plain>(choice); }

}  // namespace breach::mpm
