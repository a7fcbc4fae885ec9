// The inner loops for CPUs with AVX-512; flags in CMakeLists.txt.
#include "mpm_solver/loops/loops_of.hpp"

namespace breach::mpm {

namespace {
struct Avx512 {
    static constexpr int lanes = 8;
};
}  // namespace

Loops avx512_loops(const Choice& choice) { return loops_of<Avx512>(choice); }

}  // namespace breach::mpm
