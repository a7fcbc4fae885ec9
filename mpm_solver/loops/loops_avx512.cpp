// The inner loops for CPUs with AVX-512; flags in CMakeLists.txt. BREACH_WITHOUT_AVX512: left out
// of a build for one CPU that lacks it (quickstart); body/choose.cpp never asks for them there.
#include "mpm_solver/loops/loops_of.hpp"

namespace breach::mpm {

#ifdef BREACH_WITHOUT_AVX512
Loops avx512_loops(const Choice& choice) { return avx2_loops(choice); }
#else
namespace {
struct Avx512 {
    static constexpr int lanes = 8;
};
}  // namespace

Loops avx512_loops(const Choice& choice) { return loops_of<Avx512>(choice); }
#endif

}  // namespace breach::mpm
