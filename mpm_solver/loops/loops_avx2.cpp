// The inner loops for CPUs with AVX2 and fused multiply-add; flags in CMakeLists.txt.
#include "mpm_solver/loops/loops_of.hpp"

namespace breach::mpm {

namespace {
struct Avx2 {
    static constexpr int lanes = 4;
};
}  // namespace

Loops avx2_loops(const Choice& choice) { return loops_of<Avx2>(choice); }

}  // namespace breach::mpm
